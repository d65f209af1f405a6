// Regions cut and mirrored.
#pragma once

#include "core/region.h"

namespace tidemark::imaging {

// The voxels whose centre lies on the side of the plane that `normal` points to; on the plane counts.
// `point_mm`: a point of the plane (LPS); `normal`: of any length but 0.
[[nodiscard]] Region on_side(const Region& region, const Geometry& grid, glm::dvec3 point_mm,
                             glm::dvec3 normal);

// The region mirrored at the middle of the grid along an axis (0, 1, 2).
[[nodiscard]] Region mirrored(const Region& region, Index3 grid_size, int axis);

}  // namespace tidemark::imaging
