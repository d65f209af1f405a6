// The curvature term: kappa = div(grad phi / |grad phi|), the sum of the principal curvatures.

#if defined(TIDEMARK_SPEED_CURVATURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TIDEMARK_SPEED_CURVATURE_INL_H_
#undef TIDEMARK_SPEED_CURVATURE_INL_H_
#else
#define TIDEMARK_SPEED_CURVATURE_INL_H_
#endif

#include "solver/speed/stencil-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::solver::HWY_NAMESPACE {

// |grad phi|^2 below this is treated as this, so that kappa stays finite where phi has an extremum.
inline constexpr double kSmallestGradientSquared = 1e-3;
// Nothing smaller than a third of a voxel has a curvature.
inline constexpr double kLargestCurvature = 6.0;

// kappa |grad phi|, the curvature term's part of dphi/dt, by the direct form with second derivatives and
// the central gradient g: tr(H) - (g . H g) / |g|^2. It is bounded by phi's second derivatives, and 0 where
// phi is flat.
template <class Real, class V>
HWY_INLINE V curvature_motion(const Differences<V>& d, V& four_squared_gradient) {
  const V* g = d.two_central;
  const V x2 = g[0] * g[0];
  const V y2 = g[1] * g[1];
  const V z2 = g[2] * g[2];
  const V squared = x2 + y2 + z2;
  const V trace = d.second[0] + d.second[1] + d.second[2];
  const V pure = mul_add(x2, d.second[0], mul_add(y2, d.second[1], z2 * d.second[2]));
  const V two_mixed =
      mul_add(g[0], mul_add(g[1], d.four_mixed[0], g[2] * d.four_mixed[1]), g[1] * (g[2] * d.four_mixed[2]));
  const V along_gradient = mul_add(two_mixed, V(Real(0.5)), pure);
  four_squared_gradient = max(squared, V(Real(4.0 * kSmallestGradientSquared)));
  return mul_sub(squared, trace, along_gradient) * inverse(four_squared_gradient);
}

template <class Real, class V>
HWY_INLINE V curvature_motion(const Differences<V>& d) {
  V four_squared_gradient;
  return curvature_motion<Real>(d, four_squared_gradient);
}

// kappa per smallest spacing; < 0 on a ball.
template <class Real, class V>
HWY_INLINE V curvature(const Differences<V>& d) {
  V four_squared_gradient;
  const V motion = curvature_motion<Real>(d, four_squared_gradient);
  const V kappa = motion * V(Real(2)) / sqrt(four_squared_gradient);
  const V limit = V(Real(kLargestCurvature));
  return max(min(kappa, limit), V(Real(-kLargestCurvature)));
}

}  // namespace tidemark::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
