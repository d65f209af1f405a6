// The advection term -v . grad phi (paper eq. 1), upwinded.

#if defined(TIDEMARK_SPEED_ADVECTION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TIDEMARK_SPEED_ADVECTION_INL_H_
#undef TIDEMARK_SPEED_ADVECTION_INL_H_
#else
#define TIDEMARK_SPEED_ADVECTION_INL_H_
#endif

#include "solver/speed/stencil-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::solver::HWY_NAMESPACE {

// v of a step: dt v / h of each axis.
template <class V>
struct StepVelocity {
  V x, y, z;
};

// What the term adds to phi in a step. Each axis takes the difference from where the flow comes.
template <class V>
HWY_INLINE V advected(const Stencil<V>& s, const StepVelocity<V>& v) {
  const V zero = V(0.0F);
  const auto axis = [&](V before, V after, V along) HWY_ATTR {
    return mul_add(max(along, zero), s.c - before, min(along, zero) * (after - s.c));
  };
  return zero - (axis(s.xm, s.xp, v.x) + axis(s.ym, s.yp, v.y) + axis(s.zm, s.zp, v.z));
}

}  // namespace tidemark::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
