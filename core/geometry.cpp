#include "core/geometry.h"

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vector_relational.hpp>

namespace tidemark {

glm::dvec3 Geometry::to_patient(glm::dvec3 voxel) const {
  return origin_mm + direction * (voxel * spacing_mm);
}

glm::dvec3 Geometry::to_voxel(glm::dvec3 patient_mm) const {
  return (glm::inverse(direction) * (patient_mm - origin_mm)) / spacing_mm;
}

bool Geometry::covers(glm::dvec3 patient_mm) const {
  const glm::dvec3 voxel = to_voxel(patient_mm);
  return glm::all(glm::greaterThanEqual(voxel, glm::dvec3(-0.5))) &&
         glm::all(glm::lessThanEqual(voxel, glm::dvec3(size) - 0.5));
}

bool same_grid(const Geometry& a, const Geometry& b, double tolerance_mm) {
  if (a.size != b.size) return false;
  const glm::dvec3 last(a.size - Index3(1));
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 pick(corner & 1, (corner >> 1) & 1, (corner >> 2) & 1);
    if (glm::distance(a.to_patient(pick * last), b.to_patient(pick * last)) > tolerance_mm) return false;
  }
  return true;
}

}  // namespace tidemark
