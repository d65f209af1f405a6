// The question whether two grids have any place of the patient in common.
#pragma once

#include <glm/mat4x4.hpp>

#include "core/geometry.h"

namespace tidemark::imaging {

// Whether the boxes of both grids overlap, to the outer faces of their voxels; boxes that only touch do not.
// `transform` is affine and leads from the image's patient coordinates (LPS, mm) to the grid's.
[[nodiscard]] bool share_space(const Geometry& image, const glm::dmat4& transform, const Geometry& grid);

}  // namespace tidemark::imaging
