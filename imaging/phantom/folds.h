// A closed surface thrown into folds, as the brain's cortex is.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>

#include "imaging/phantom/noise.h"

namespace tidemark::imaging::phantom {

// Ridges and valleys with walls at right angles to a smooth envelope. Where they run is decided by the sign
// of a random field on the envelope, so that they branch and wind.
class Folds {
 public:
  struct Shape {
    double wavelength_mm = 18.0;  // of the random field: about a ridge and a valley
    double ridge_mm = 8.0;        // how far ridges rise above the envelope
    double valley_mm = 8.0;       // how far valleys sink below it
    double fillet_mm = 3.0;       // of the edges at the top and at the foot of the walls
    double widening_mm = 0.0;     // by which ridges grow on either side, at the expense of the valleys
  };
  Folds(std::uint64_t seed, const Shape& shape);

  // Signed distance (mm, < 0 inside) to the folded surface, exact to second order away from where three
  // walls meet. height_mm is the signed distance of the point to the envelope, foot_mm the point of the
  // envelope below it, and scale how many mm at the point are one mm at the foot.
  [[nodiscard]] double distance(double height_mm, const glm::dvec3& foot_mm, const glm::dvec3& normal,
                                double scale) const;

 private:
  Shape shape_;
  RandomWaves field_;
};

}  // namespace tidemark::imaging::phantom
