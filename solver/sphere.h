// Seeds, paint and erasers: spheres in patient space (paper section 6.2: "3D paint" and "3D eraser").
#pragma once

#include <glm/vec3.hpp>

#include "core/geometry.h"

namespace tidemark::solver {

struct Sphere {
  glm::dvec3 centre_mm{0.0};  // patient LPS
  double radius_mm = 0.0;

  bool operator==(const Sphere&) const = default;
};

enum class Brush { add, erase };

// A sphere around the centre of a voxel (fractions allowed).
inline Sphere sphere_at_voxel(const Geometry& geometry, glm::dvec3 voxel, double radius_mm) {
  return {geometry.to_patient(voxel), radius_mm};
}

}  // namespace tidemark::solver
