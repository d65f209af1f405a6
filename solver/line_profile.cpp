#include "solver/line_profile.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "solver/surface_places.h"

namespace tidemark::solver {
namespace {

// Interpolated trilinearly at a place in voxel coordinates, clamped to the grid.
double value_at(const Volume& volume, glm::dvec3 place) {
  const Index3 last = volume.geometry.size - Index3(1);
  const glm::dvec3 inside = glm::clamp(place, glm::dvec3(0.0), glm::dvec3(last));
  const Index3 low(glm::floor(inside));
  const glm::dvec3 share = inside - glm::dvec3(low);
  double sum = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Index3 step(corner & 1, corner >> 1 & 1, corner >> 2);
    double weight = 1.0;
    for (int axis = 0; axis < 3; ++axis) weight *= step[axis] == 1 ? share[axis] : 1.0 - share[axis];
    if (weight > 0.0) sum += weight * volume.value(low + step);
  }
  return sum;
}

}  // namespace

LineProfile line_profile(const Field& phi, const Volume& source, glm::dvec3 from_mm, glm::dvec3 to_mm,
                         int count) {
  LineProfile profile;
  const Geometry& geometry = source.geometry;
  const double length_mm = glm::distance(from_mm, to_mm);
  for (int i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / (count - 1);
    const glm::dvec3 place_mm = glm::mix(from_mm, to_mm, share);
    if (!geometry.covers(place_mm)) continue;
    const glm::dvec3 place = geometry.to_voxel(place_mm);
    const ProfilePoint point{share * length_mm, phi_at(phi, place), value_at(source, place)};
    if (!profile.points.empty()) {
      const ProfilePoint& before = profile.points.back();
      if ((before.phi > 0.0) != (point.phi > 0.0))
        profile.crossings_mm.push_back(
            glm::mix(before.at_mm, point.at_mm, before.phi / (before.phi - point.phi)));
    }
    profile.points.push_back(point);
  }
  return profile;
}

}  // namespace tidemark::solver
