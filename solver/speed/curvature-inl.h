// The curvature term: kappa = div(grad phi / |grad phi|), the sum of the principal curvatures.

#if defined(TIDEMARK_SPEED_CURVATURE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TIDEMARK_SPEED_CURVATURE_INL_H_
#undef TIDEMARK_SPEED_CURVATURE_INL_H_
#else
#define TIDEMARK_SPEED_CURVATURE_INL_H_
#endif

#include "solver/speed/stencil-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::HWY_NAMESPACE {

// |grad phi|^2 below this is treated as this, so that kappa stays finite where phi has an extremum.
inline constexpr double kSmallestGradientSquared = 1e-3;
// Nothing smaller than a third of a voxel has a curvature.
inline constexpr double kLargestCurvature = 6.0;

template <class V>
struct Curvature {
  V kappa;     // per smallest spacing; < 0 on a ball
  V gradient;  // |grad phi|, central
};

// The direct form with second derivatives. 0 where phi is flat.
template <class Real, class V>
HWY_INLINE Curvature<V> curvature(const Differences<V>& d) {
  const V x2 = d.central[0] * d.central[0];
  const V y2 = d.central[1] * d.central[1];
  const V z2 = d.central[2] * d.central[2];
  const V xy = d.central[0] * d.central[1];
  const V xz = d.central[0] * d.central[2];
  const V yz = d.central[1] * d.central[2];
  const V pure = mul_add(d.second[0], y2 + z2, mul_add(d.second[1], x2 + z2, d.second[2] * (x2 + y2)));
  const V mixed = mul_add(xy, d.mixed[0], mul_add(xz, d.mixed[1], yz * d.mixed[2]));
  const V squared = max(x2 + y2 + z2, V(Real(kSmallestGradientSquared)));
  const V inverse = inverse_sqrt(squared);
  const V kappa = mul_add(mixed, V(Real(-2)), pure) * (inverse * inverse * inverse);
  const V limit = V(Real(kLargestCurvature));
  return {max(min(kappa, limit), V(Real(-kLargestCurvature))), squared * inverse};
}

}  // namespace tidemark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
