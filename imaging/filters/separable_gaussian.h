// The Gaussian along one axis as a plain sum. Private to this folder.
#pragma once

#include <vector>

#include "core/geometry.h"

namespace tidemark::imaging {

// Convolves the lines along `axis` (0, 1, 2) of `values` in place with a sampled, normalised Gaussian of
// sigma_voxels > 0, cut at 5 sigma; beyond the ends a line goes on with its last value.
void convolve_axis(std::vector<float>& values, Index3 size, int axis, double sigma_voxels);

}  // namespace tidemark::imaging
