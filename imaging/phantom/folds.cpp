#include "imaging/phantom/folds.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/phantom/shapes.h"

namespace tidemark::imaging::phantom {
namespace {

constexpr double kTwoPi = 6.283185307179586;

// To 7e-5, the same on every machine (Abramowitz and Stegun 4.4.45).
double arc_sine(double x) {
  const double a = std::abs(x);
  const double p = 1.5707288 + a * (-0.2121144 + a * (0.0742610 - a * 0.0187293));
  const double angle = 0.25 * kTwoPi - std::sqrt(std::max(1.0 - a, 0.0)) * p;
  return x < 0 ? -angle : angle;
}

}  // namespace

Folds::Folds(std::uint64_t seed, const Shape& shape)
    : shape_(shape), field_(seed, 14, 0.8 * shape.wavelength_mm, 1.1 * shape.wavelength_mm) {}

double Folds::distance(double height_mm, const glm::dvec3& foot_mm, const glm::dvec3& normal,
                       double scale) const {
  const double above_valleys = height_mm + shape_.valley_mm;
  const double above_ridges = height_mm - shape_.ridge_mm;
  // Further away than the fillets reach the walls do not matter.
  if (above_ridges > 2.0 * shape_.fillet_mm) return above_ridges;
  if (above_valleys < -2.0 * shape_.fillet_mm) return above_valleys;

  // The distance to a wall along the envelope. For a single plane wave the arc sine makes it exact; and it
  // stays within a quarter of a wavelength where the field is flat.
  const RandomWaves::Sample field = field_.sample(foot_mm);
  const glm::dvec3 along = field.gradient - glm::dot(field.gradient, normal) * normal;
  const double steepness = kTwoPi / shape_.wavelength_mm;
  const double rise = steepness * field.value;
  const double sine = rise / std::sqrt(glm::dot(along, along) + rise * rise + 1e-9);
  const double wall = scale * arc_sine(sine) / steepness - shape_.widening_mm;
  const double ridge = round_intersection(above_ridges, wall, shape_.fillet_mm);
  return round_union(above_valleys, ridge, shape_.fillet_mm);
}

}  // namespace tidemark::imaging::phantom
