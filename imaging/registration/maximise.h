// The search for the rigid transform with the most mutual information on one level. Private to this folder.
#pragma once

#include <glm/mat4x4.hpp>

#include "core/progress.h"
#include "core/volume.h"

namespace tidemark::imaging::registration {

struct Maximum {
  glm::dmat4 to_moving{1.0};  // from the fixed image's patient coordinates to the moving one's
  double information = 0.0;
};

// `to_moving` is a rotation and a shift. Steps begin with `step_mm` at the edge of the fixed image and end at
// a hundredth of it.
Result<Maximum> maximise(const Volume& moving, const Volume& fixed, const glm::dmat4& to_moving,
                         double step_mm, const Progress& progress);

// The mutual information at one transform.
Result<double> information(const Volume& moving, const Volume& fixed, const glm::dmat4& to_moving);

}  // namespace tidemark::imaging::registration
