// phi and brightness along a line.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "core/volume.h"
#include "solver/field.h"

namespace tidemark::solver {

struct ProfilePoint {
  double at_mm = 0.0;  // from the line's beginning
  double phi = 0.0;    // smallest spacings, > 0 inside
  double value = 0.0;  // of the source, in its units

  bool operator==(const ProfilePoint&) const = default;
};

struct LineProfile {
  std::vector<ProfilePoint> points;
  std::vector<double> crossings_mm;  // where phi = 0, from the line's beginning
};

// At `count` >= 2 places, evenly from one end to the other (LPS, mm), interpolated trilinearly. Places
// outside of the volume are left out; beyond the outer voxels' centres their values go on. phi and source are
// on one grid.
[[nodiscard]] LineProfile line_profile(const Field& phi, const Volume& source, glm::dvec3 from_mm,
                                       glm::dvec3 to_mm, int count);

}  // namespace tidemark::solver
