#include "ui/views/mask_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace tidemark::ui {
namespace {

// The value at a point between the middles of voxels by interpolation; `value` is called for voxels, inside
// the grid or not.
template <class Value>
double interpolated(glm::dvec3 voxel, const Value& value) {
  constexpr double kOnMiddle = 1e-6;
  const Index3 low(std::floor(voxel.x + kOnMiddle), std::floor(voxel.y + kOnMiddle),
                   std::floor(voxel.z + kOnMiddle));
  const glm::dvec3 share = voxel - glm::dvec3(low);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Index3 step(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) weight *= step[axis] != 0 ? share[axis] : 1.0 - share[axis];
    if (std::abs(weight) > kOnMiddle) sum += weight * value(low + step);
  }
  return sum;
}

// A box of voxels, both ends included.
struct VoxelBox {
  Index3 low{0};
  Index3 high{0};
};

// All pages that are not outside throughout, and a voxel around them.
VoxelBox box_around(const solver::Field& phi) {
  VoxelBox box{phi.geometry.size, Index3(-1)};
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (phi.pages.kind(page) == solver::Field::Kind::outside) continue;
    const Index3 first = phi.layout.first_voxel(page);
    box.low = glm::min(box.low, first);
    box.high = glm::max(box.high, first + phi.layout.valid_shape(page) - Index3(1));
  }
  return {glm::max(box.low - Index3(1), Index3(0)),
          glm::min(box.high + Index3(1), phi.geometry.size - Index3(1))};
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

Lattice lattice_in(const Geometry& geometry, const VoxelBox& box,
                   const renderer::SliceOrientation& orientation, glm::dvec3 position_mm) {
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
      const glm::dvec3 voxel(corner & 1 ? box.high.x : box.low.x, corner & 2 ? box.high.y : box.low.y,
                             corner & 4 ? box.high.z : box.low.z);
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

// Marching squares at the level, where value_at(point in mm) is above it on one side.
template <class ValueAt>
QList<QLineF> outline_in(const Lattice& lattice, double level, const ValueAt& value_at) {
  QList<QLineF> lines;
  std::vector<double> below(static_cast<std::size_t>(lattice.columns));
  std::vector<double> above = below;
  for (int row = 0; row < lattice.rows; ++row) {
    std::swap(below, above);
    for (int column = 0; column < lattice.columns; ++column)
      above[static_cast<std::size_t>(column)] = value_at(lattice.patient_at(column, row));
    if (row == 0) continue;
    for (int column = 1; column < lattice.columns; ++column) {
      const auto c = static_cast<std::size_t>(column);
      // Around the cell, from its lower left corner.
      const std::array<double, 4> values{below[c - 1], below[c], above[c], above[c - 1]};
      constexpr std::array<std::array<int, 2>, 4> kCorners{{{-1, -1}, {0, -1}, {0, 0}, {-1, 0}}};
      QList<QPointF> crossings;
      for (std::size_t side = 0; side < 4; ++side) {
        const std::size_t next = (side + 1) % 4;
        if ((values[side] < level) == (values[next] < level)) continue;
        const double share = (level - values[side]) / (values[next] - values[side]);
        const double x = kCorners[side][0] + share * (kCorners[next][0] - kCorners[side][0]);
        const double y = kCorners[side][1] + share * (kCorners[next][1] - kCorners[side][1]);
        crossings << lattice.at(column + x, row + y);
      }
      for (qsizetype i = 0; i + 1 < crossings.size(); i += 2) lines << QLineF(crossings[i], crossings[i + 1]);
    }
  }
  return lines;
}

// Half way between voxels that are inside and others; all that are lie in the box.
template <class IsInside>
QList<QLineF> outline_of_voxels(const Geometry& geometry, const VoxelBox& box,
                                const renderer::SliceOrientation& orientation, glm::dvec3 position_mm,
                                const IsInside& is_inside) {
  return outline_in(lattice_in(geometry, box, orientation, position_mm), 0.5, [&](glm::dvec3 point) {
    return interpolated(geometry.to_voxel(point), [&](Index3 voxel) { return is_inside(voxel) ? 1.0 : 0.0; });
  });
}

}  // namespace

QList<QLineF> outline_in_slice(const Mask& mask, const renderer::SliceOrientation& orientation,
                               glm::dvec3 position_mm) {
  const Geometry& geometry = mask.geometry;
  const VoxelBox whole{Index3(0), geometry.size - Index3(1)};
  return outline_of_voxels(geometry, whole, orientation, position_mm, [&](Index3 voxel) {
    return geometry.contains(voxel) && mask.voxels[static_cast<std::size_t>(geometry.offset(voxel))] != 0;
  });
}

QList<QLineF> outline_in_slice(const engine::LabelPreview& preview,
                               const renderer::SliceOrientation& orientation, glm::dvec3 position_mm) {
  QList<QLineF> lines;
  for (const document::LabelRegion& part : preview.regions) {
    const VoxelRange bounds = part.region.bounds();
    if (bounds.empty()) continue;
    lines += outline_of_voxels(preview.from.geometry, {bounds.low, bounds.high - Index3(1)}, orientation,
                               position_mm, [&](Index3 voxel) { return part.region.contains(voxel); });
  }
  return lines;
}

QList<QLineF> outline_in_slice(const solver::Field& phi, const renderer::SliceOrientation& orientation,
                               glm::dvec3 position_mm) {
  const Geometry& geometry = phi.geometry;
  const VoxelBox box = box_around(phi);
  if (box.high.x < box.low.x) return {};
  return outline_in(lattice_in(geometry, box, orientation, position_mm), 0.0, [&](glm::dvec3 point) {
    return interpolated(geometry.to_voxel(point), [&](Index3 voxel) {
      return geometry.contains(voxel) ? static_cast<double>(phi.at(voxel)) : -phi.band;
    });
  });
}

}  // namespace tidemark::ui
