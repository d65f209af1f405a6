// The equation made ready to be computed: parameters and grid as the numbers that kernels use.
#pragma once

#include <glm/vec3.hpp>

#include "core/volume.h"
#include "solver/parameters.h"

namespace tidemark::solver {

// Lengths are in units of the smallest voxel spacing, source values in the source's units. `Real` is double
// in the reference and float elsewhere.
template <class Real>
struct StepConstants {
  Real inverse_spacing[3];  // 1 / h of each axis
  Real time_step;           // dt
  Real band;                // W
  Real data_weight;         // alpha; 0 when the term is off
  Real curvature_weight;    // 1 - alpha; 0 when the term is off
  Real rescaling_weight;    // w; 0 when the term is off
  Real target_gradient;     // g_phi
  Real target;              // T
  Real near;                // |phi| of a voxel beside the surface is at most this: the largest spacing
  // D = max(data_floor, data_peak - data_slope |I - T|)
  Real data_peak;
  Real data_slope;
  Real data_floor;
};

// A level set's equation on its grid. The source's values bound raw D, and with it the time step.
class Model {
 public:
  Model(const Volume& source, const Parameters& parameters);

  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] double band() const { return band_; }  // W as resolved
  [[nodiscard]] double time_step() const { return time_step_; }
  [[nodiscard]] double smallest_spacing_mm() const { return smallest_spacing_mm_; }
  [[nodiscard]] glm::dvec3 spacing() const { return spacing_; }  // in units of the smallest

  template <class Real>
  [[nodiscard]] StepConstants<Real> constants() const;

 private:
  [[nodiscard]] double largest_data_speed(const Volume& source) const;
  [[nodiscard]] double stable_time_step(double largest_data) const;

  Parameters parameters_;
  glm::dvec3 spacing_{1.0};
  double smallest_spacing_mm_ = 1.0;
  double band_ = 2.5;
  double rescale_ = 0.3;
  double time_step_ = 0.0;
};

// max(2.5, 2 h_max / h_min): thick slices would stop the surface in a narrower band.
double default_band(const Geometry& geometry);

}  // namespace tidemark::solver
