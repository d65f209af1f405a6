// The voxels of a slice that a polygon surrounds. Private to this folder.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "imaging/results/contours.h"

namespace tidemark::imaging {

// Turns round (0 to 1, 1 to 0) every voxel of the slice whose centre the polygon surrounds an odd number of
// times. `slice` holds columns * rows voxels, i fastest. What lies beyond the slice is left out; returns
// whether something did. The polygon has a point at least, and all of them are finite. Takes memory for the
// slice, however often the polygon crosses it.
bool flip_inside(std::span<const glm::dvec2> polygon, std::int64_t columns, std::int64_t rows,
                 std::vector<std::uint8_t>& slice);

}  // namespace tidemark::imaging
