#include "solver/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <vector>

namespace tidemark::solver {
namespace {

// The values of phi at the corners of a cell: corner (x, y, z) is element x + 2 y + 4 z.
using Cell = std::array<float, 8>;

// The values of a page and of one voxel around it. Beyond the volume they are those of its last voxels.
class PageWithApron {
 public:
  explicit PageWithApron(const Field& phi)
      : phi_(phi),
        shape_(phi.layout.page_shape()),
        stride_y_(shape_.x + 2),
        stride_z_(stride_y_ * (shape_.y + 2)),
        values_(static_cast<std::size_t>(stride_z_ * (shape_.z + 2))) {}

  // The neighbours are looked up once: translating an address for each value would take longer than what is
  // computed from them.
  void gather(std::int64_t page) {
    coordinates_ = phi_.layout.page_coordinates(page);
    valid_ = phi_.layout.valid_shape(page);
    look_up_neighbours();
    const Place before = place(0, -1);
    const Place behind = place(0, valid_.x);
    for (std::int64_t z = -1; z <= valid_.z; ++z) {
      for (std::int64_t y = -1; y <= valid_.y; ++y) {
        const Place at_y = place(1, y);
        const Place at_z = place(2, z);
        float* const row = values_.data() + index({0, y, z});
        row[-1] = value(before, at_y, at_z);
        row[valid_.x] = value(behind, at_y, at_z);
        if (const float* const stored = first_of_row({0, 0}, at_y, at_z)) {
          std::copy_n(stored, valid_.x, row);
        } else {
          std::fill_n(row, valid_.x, value({0, 0}, at_y, at_z));
        }
      }
    }
  }

  // `local`: from the page's first voxel, -1 to its size.
  [[nodiscard]] double at(Index3 local) const { return values_[static_cast<std::size_t>(index(local))]; }
  // Of the eight voxels of which this is the first.
  [[nodiscard]] Cell cell(Index3 local) const {
    const float* v = values_.data() + index(local);
    const float* above = v + stride_z_;
    return {v[0],     v[1],     v[stride_y_],     v[stride_y_ + 1],
            above[0], above[1], above[stride_y_], above[stride_y_ + 1]};
  }

 private:
  // Along one axis: in this page (0), the one before (-1) or behind it (1), and at which voxel of that.
  struct Place {
    int page;
    std::int64_t voxel;
  };

  [[nodiscard]] Place place(int axis, std::int64_t local) const {
    const int page = local < 0 ? -1 : local < valid_[axis] ? 0 : 1;
    const std::int64_t coordinate = coordinates_[axis] + page;
    if (page == 0 || coordinate < 0 || coordinate >= phi_.layout.pages()[axis]) {
      return {0, std::clamp<std::int64_t>(local, 0, valid_[axis] - 1)};
    }
    return {page, page < 0 ? shape_[axis] - 1 : 0};
  }

  void look_up_neighbours() {
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const Index3 at = coordinates_ + Index3(x, y, z);
          entries_[entry_index(x, y, z)] =
              phi_.layout.contains_page(at)
                  ? phi_.table[static_cast<std::size_t>(phi_.layout.page_number(at))]
                  : Field::kOutside;  // place() leads to none of these
        }
      }
    }
  }

  static std::size_t entry_index(int x, int y, int z) {
    return static_cast<std::size_t>((z + 1) * 9 + (y + 1) * 3 + x + 1);
  }

  // Null in a page that is not stored.
  [[nodiscard]] const float* first_of_row(Place x, Place y, Place z) const {
    const std::int32_t entry = entries_[entry_index(x.page, y.page, z.page)];
    if (entry < 0) return nullptr;
    return phi_.pages.data() + entry * phi_.layout.voxels_per_page() +
           (z.voxel * shape_.y + y.voxel) * shape_.x;
  }

  [[nodiscard]] float value(Place x, Place y, Place z) const {
    if (const float* const row = first_of_row(x, y, z)) return row[x.voxel];
    const bool inside = entries_[entry_index(x.page, y.page, z.page)] == Field::kInside;
    return static_cast<float>(inside ? phi_.band : -phi_.band);
  }

  [[nodiscard]] std::int64_t index(Index3 local) const {
    return local.x + 1 + stride_y_ * (local.y + 1) + stride_z_ * (local.z + 1);
  }

  const Field& phi_;
  Index3 shape_;
  std::int64_t stride_y_;
  std::int64_t stride_z_;
  std::vector<float> values_;
  Index3 coordinates_{0};
  Index3 valid_{0};
  std::array<std::int32_t, 27> entries_{};
};

// How much phi changes over a voxel, summed over the axes: |grad phi| times the voxel's extent along the
// normal. By central differences; one-sided at the volume's border.
double change_over_voxel(const PageWithApron& phi, Index3 local, Index3 voxel, Index3 size) {
  double change = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    Index3 unit(0);
    unit[axis] = 1;
    const bool at_border = voxel[axis] == 0 || voxel[axis] + 1 == size[axis];
    change += std::abs(phi.at(local + unit) - phi.at(local - unit)) * (at_border ? 1.0 : 0.5);
  }
  return change;
}

// The area of the triangle or quadrilateral in which phi = 0, interpolated linearly, cuts a tetrahedron.
double area_in_tetrahedron(const std::array<glm::dvec3, 4>& corners, const std::array<double, 4>& phi) {
  std::array<std::size_t, 4> order{};  // corners inside first
  std::size_t inside = 0;
  std::size_t last = 4;
  for (std::size_t i = 0; i < 4; ++i) order[phi[i] > 0.0 ? inside++ : --last] = i;
  const auto crossing = [&](std::size_t a, std::size_t b) {
    const std::size_t i = order[a];
    const std::size_t j = order[b];
    return glm::mix(corners[i], corners[j], phi[i] / (phi[i] - phi[j]));
  };
  const auto triangle = [](glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    return 0.5 * glm::length(glm::cross(b - a, c - a));
  };
  if (inside == 1) return triangle(crossing(0, 1), crossing(0, 2), crossing(0, 3));
  if (inside == 3) return triangle(crossing(0, 3), crossing(1, 3), crossing(2, 3));
  if (inside != 2) return 0.0;
  const glm::dvec3 a = crossing(0, 2);
  const glm::dvec3 b = crossing(0, 3);
  const glm::dvec3 c = crossing(1, 3);
  const glm::dvec3 d = crossing(1, 2);
  return triangle(a, b, c) + triangle(a, c, d);
}

// A cell is divided into the six tetrahedra around its diagonal from corner 0 to corner 7.
double area_in_cell(const Cell& phi, glm::dvec3 spacing) {
  int inside = 0;
  for (const float value : phi) inside += value > 0.0F ? 1 : 0;
  if (inside == 0 || inside == 8) return 0.0;
  constexpr std::size_t kPaths[6][2] = {{1, 3}, {3, 2}, {2, 6}, {6, 4}, {4, 5}, {5, 1}};
  const auto corner = [&](std::size_t i) { return glm::dvec3(i & 1U, i >> 1U & 1U, i >> 2U) * spacing; };
  double area = 0.0;
  for (const auto& [a, b] : kPaths) {
    area +=
        area_in_tetrahedron({corner(0), corner(a), corner(b), corner(7)}, {phi[0], phi[a], phi[b], phi[7]});
  }
  return area;
}

// The share of a voxel that is inside: the surface is taken as a plane at distance phi / |grad phi|, and the
// share as linear in that distance over the voxel's extent along the normal.
double share_inside(double value, double change) {
  if (change == 0.0) return value > 0.0 ? 1.0 : 0.0;
  return std::clamp(0.5 + value / change, 0.0, 1.0);
}

template <class Visit>
void for_each_voxel(Index3 shape, Visit visit) {
  for (Index3 voxel(0); voxel.z < shape.z; ++voxel.z) {
    for (voxel.y = 0; voxel.y < shape.y; ++voxel.y) {
      for (voxel.x = 0; voxel.x < shape.x; ++voxel.x) visit(voxel);
    }
  }
}

}  // namespace

SurfaceStatistics measure(const Field& phi) {
  SurfaceStatistics result;
  const PageLayout& layout = phi.layout;
  const Geometry& geometry = phi.geometry;
  PageWithApron values(phi);
  double voxels = 0.0;
  for (std::int64_t page = 0; page < layout.page_count(); ++page) {
    const std::int32_t entry = phi.table[static_cast<std::size_t>(page)];
    if (entry == Field::kOutside) continue;
    const Index3 valid = layout.valid_shape(page);
    const std::int64_t count = valid.x * valid.y * valid.z;
    if (entry == Field::kInside) {
      result.voxels_inside += count;
      voxels += static_cast<double>(count);
      continue;
    }
    const Index3 first = layout.first_voxel(page);
    values.gather(page);
    for_each_voxel(valid, [&](Index3 local) {
      const Index3 voxel = first + local;
      const double value = values.at(local);
      if (value > 0.0) ++result.voxels_inside;
      if (std::abs(value) < phi.band) {
        voxels += share_inside(value, change_over_voxel(values, local, voxel, geometry.size));
      } else if (value > 0.0) {
        voxels += 1.0;
      }
      // A single slice goes on as it is for its thickness: its surface is its outline times that.
      if (geometry.contains(voxel + Index3(1, 1, geometry.size.z == 1 ? 0 : 1))) {
        result.surface_mm2 += area_in_cell(values.cell(local), geometry.spacing_mm);
      }
    });
  }
  result.volume_ml = voxels * phi.geometry.voxel_volume_ml();
  return result;
}

}  // namespace tidemark::solver
