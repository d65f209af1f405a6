// Rigid registration of two images by what they tell of one another, whatever made them.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>

#include "core/progress.h"
#include "core/volume.h"

namespace tidemark::imaging {

struct Registration {
  // From the moving image's patient coordinates (LPS, mm) to the fixed one's: a rotation and a shift.
  glm::dmat4 to_fixed{1.0};
  // The same for people: a turn about one axis, and the way of the moving image's centre.
  double rotation_degrees = 0.0;
  glm::dvec3 translation_mm{0.0};
  // Mattes' mutual information at the start and at the end. More is better; it compares within one pair
  // alone. None at a start from which the search did not begin.
  std::optional<double> information_before;
  double information_after = 0.0;
};

// Maximises the mutual information of the images (Mattes et al., IEEE TMI 22:120, 2003; ITK) over turns about
// the fixed image's centre and shifts, from coarse to fine in mm. The search begins at `start`, likewise from
// moving to fixed; where neither image's centre then lies in the other image, at their centres on one
// another. The numbers of `start` may be rounded. The same images give the same bits, whatever the number of
// threads. Fails (ErrorKind::usage), naming the grids, when the images share too little space, or one of them
// has a single value or a single slice.
Result<Registration> register_rigidly(const Volume& moving, const Volume& fixed,
                                      const glm::dmat4& start = glm::dmat4(1.0),
                                      const Progress& progress = {});

// The turn and the shift of a rigid transform for people; the shift is the way of `centre_mm`.
[[nodiscard]] Registration describe_rigid(const glm::dmat4& transform, glm::dvec3 centre_mm);

}  // namespace tidemark::imaging
