// The data term D(I) (paper eq. 7): the surface grows where the source is within epsilon of T.

#if defined(TIDEMARK_SPEED_DATA_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TIDEMARK_SPEED_DATA_INL_H_
#undef TIDEMARK_SPEED_DATA_INL_H_
#else
#define TIDEMARK_SPEED_DATA_INL_H_
#endif

#include "solver/model.h"
#include "solver/speed/numbers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::solver::HWY_NAMESPACE {

// D at source value `source`: 1 (clamped form) or epsilon (raw form) at T, 0 at T -+ epsilon.
template <class V, class Real>
HWY_INLINE V data_speed(V source, const StepConstants<Real>& k) {
  const V distance = abs(source - V(k.target));
  return max(neg_mul_add(distance, V(k.data_slope), V(k.data_peak)), V(k.data_floor));
}

// How far the data term moves the surface in a step: dt alpha D.
template <class V, class Real>
HWY_INLINE V data_motion(V source, const StepConstants<Real>& k) {
  return V(k.time_step) * V(k.data_weight) * data_speed(source, k);
}

}  // namespace tidemark::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
