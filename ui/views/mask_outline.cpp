#include "ui/views/mask_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace tidemark::ui {
namespace {

// How much of a point is inside: 0 to 1, between the middles of voxels by interpolation.
double inside_at(const Mask& mask, glm::dvec3 voxel) {
  const Index3 low(std::floor(voxel.x + 1e-6), std::floor(voxel.y + 1e-6), std::floor(voxel.z + 1e-6));
  const glm::dvec3 share = voxel - glm::dvec3(low);
  double inside = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Index3 step(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const Index3 at = low + step;
    if (!mask.geometry.contains(at) || mask.voxels[static_cast<std::size_t>(mask.geometry.offset(at))] == 0)
      continue;
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) weight *= step[axis] != 0 ? share[axis] : 1.0 - share[axis];
    inside += weight;
  }
  return inside;
}

// A lattice in the slice, on the middles of voxels where the slice lies along them.
struct Lattice {
  glm::dvec3 right, up, off_mm;  // off_mm: what a point of the slice has along neither
  glm::dvec2 first_mm{0.0};
  glm::dvec2 stride_mm{1.0};
  int columns = 0;
  int rows = 0;

  [[nodiscard]] QPointF at(double column, double row) const {
    return {first_mm.x + column * stride_mm.x, first_mm.y + row * stride_mm.y};
  }
  [[nodiscard]] glm::dvec3 patient_at(int column, int row) const {
    const QPointF point = at(column, row);
    return right * point.x() + up * point.y() + off_mm;
  }
};

Lattice lattice_in(const Geometry& geometry, const renderer::SliceOrientation& orientation,
                   glm::dvec3 position_mm) {
  Lattice lattice{orientation.right, orientation.up, {}, {}, {}, 0, 0};
  lattice.off_mm = position_mm - lattice.right * glm::dot(position_mm, lattice.right) -
                   lattice.up * glm::dot(position_mm, lattice.up);
  const std::array<glm::dvec3, 2> along{lattice.right, lattice.up};
  std::array<int, 2> counts{};
  for (int side = 0; side < 2; ++side) {
    const glm::dvec3 axis = along[static_cast<std::size_t>(side)];
    double spacing_mm = 0.0;
    double low_mm = std::numeric_limits<double>::infinity();
    double high_mm = -low_mm;
    for (int a = 0; a < 3; ++a) {
      const double share = glm::dot(axis, geometry.direction[a]);
      spacing_mm += share * share * geometry.spacing_mm[a];
    }
    for (int corner = 0; corner < 8; ++corner) {
      const glm::dvec3 voxel(Index3(corner & 1, corner >> 1 & 1, corner >> 2 & 1) *
                             (geometry.size - Index3(1)));
      const double place_mm = glm::dot(geometry.to_patient(voxel), axis);
      low_mm = std::min(low_mm, place_mm);
      high_mm = std::max(high_mm, place_mm);
    }
    // One more on each side: a mask may reach the border.
    lattice.stride_mm[side] = spacing_mm;
    lattice.first_mm[side] = low_mm - spacing_mm;
    counts[static_cast<std::size_t>(side)] =
        static_cast<int>(std::llround((high_mm - low_mm) / spacing_mm)) + 3;
  }
  lattice.columns = counts[0];
  lattice.rows = counts[1];
  return lattice;
}

}  // namespace

// Marching squares, at a half.
QList<QLineF> outline_in_slice(const Mask& mask, const renderer::SliceOrientation& orientation,
                               glm::dvec3 position_mm) {
  const Lattice lattice = lattice_in(mask.geometry, orientation, position_mm);
  const auto value_at = [&](int column, int row) {
    return inside_at(mask, mask.geometry.to_voxel(lattice.patient_at(column, row)));
  };
  QList<QLineF> lines;
  std::vector<double> below(static_cast<std::size_t>(lattice.columns));
  std::vector<double> above = below;
  for (int row = 0; row < lattice.rows; ++row) {
    std::swap(below, above);
    for (int column = 0; column < lattice.columns; ++column)
      above[static_cast<std::size_t>(column)] = value_at(column, row);
    if (row == 0) continue;
    for (int column = 1; column < lattice.columns; ++column) {
      const auto c = static_cast<std::size_t>(column);
      // Around the cell, from its lower left corner.
      const std::array<double, 4> values{below[c - 1], below[c], above[c], above[c - 1]};
      constexpr std::array<std::array<int, 2>, 4> kCorners{{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
      QList<QPointF> crossings;
      for (std::size_t side = 0; side < 4; ++side) {
        const std::size_t next = (side + 1) % 4;
        if ((values[side] < 0.5) == (values[next] < 0.5)) continue;
        const double share = (0.5 - values[side]) / (values[next] - values[side]);
        const double x = kCorners[side][0] + share * (kCorners[next][0] - kCorners[side][0]);
        const double y = kCorners[side][1] + share * (kCorners[next][1] - kCorners[side][1]);
        crossings << lattice.at(column + x, row + y);
      }
      for (qsizetype i = 0; i + 1 < crossings.size(); i += 2) lines << QLineF(crossings[i], crossings[i + 1]);
    }
  }
  return lines;
}

}  // namespace tidemark::ui
