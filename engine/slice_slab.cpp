#include "engine/slice_slab.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace tidemark::engine {

SliceSlab::SliceSlab(const Geometry& geometry, glm::dvec3 point_mm, glm::dvec3 normal)
    : geometry_(geometry), normal_(normal) {
  double thickness_mm = 0.0;
  glm::dvec3 share{0.0};
  for (int axis = 0; axis < 3; ++axis) {
    share[axis] = glm::dot(normal, geometry.direction[axis]);
    per_voxel_mm_[axis] = share[axis] * geometry.spacing_mm[axis];
    thickness_mm += share[axis] * share[axis] * geometry.spacing_mm[axis];
  }
  from_mm_ = glm::dot(geometry.origin_mm - point_mm, normal);
  // A plane half way between two slices belongs to one of them, whatever the rounding.
  constexpr double kTie = 1e-6;
  half_mm_ = 0.5 * thickness_mm;
  from_mm_ += kTie * thickness_mm;
  std::ranges::stable_sort(axes_, {}, [&](int axis) { return std::abs(share[axis]); });
  std::sort(axes_.begin(), axes_.begin() + 2);
}

double SliceSlab::finest_mm() const {
  return std::min(geometry_.spacing_mm[axes_[0]], geometry_.spacing_mm[axes_[1]]);
}

bool SliceSlab::meets(Index3 first, Index3 size) const {
  double low = distance_mm(first);
  double high = low;
  for (int axis = 0; axis < 3; ++axis) {
    const double way = static_cast<double>(size[axis] - 1) * per_voxel_mm_[axis];
    (way < 0.0 ? low : high) += way;
  }
  return high > -half_mm_ && low <= half_mm_;
}

std::vector<std::int64_t> SliceSlab::disc(glm::dvec3 centre_mm, double radius_mm) const {
  const glm::dvec3 centre = geometry_.to_voxel(centre_mm);
  const glm::dvec3 reach = (radius_mm + 2.0 * half_mm_) / geometry_.spacing_mm;
  const Index3 low = glm::max(Index3(glm::floor(centre - reach)), Index3(0));
  const Index3 high = glm::min(Index3(glm::ceil(centre + reach)), geometry_.size - Index3(1));
  const Index3 under(glm::round(centre));
  std::vector<std::int64_t> voxels;
  for (std::int64_t k = low.z; k <= high.z; ++k) {
    for (std::int64_t j = low.y; j <= high.y; ++j) {
      for (std::int64_t i = low.x; i <= high.x; ++i) {
        const Index3 voxel(i, j, k);
        if (!contains(voxel)) continue;
        const glm::dvec3 way = geometry_.to_patient(glm::dvec3(voxel)) - centre_mm;
        const glm::dvec3 in_plane = way - normal_ * glm::dot(way, normal_);
        if (voxel == under || glm::dot(in_plane, in_plane) <= radius_mm * radius_mm)
          voxels.push_back(geometry_.offset(voxel));
      }
    }
  }
  return voxels;
}

}  // namespace tidemark::engine
