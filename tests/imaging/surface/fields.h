// Fields phi with a known surface: clamped signed distances in units of the smallest spacing, as the
// solver's.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>

#include "core/volume.h"

namespace tidemark::test {

inline Geometry grid(Index3 size, glm::dvec3 spacing_mm = glm::dvec3(1.0)) {
  Geometry geometry;
  geometry.size = size;
  geometry.spacing_mm = spacing_mm;
  return geometry;
}

// distance_mm(voxel * spacing) is > 0 inside.
inline Volume field(const Geometry& geometry, const std::function<double(glm::dvec3)>& distance_mm) {
  const glm::dvec3 h = geometry.spacing_mm;
  const double smallest = std::min({h.x, h.y, h.z});
  const double largest = std::max({h.x, h.y, h.z});
  const double clamp = std::max(2.5, 2.0 * largest / smallest);
  Volume phi;
  phi.geometry = geometry;
  std::vector<float> values(static_cast<std::size_t>(geometry.voxel_count()));
  for (std::int64_t k = 0; k < geometry.size.z; ++k) {
    for (std::int64_t j = 0; j < geometry.size.y; ++j) {
      for (std::int64_t i = 0; i < geometry.size.x; ++i) {
        const double distance = distance_mm(glm::dvec3(i, j, k) * h) / smallest;
        values[static_cast<std::size_t>(geometry.offset({i, j, k}))] =
            static_cast<float>(std::clamp(distance, -clamp, clamp));
      }
    }
  }
  phi.voxels = std::move(values);
  return phi;
}

inline std::function<double(glm::dvec3)> ball(glm::dvec3 centre_mm, double radius_mm) {
  return [=](glm::dvec3 p) { return radius_mm - glm::distance(p, centre_mm); };
}

}  // namespace tidemark::test
