#include "ui/views/mask_outline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "ui/views/slice_lattice.h"

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

// All pages that are not outside throughout, and a voxel around them.
VoxelRange box_around(const solver::Field& phi) {
  VoxelRange box{phi.geometry.size, Index3(0)};
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (phi.pages.kind(page) == solver::Field::Kind::outside) continue;
    const Index3 first = phi.layout.first_voxel(page);
    box.low = glm::min(box.low, first);
    box.high = glm::max(box.high, first + phi.layout.valid_shape(page));
  }
  return box.empty() ? box : box.widened(Index3(1), phi.geometry.size);
}

// Marching squares at the level, where value_at(point in mm) is above it on one side.
template <class ValueAt>
QList<QLineF> outline_in(const SliceLattice& lattice, double level, const ValueAt& value_at) {
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

// Half way between voxels that are inside and others.
template <class IsInside>
QList<QLineF> outline_of_voxels(const Geometry& geometry, const SliceLattice& lattice,
                                const IsInside& is_inside) {
  return outline_in(lattice, 0.5, [&](glm::dvec3 point) {
    return interpolated(geometry.to_voxel(point), [&](Index3 voxel) { return is_inside(voxel) ? 1.0 : 0.0; });
  });
}

}  // namespace

QList<QLineF> outline_in_slice(const BitMask& mask, const renderer::SliceOrientation& orientation,
                               glm::dvec3 position_mm) {
  const Geometry& geometry = mask.geometry();
  const SliceLattice lattice = lattice_in(geometry, {Index3(0), geometry.size}, orientation, position_mm);
  return outline_of_voxels(geometry, lattice, [&](Index3 voxel) {
    return geometry.contains(voxel) && mask.contains(geometry.offset(voxel));
  });
}

QList<QLineF> outline_in_slice(const engine::LabelPreview& preview,
                               const renderer::SliceOrientation& orientation, glm::dvec3 position_mm) {
  QList<QLineF> lines;
  const Geometry& geometry = preview.from.geometry;
  const auto lattice_around = [&](const VoxelRange& box) {
    return lattice_in(geometry, box, orientation, position_mm);
  };
  for (const document::LabelRegion& part : preview.regions) {
    const Region& region = part.region;
    // The bounds cost a look at the whole region, where it has room in the slice at all.
    if (lattice_around({region.first(), region.first() + region.size()}).points() == 0) continue;
    lines += outline_of_voxels(geometry, lattice_around(region.bounds()),
                               [&](Index3 voxel) { return region.contains(voxel); });
  }
  return lines;
}

QList<QLineF> outline_in_slice(const solver::Field& phi, const renderer::SliceOrientation& orientation,
                               glm::dvec3 position_mm) {
  const Geometry& geometry = phi.geometry;
  const SliceLattice lattice = lattice_in(geometry, box_around(phi), orientation, position_mm);
  return outline_in(lattice, 0.0, [&](glm::dvec3 point) {
    return interpolated(geometry.to_voxel(point), [&](Index3 voxel) {
      return geometry.contains(voxel) ? static_cast<double>(phi.at(voxel)) : -phi.band;
    });
  });
}

}  // namespace tidemark::ui
