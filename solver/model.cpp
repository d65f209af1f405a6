#include "solver/model.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/gtx/component_wise.hpp>

namespace tidemark::solver {
namespace {

// Of neighbouring voxels, in mm: a single slice has none above it, however thick it is.
double largest_spacing(const Geometry& geometry) {
  double largest = glm::compMin(geometry.spacing_mm);
  for (int axis = 0; axis < 3; ++axis) {
    if (geometry.size[axis] > 1) largest = std::max(largest, geometry.spacing_mm[axis]);
  }
  return largest;
}

}  // namespace

double default_band(const Geometry& geometry) {
  return std::max(2.5, 2.0 * largest_spacing(geometry) / glm::compMin(geometry.spacing_mm));
}

Model::Model(const Geometry& geometry, const Parameters& parameters, const SpeedFunction& speed)
    : parameters_(parameters),
      smallest_spacing_mm_(glm::compMin(geometry.spacing_mm)),
      // Rounded to the executors' type, so that all of them clamp to the same value.
      band_(static_cast<float>(parameters.band.value_or(default_band(geometry)))) {
  spacing_ = geometry.spacing_mm / smallest_spacing_mm_;
  near_ = largest_spacing(geometry) / smallest_spacing_mm_;
  rescale_ = parameters.rescale.value_or(0.75 / band_);
  time_step_ = stable_time_step(parameters.data_term ? speed.largest() : 0.0,
                                speed.advects() ? speed.fastest_advection() : 0.0);
}

// Forward Euler: an advective part (data, rescaling and advection move the level sets at up to these speeds
// along every axis) and a diffusive part (curvature diffuses in the tangent plane, so the coarsest axis is
// left out).
double Model::stable_time_step(double largest_data, double fastest_advection) const {
  const glm::dvec3 inverse_squared = 1.0 / (spacing_ * spacing_);
  const double sum = glm::compAdd(inverse_squared);
  double speed = parameters_.alpha * largest_data + fastest_advection;
  // An unclamped field has no band; its rescaling weight is then 0 by default.
  if (parameters_.rescaling_term && rescale_ > 0.0) speed += rescale_ * band_;
  const double diffusion = parameters_.curvature_term ? 1.0 - parameters_.alpha : 0.0;
  const double rate = std::sqrt(sum) * speed + 2.0 * (sum - glm::compMin(inverse_squared)) * diffusion;
  if (!(rate > 0.0)) return 1.0;  // nothing moves
  const double scheme = parameters_.scheme == Scheme::paper ? 0.6 : 1.0;
  return scheme * 0.9 * parameters_.time_step_factor / rate;
}

template <class Real>
StepConstants<Real> Model::constants() const {
  StepConstants<Real> c{};
  for (int axis = 0; axis < 3; ++axis) c.inverse_spacing[axis] = static_cast<Real>(1.0 / spacing_[axis]);
  c.time_step = static_cast<Real>(time_step_);
  c.band = static_cast<Real>(band_);
  c.data_weight = static_cast<Real>(parameters_.data_term ? parameters_.alpha : 0.0);
  c.curvature_weight = static_cast<Real>(parameters_.curvature_term ? 1.0 - parameters_.alpha : 0.0);
  c.rescaling_weight = static_cast<Real>(parameters_.rescaling_term ? rescale_ : 0.0);
  c.target_gradient = static_cast<Real>(parameters_.target_gradient);
  c.near = static_cast<Real>(near_);
  return c;
}

template StepConstants<float> Model::constants<float>() const;
template StepConstants<double> Model::constants<double>() const;

}  // namespace tidemark::solver
