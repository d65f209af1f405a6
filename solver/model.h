// The equation made ready to be computed: parameters and grid as the numbers that kernels use.
#pragma once

#include <glm/vec3.hpp>

#include "core/volume.h"
#include "solver/parameters.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

// Lengths are in units of the smallest voxel spacing. `Real` is double in the reference and float elsewhere.
template <class Real>
struct StepConstants {
  Real inverse_spacing[3];  // 1 / h of each axis
  Real time_step;           // dt
  Real band;                // W
  Real data_weight;         // alpha; 0 when the term is off
  Real curvature_weight;    // 1 - alpha; 0 when the term is off
  Real rescaling_weight;    // w; 0 when the term is off
  Real target_gradient;     // g_phi
  Real near;                // |phi| of a voxel beside the surface is at most this: h_max
};

// A level set's equation on its grid. The largest speed bounds the time step.
class Model {
 public:
  Model(const Geometry& geometry, const Parameters& parameters, const SpeedFunction& speed);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] double band() const { return band_; }  // W as resolved
  [[nodiscard]] double time_step() const { return time_step_; }
  [[nodiscard]] double smallest_spacing_mm() const { return smallest_spacing_mm_; }
  [[nodiscard]] glm::dvec3 spacing() const { return spacing_; }  // in units of the smallest

  template <class Real>
  [[nodiscard]] StepConstants<Real> constants() const;

 private:
  [[nodiscard]] double stable_time_step(double largest_data, double fastest_advection) const;

  Parameters parameters_;
  glm::dvec3 spacing_{1.0};
  double smallest_spacing_mm_ = 1.0;
  double near_ = 1.0;
  double band_ = 2.5;
  double rescale_ = 0.3;
  double time_step_ = 0.0;
};

// max(2.5, 2 h_max / h_min): thick slices would stop the surface in a narrower band. An axis of one voxel is
// no h_max, as no surface moves along it.
double default_band(const Geometry& geometry);

}  // namespace tidemark::solver
