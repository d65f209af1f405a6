// The place of a volume's voxels in the patient.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

#include "core/number_in.h"

namespace tidemark {

// (i, j, k): 0-based along columns, rows and slices; i runs fastest in memory.
using Index3 = glm::vec<3, std::int64_t>;

// A regular grid in patient coordinates: LPS (x to the patient's left, y to posterior, z to the head), in mm.
struct Geometry {
  Index3 size{0, 0, 0};        // voxels along i, j, k
  glm::dvec3 spacing_mm{1.0};  // distance of voxel centres along i, j, k
  glm::dmat3 direction{1.0};   // column a is the unit vector of axis a in LPS
  glm::dvec3 origin_mm{0.0};   // centre of voxel (0, 0, 0) in LPS
  bool oriented = true;        // false: nobody knows which sides of the patient x, y and z lead to

  bool operator==(const Geometry&) const = default;

  [[nodiscard]] std::int64_t voxel_count() const { return size.x * size.y * size.z; }
  // Where a voxel's value lies in memory, and the voxel whose value lies there.
  [[nodiscard]] std::int64_t offset(Index3 v) const { return number_in(size, v); }
  [[nodiscard]] Index3 voxel_at(std::int64_t offset) const {
    return {offset % size.x, offset / size.x % size.y, offset / (size.x * size.y)};
  }
  [[nodiscard]] bool contains(Index3 v) const {
    return v.x >= 0 && v.y >= 0 && v.z >= 0 && v.x < size.x && v.y < size.y && v.z < size.z;
  }
  [[nodiscard]] double voxel_volume_ml() const { return spacing_mm.x * spacing_mm.y * spacing_mm.z / 1000.0; }

  // Voxel coordinates (fractions allowed, integers at centres) to patient mm and back.
  [[nodiscard]] glm::dvec3 to_patient(glm::dvec3 voxel) const;
  [[nodiscard]] glm::dvec3 to_voxel(glm::dvec3 patient_mm) const;
  // Whether a place lies in the volume, to the outer faces of its voxels.
  [[nodiscard]] bool covers(glm::dvec3 patient_mm) const;
};

// Whether two geometries describe the same grid: sizes equal, positions within tolerance_mm at every corner.
[[nodiscard]] bool same_grid(const Geometry& a, const Geometry& b, double tolerance_mm);

}  // namespace tidemark
