#include "solver/parameters.h"

#include <cmath>

namespace tidemark::solver {

Status check(const Parameters& p) {
  if (!std::isfinite(p.target)) return fail(ErrorKind::usage, "target T must be a number");
  if (!std::isfinite(p.range) || p.range < kMinimumRange) {
    return fail(ErrorKind::usage, "range epsilon must be at least {}, got {}", kMinimumRange, p.range);
  }
  if (!(p.alpha >= 0.0 && p.alpha <= 1.0)) {
    return fail(ErrorKind::usage, "alpha must be between 0 and 1, got {}", p.alpha);
  }
  // The 19-value stencil needs two voxels on each side of the surface.
  if (p.band && !(*p.band >= 2.0)) {
    return fail(ErrorKind::usage, "band W must be at least 2 voxels, got {}", *p.band);
  }
  if (p.rescale && !(std::isfinite(*p.rescale) && *p.rescale >= 0.0)) {
    return fail(ErrorKind::usage, "rescale w must be 0 or more, got {}", *p.rescale);
  }
  if (!(std::isfinite(p.target_gradient) && p.target_gradient > 0.0)) {
    return fail(ErrorKind::usage, "target gradient must be above 0, got {}", p.target_gradient);
  }
  if (!(std::isfinite(p.time_step_factor) && p.time_step_factor > 0.0)) {
    return fail(ErrorKind::usage, "time step factor must be above 0, got {}", p.time_step_factor);
  }
  return {};
}

double paper_alpha(const Parameters& p) {
  return p.alpha == 0.0 ? 0.0 : p.alpha / (p.alpha + (1.0 - p.alpha) * p.range);
}

}  // namespace tidemark::solver
