// Grids of tests, along the axes of the patient.
#pragma once

#include <glm/vec3.hpp>

#include "core/geometry.h"

namespace tidemark::test {

inline Geometry grid_of(Index3 size, glm::dvec3 spacing_mm = glm::dvec3(1.0),
                        glm::dvec3 origin_mm = glm::dvec3(0.0)) {
  Geometry grid;
  grid.size = size;
  grid.spacing_mm = spacing_mm;
  grid.origin_mm = origin_mm;
  return grid;
}

}  // namespace tidemark::test
