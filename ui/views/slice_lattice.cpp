#include "ui/views/slice_lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace tidemark::ui {
namespace {

// From where to where something reaches along an axis.
struct Reach {
  double low_mm = std::numeric_limits<double>::infinity();
  double high_mm = -std::numeric_limits<double>::infinity();
};

// Of the voxels from `low` to `high`, both ends included.
Reach reach_of(const Geometry& geometry, Index3 low, Index3 high, glm::dvec3 axis) {
  Reach reach;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 voxel(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                           corner & 4 ? high.z : low.z);
    const double place_mm = glm::dot(geometry.to_patient(voxel), axis);
    reach.low_mm = std::min(reach.low_mm, place_mm);
    reach.high_mm = std::max(reach.high_mm, place_mm);
  }
  return reach;
}

// Between a voxel of the box and one beside it there may be an outline.
bool is_met(const Geometry& geometry, const VoxelRange& box, glm::dvec3 normal, glm::dvec3 position_mm) {
  const Reach reach = reach_of(geometry, box.low - Index3(1), box.high, normal);
  const double place_mm = glm::dot(position_mm, normal);
  return place_mm > reach.low_mm && place_mm < reach.high_mm;
}

}  // namespace

SliceLattice lattice_in(const Geometry& geometry, const VoxelRange& box,
                        const renderer::SliceOrientation& orientation, glm::dvec3 position_mm) {
  SliceLattice lattice{orientation.right, orientation.up, {}, {}, {}, 0, 0};
  if (box.empty() || !is_met(geometry, box, orientation.into(), position_mm)) return lattice;
  lattice.off_mm = position_mm - lattice.right * glm::dot(position_mm, lattice.right) -
                   lattice.up * glm::dot(position_mm, lattice.up);
  const std::array<glm::dvec3, 2> along{lattice.right, lattice.up};
  std::array<int, 2> counts{};
  for (int side = 0; side < 2; ++side) {
    const glm::dvec3 axis = along[static_cast<std::size_t>(side)];
    double spacing_mm = 0.0;
    for (int a = 0; a < 3; ++a) {
      const double share = glm::dot(axis, geometry.direction[a]);
      spacing_mm += share * share * geometry.spacing_mm[a];
    }
    const Reach reach = reach_of(geometry, box.low, box.high - Index3(1), axis);
    // One more on each side: a mask may reach the border.
    lattice.stride_mm[side] = spacing_mm;
    lattice.first_mm[side] = reach.low_mm - spacing_mm;
    counts[static_cast<std::size_t>(side)] =
        static_cast<int>(std::llround((reach.high_mm - reach.low_mm) / spacing_mm)) + 3;
  }
  lattice.columns = counts[0];
  lattice.rows = counts[1];
  return lattice;
}

}  // namespace tidemark::ui
