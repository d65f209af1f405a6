// Coarser copies of an image for registration. Private to this folder.
#pragma once

#include <vector>

#include "core/progress.h"
#include "core/volume.h"

namespace tidemark::imaging::registration {

// From coarse to fine; no axis is coarser than its level or finer than the image itself.
inline constexpr double kLevelsMm[] = {8.0, 4.0, 2.0};

// The image on each level: smoothed, values cut to its common range, so that a few extreme ones do not spend
// the histogram.
Result<std::vector<Volume>> make_pyramid(const Volume& image, const Progress& progress);

[[nodiscard]] glm::dvec3 centre_mm(const Geometry& grid);

}  // namespace tidemark::imaging::registration
