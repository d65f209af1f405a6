// The parameters of the level-set equation, which the user steers (paper sections 2.1, 4.2 and 6.1).
#pragma once

#include <optional>

#include "core/result.h"

namespace tidemark::solver {

// How eq. 6 is discretised.
enum class Scheme {
  split,  // alpha D with the upwind gradient, (1 - alpha) kappa with the central one
  paper,  // one upwind gradient for the total speed, as the paper writes it; needs a smaller time step
};

// The data term D(I) of eq. 7.
enum class DataForm {
  clamped,  // max(-1, 1 - |I - T| / epsilon): alpha means the same for every epsilon
  raw,      // epsilon - |I - T|, unbounded below
};

struct Parameters {
  double target = 0.0;  // T, in the source's units
  double range = 1.0;   // epsilon, in the source's units; D > 0 for |I - T| < epsilon
  double alpha = 0.5;   // 0: curvature alone, 1: data alone

  // Half-width W of the band in which phi varies, in units of the smallest voxel spacing; unset:
  // max(2.5, 2 h_max / h_min). Infinity: phi is not clamped.
  std::optional<double> band;
  // Weight w of the rescaling term; unset: 0.75 / W.
  std::optional<double> rescale;
  double target_gradient = 1.0;  // g_phi of eq. 5

  Scheme scheme = Scheme::split;
  DataForm data_form = DataForm::clamped;

  // Each speed term can be switched off.
  bool data_term = true;
  bool curvature_term = true;
  bool rescaling_term = true;

  // Multiplies the largest stable time step; above 1 only to show that it is the largest.
  double time_step_factor = 1.0;

  bool operator==(const Parameters&) const = default;
};

// The smallest epsilon that is accepted, in the source's units: D has a finite slope.
inline constexpr double kMinimumRange = 1e-6;

// Fails (ErrorKind::usage) naming the parameter: epsilon below kMinimumRange, alpha outside [0, 1], W < 2,
// w < 0, a target gradient <= 0, or anything not finite where it must be.
Status check(const Parameters& parameters);

// The alpha of the paper's own eq. 6, whose D is not divided by epsilon, that balances the terms as ours:
// alpha_paper = alpha / (alpha + (1 - alpha) epsilon).
double paper_alpha(const Parameters& parameters);

}  // namespace tidemark::solver
