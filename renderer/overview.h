// Three slices and the surface in one picture.
#pragma once

#include "renderer/renderer.h"

namespace tidemark {

// Axial on the upper left, coronal and sagittal on the right and below, the surface in 3D on the lower right;
// each `side` pixels. The slices go through `position_mm`.
Result<Picture> draw_overview(Renderer& renderer, const WindowLevel& window, glm::dvec3 position_mm,
                              std::int64_t side);

// The middle of what is inside (LPS, mm); of the volume when nothing is.
glm::dvec3 middle_of(const Mask& mask);

// The file's own window, or one from the least to the greatest value.
WindowLevel window_of(const Volume& source);

}  // namespace tidemark
