#include "imaging/regions/cut.h"

#include <glm/geometric.hpp>

namespace tidemark::imaging {

Region on_side(const Region& region, const Geometry& grid, glm::dvec3 point_mm, glm::dvec3 normal) {
  Region side(region.bounds());
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    for (std::int64_t n = 0; n < length; ++n) {
      const Index3 at = voxel + Index3(n, 0, 0);
      if (glm::dot(grid.to_patient(glm::dvec3(at)) - point_mm, normal) >= 0.0) side.add(at);
    }
  });
  return side;
}

Region mirrored(const Region& region, Index3 grid_size, int axis) {
  VoxelRange box = region.bounds();
  const std::int64_t low = box.low[axis];
  box.low[axis] = grid_size[axis] - box.high[axis];
  box.high[axis] = grid_size[axis] - low;
  Region result(box);
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    // The last voxel of a run becomes the first.
    if (axis == 0) voxel.x += length - 1;
    voxel[axis] = grid_size[axis] - 1 - voxel[axis];
    result.add_run(voxel, length);
  });
  return result;
}

}  // namespace tidemark::imaging
