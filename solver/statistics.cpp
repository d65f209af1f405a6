#include "solver/statistics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

namespace tidemark {
namespace {

// The central difference at a voxel, in phi per mm; one-sided at the volume's border.
glm::dvec3 gradient_per_mm(const Field& phi, Index3 voxel) {
  glm::dvec3 gradient(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    Index3 low = voxel;
    Index3 high = voxel;
    low[axis] = std::max<std::int64_t>(0, voxel[axis] - 1);
    high[axis] = std::min(phi.geometry.size[axis] - 1, voxel[axis] + 1);
    if (low == high) continue;
    const double distance = static_cast<double>(high[axis] - low[axis]) * phi.geometry.spacing_mm[axis];
    gradient[axis] = (static_cast<double>(phi.at(high)) - static_cast<double>(phi.at(low))) / distance;
  }
  return gradient;
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

// The values of phi at the corners of a cell: corner (x, y, z) is element x + 2 y + 4 z.
using Cell = std::array<double, 8>;

// A cell is divided into the six tetrahedra around its diagonal from corner 0 to corner 7.
double area_in_cell(const Cell& phi, glm::dvec3 spacing) {
  const auto [low, high] = std::minmax_element(phi.begin(), phi.end());
  if (*low > 0.0 || *high <= 0.0) return 0.0;
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
double share_inside(const Field& phi, Index3 voxel, double value) {
  const glm::dvec3 gradient = gradient_per_mm(phi, voxel);
  const double extent = glm::dot(glm::abs(gradient), phi.geometry.spacing_mm);  // times |grad phi|
  if (extent == 0.0) return value > 0.0 ? 1.0 : 0.0;
  return std::clamp(0.5 + value / extent, 0.0, 1.0);
}

}  // namespace

SurfaceStatistics measure(const Field& phi) {
  SurfaceStatistics result;
  const PageLayout& layout = phi.layout;
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
    for (std::int64_t i = 0; i < count; ++i) {
      const Index3 voxel = first + Index3(i % valid.x, i / valid.x % valid.y, i / (valid.x * valid.y));
      const double value = phi.at(voxel);
      if (value > 0.0) ++result.voxels_inside;
      if (std::abs(value) < phi.band) {
        voxels += share_inside(phi, voxel, value);
      } else if (value > 0.0) {
        voxels += 1.0;
      }
      if (!phi.geometry.contains(voxel + Index3(1))) continue;
      Cell cell;
      for (std::size_t c = 0; c < 8; ++c) {
        cell[c] = phi.at(voxel + Index3(c & 1U, c >> 1U & 1U, c >> 2U));
      }
      result.surface_mm2 += area_in_cell(cell, phi.geometry.spacing_mm);
    }
  }
  result.volume_ml = voxels * phi.geometry.voxel_volume_ml();
  return result;
}

}  // namespace tidemark
