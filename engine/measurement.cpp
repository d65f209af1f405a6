#include "engine/measurement.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace tidemark::engine {

double Measurement::value() const {
  if (!complete()) return 0.0;
  if (kind == Kind::distance) return glm::distance(points_mm[0], points_mm[1]);
  const glm::dvec3 a = points_mm[0] - points_mm[1];
  const glm::dvec3 b = points_mm[2] - points_mm[1];
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

}  // namespace tidemark::engine
