// A distance or an angle that was measured in a view.
#pragma once

#include <QString>
#include <glm/vec3.hpp>
#include <vector>

namespace tidemark {

struct Measurement {
  enum class Kind { distance, angle };
  Kind kind = Kind::distance;
  std::vector<glm::dvec3> points_mm;  // LPS: two ends, or an end, the corner and an end
  double value = 0.0;
  QString unit;  // "mm", "°"

  bool operator==(const Measurement&) const = default;
};

}  // namespace tidemark
