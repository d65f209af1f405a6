// The points of a slice at which outlines are looked for.
#pragma once

#include <QPointF>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/region.h"
#include "renderer/camera.h"

namespace tidemark::ui {

// A lattice in a slice, on the middles of voxels where the slice lies along them.
struct SliceLattice {
  glm::dvec3 right, up, off_mm;  // off_mm: what a point of the slice has along neither
  glm::dvec2 first_mm{0.0};
  glm::dvec2 stride_mm{1.0};
  int columns = 0;
  int rows = 0;

  [[nodiscard]] std::int64_t points() const { return std::int64_t{columns} * rows; }
  // Along the slice's right (x) and up (y) from the patient's origin, mm.
  [[nodiscard]] QPointF at(double column, double row) const {
    return {first_mm.x + column * stride_mm.x, first_mm.y + row * stride_mm.y};
  }
  [[nodiscard]] glm::dvec3 patient_at(int column, int row) const {
    const QPointF point = at(column, row);
    return right * point.x() + up * point.y() + off_mm;
  }
};

// Over a box of voxels and a point more on each side; no points where the slice is more than a voxel beside
// the box. `position_mm`: a point of the slice (LPS).
SliceLattice lattice_in(const Geometry& geometry, const VoxelRange& box,
                        const renderer::SliceOrientation& orientation, glm::dvec3 position_mm);

}  // namespace tidemark::ui
