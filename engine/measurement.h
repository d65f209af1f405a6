// Distances and angles that a user measures on slices.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace tidemark::engine {

struct Measurement {
  enum class Kind { distance, angle };
  Kind kind = Kind::distance;
  // LPS, mm: the two ends; or an end, the vertex and the other end.
  std::vector<glm::dvec3> points_mm;

  [[nodiscard]] bool complete() const { return points_mm.size() == (kind == Kind::distance ? 2U : 3U); }
  [[nodiscard]] double value() const;  // mm, or degrees (0 to 180); 0 while it is not complete
  bool operator==(const Measurement&) const = default;
};

}  // namespace tidemark::engine
