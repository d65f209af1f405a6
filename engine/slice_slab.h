// The layer of voxels that a slice shows, and the discs and polygons in it that are painted.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/geometry.h"

namespace tidemark::engine {

// The voxels whose centres are within half a voxel of the plane through `point_mm`, measured along the
// normal: one slice where the plane lies along the grid.
class SliceSlab {
 public:
  // `normal`: a unit vector (LPS).
  SliceSlab(const Geometry& geometry, glm::dvec3 point_mm, glm::dvec3 normal);

  [[nodiscard]] bool contains(Index3 voxel) const { return contains(distance_mm(voxel)); }
  // Whether a place (LPS, mm) is within half a voxel of the plane.
  [[nodiscard]] bool is_near(glm::dvec3 place_mm) const;
  // Whether the other one is of the same plane.
  [[nodiscard]] bool is_same_as(const SliceSlab& other) const;
  // Whether voxels of the box can be in it.
  [[nodiscard]] bool meets(Index3 first, Index3 size) const;
  // The grid's axis most along the normal, after the two that lie in the slice.
  [[nodiscard]] const std::array<int, 3>& axes() const { return axes_; }
  // The smaller distance of voxels in the slice.
  [[nodiscard]] double finest_mm() const;

  // Columns of voxels run across the slice. (u, v): a place on the first two of axes(), in voxels.
  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] glm::dvec2 column_of(glm::dvec3 place_mm) const;
  // The voxel of a column that is nearest to the plane; none: the plane leaves the grid there.
  [[nodiscard]] std::optional<Index3> voxel_of(std::int64_t u, std::int64_t v) const;
  // Where a column meets the plane (LPS, mm).
  [[nodiscard]] glm::dvec3 place_of(glm::dvec2 column) const;

  // The offsets of its voxels within a disc around a point of the plane, and of the voxel there; ascending.
  [[nodiscard]] std::vector<std::int64_t> disc(glm::dvec3 centre_mm, double radius_mm) const;
  // Those of its voxels that a polygon in the plane surrounds an odd number of times; likewise, ascending.
  [[nodiscard]] std::vector<std::int64_t> inside(const std::vector<glm::dvec3>& polygon_mm) const;

 private:
  [[nodiscard]] double distance_mm(Index3 voxel) const {
    return from_mm_ + static_cast<double>(voxel.x) * per_voxel_mm_.x +
           static_cast<double>(voxel.y) * per_voxel_mm_.y + static_cast<double>(voxel.z) * per_voxel_mm_.z;
  }
  // Calls visit(voxel) for the slab's voxels of a column across the slice.
  template <class Visit>
  void for_each_near(std::int64_t column, std::int64_t row, const Visit& visit) const;
  // How far along the third axis a column meets the plane, in voxels.
  [[nodiscard]] double depth_of(glm::dvec2 column) const;
  [[nodiscard]] bool contains(double distance_mm) const {
    return distance_mm > -half_mm_ && distance_mm <= half_mm_;
  }

  Geometry geometry_;
  glm::dvec3 normal_;
  glm::dvec3 per_voxel_mm_;  // along the normal, of a step on each axis
  double from_mm_ = 0.0;     // of voxel 0 from the plane
  double half_mm_ = 0.5;
  std::array<int, 3> axes_{0, 1, 2};
};

}  // namespace tidemark::engine
