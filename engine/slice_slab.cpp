#include "engine/slice_slab.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace tidemark::engine {
namespace {

constexpr double kTie = 1e-6;  // of the thickness

}  // namespace

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
  half_mm_ = 0.5 * thickness_mm;
  std::ranges::stable_sort(axes_, {}, [&](int axis) { return std::abs(share[axis]); });
  std::sort(axes_.begin(), axes_.begin() + 2);
  // A plane half way between two slices belongs to the one that pictures show, the upper one of the grid,
  // whatever the rounding.
  from_mm_ -= std::copysign(kTie * thickness_mm, per_voxel_mm_[axes_[2]]);
}

bool SliceSlab::is_near(glm::dvec3 place_mm) const {
  const double away_mm = std::abs(from_mm_ + glm::dot(place_mm - geometry_.origin_mm, normal_));
  return away_mm <= half_mm_ * (1.0 + 4.0 * kTie);
}

double SliceSlab::finest_mm() const {
  return std::min(geometry_.spacing_mm[axes_[0]], geometry_.spacing_mm[axes_[1]]);
}

bool SliceSlab::is_same_as(const SliceSlab& other) const {
  constexpr double kRounding = 1e-6;  // of the thickness, where a point has moved within the plane
  return normal_ == other.normal_ && std::abs(from_mm_ - other.from_mm_) < kRounding * half_mm_;
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

template <class Visit>
void SliceSlab::for_each_near(std::int64_t column, std::int64_t row, const Visit& visit) const {
  const int across = axes_[2];
  const double middle = depth_of({column, row});
  const double reach = half_mm_ / std::abs(per_voxel_mm_[across]);
  const auto last =
      std::min<std::int64_t>(std::llround(std::ceil(middle + reach)), geometry_.size[across] - 1);
  Index3 voxel(0);
  voxel[axes_[0]] = column;
  voxel[axes_[1]] = row;
  voxel[across] = std::max<std::int64_t>(std::llround(std::floor(middle - reach)), 0);
  for (; voxel[across] <= last; ++voxel[across]) {
    if (contains(voxel)) visit(voxel);
  }
}

std::vector<std::int64_t> SliceSlab::disc(glm::dvec3 centre_mm, double radius_mm) const {
  const glm::dvec3 centre = geometry_.to_voxel(centre_mm);
  const glm::dvec3 reach = (radius_mm + 2.0 * half_mm_) / geometry_.spacing_mm;
  const Index3 low = glm::max(Index3(glm::floor(centre - reach)), Index3(0));
  const Index3 high = glm::min(Index3(glm::ceil(centre + reach)), geometry_.size - Index3(1));
  const Index3 under(glm::round(centre));
  std::vector<std::int64_t> voxels;
  const auto add_within = [&](Index3 voxel) {
    const glm::dvec3 way = geometry_.to_patient(glm::dvec3(voxel)) - centre_mm;
    const glm::dvec3 in_plane = way - normal_ * glm::dot(way, normal_);
    if (voxel == under || glm::dot(in_plane, in_plane) <= radius_mm * radius_mm)
      voxels.push_back(geometry_.offset(voxel));
  };
  for (std::int64_t row = low[axes_[1]]; row <= high[axes_[1]]; ++row) {
    for (std::int64_t column = low[axes_[0]]; column <= high[axes_[0]]; ++column)
      for_each_near(column, row, add_within);
  }
  std::sort(voxels.begin(), voxels.end());
  return voxels;
}

// Row by row along the first of the slice's two axes; across it a column of the grid has the voxels near the
// plane.
std::vector<std::int64_t> SliceSlab::inside(const std::vector<glm::dvec3>& polygon_mm) const {
  std::vector<glm::dvec2> corners;
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const glm::dvec3 point_mm : polygon_mm) {
    corners.push_back(column_of(point_mm));
    low = std::min(low, corners.back().y);
    high = std::max(high, corners.back().y);
  }
  const auto first_row = std::max<std::int64_t>(std::llround(std::ceil(low)), 0);
  const auto last_row = std::min<std::int64_t>(std::llround(std::floor(high)), geometry_.size[axes_[1]] - 1);
  std::vector<std::int64_t> voxels;
  const auto add = [&](Index3 voxel) { voxels.push_back(geometry_.offset(voxel)); };
  std::vector<double> crossings;
  for (std::int64_t row = first_row; row <= last_row; ++row) {
    const auto y = static_cast<double>(row);
    crossings.clear();
    for (std::size_t n = 0; n < corners.size(); ++n) {
      const glm::dvec2 a = corners[n];
      const glm::dvec2 b = corners[(n + 1) % corners.size()];
      if ((a.y <= y) != (b.y <= y)) crossings.push_back(glm::mix(a.x, b.x, (y - a.y) / (b.y - a.y)));
    }
    std::sort(crossings.begin(), crossings.end());
    for (std::size_t n = 0; n + 1 < crossings.size(); n += 2) {
      const auto from = std::max<std::int64_t>(std::llround(std::ceil(crossings[n])), 0);
      const auto to =
          std::min<std::int64_t>(std::llround(std::floor(crossings[n + 1])), geometry_.size[axes_[0]] - 1);
      for (std::int64_t column = from; column <= to; ++column) for_each_near(column, row, add);
    }
  }
  std::sort(voxels.begin(), voxels.end());
  voxels.erase(std::unique(voxels.begin(), voxels.end()), voxels.end());
  return voxels;
}

glm::dvec2 SliceSlab::column_of(glm::dvec3 place_mm) const {
  const glm::dvec3 voxel = geometry_.to_voxel(place_mm);
  return {voxel[axes_[0]], voxel[axes_[1]]};
}

double SliceSlab::depth_of(glm::dvec2 column) const {
  const double in_slice_mm =
      from_mm_ + column.x * per_voxel_mm_[axes_[0]] + column.y * per_voxel_mm_[axes_[1]];
  return -in_slice_mm / per_voxel_mm_[axes_[2]];
}

std::optional<Index3> SliceSlab::voxel_of(std::int64_t u, std::int64_t v) const {
  Index3 voxel(0);
  voxel[axes_[0]] = u;
  voxel[axes_[1]] = v;
  voxel[axes_[2]] = std::llround(depth_of({u, v}));
  return geometry_.contains(voxel) ? std::optional(voxel) : std::nullopt;
}

glm::dvec3 SliceSlab::place_of(glm::dvec2 column) const {
  glm::dvec3 voxel(0.0);
  voxel[axes_[0]] = column.x;
  voxel[axes_[1]] = column.y;
  voxel[axes_[2]] = depth_of(column);
  return geometry_.to_patient(voxel);
}

}  // namespace tidemark::engine
