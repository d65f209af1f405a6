// The values of phi around a voxel that the equation reads, and the differences in every speed term.
//
// The headers of this folder are written once for any kind of number V: the reference computes with double,
// the host executor with vectors of float, compiled anew for each instruction set. V has + - * and the
// functions of numbers-inl.h. Every formula treats +x and -x alike, so that mirrored fields give mirrored
// results to the last bit.

// Highway's per-target include guard.
#if defined(TIDEMARK_SPEED_STENCIL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TIDEMARK_SPEED_STENCIL_INL_H_
#undef TIDEMARK_SPEED_STENCIL_INL_H_
#else
#define TIDEMARK_SPEED_STENCIL_INL_H_
#endif

#include "solver/speed/numbers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::solver::HWY_NAMESPACE {

// phi at a voxel (c), at its face neighbours (xm: x - 1, xp: x + 1) and at those of its edge neighbours that
// have its x. The others are read as differences phi(x + 1) - phi(x - 1): here (dx) and at face neighbours.
template <class V>
struct Stencil {
  V c;
  V xm, xp, ym, yp, zm, zp;
  V ymzm, ymzp, ypzm, ypzp;
  V dx, dx_ym, dx_yp, dx_zm, dx_zp;
};

// The differences that the terms of one voxel share. Lengths are in units of the smallest spacing.
template <class V>
struct Differences {
  V phi;
  V two_central[3];    // twice the central first differences
  V second[3];         // pure second differences
  V four_mixed[3];     // four times d2/dxdy, d2/dxdz, d2/dydz
  V upwind_growing;    // |grad phi| for a speed F > 0 (Osher and Sethian)
  V upwind_shrinking;  // |grad phi| for a speed F < 0
  V lowest_product;    // least product of phi with a face neighbour: < 0 beside the surface
};

template <class V>
HWY_INLINE V sum_of_squares(const V (&a)[3], const V (&b)[3]) {
  const V sum = mul_add(a[2], a[2], mul_add(a[1], a[1], a[0] * a[0]));
  return mul_add(b[2], b[2], mul_add(b[1], b[1], mul_add(b[0], b[0], sum)));
}

// `inverse` are the inverse spacings; kAnisotropic = false leaves out the divisions by spacings that are
// all 1.
template <bool kAnisotropic, class Real, class V>
HWY_INLINE Differences<V> differences(const Stencil<V>& s, const V (&inverse)[3]) {
  Differences<V> d;
  d.phi = s.c;
  // The neighbours of an axis by size are the same for a mirrored field.
  const V low[3] = {min(s.xm, s.xp), min(s.ym, s.yp), min(s.zm, s.zp)};
  const V high[3] = {max(s.xm, s.xp), max(s.ym, s.yp), max(s.zm, s.zp)};
  // One-sided differences: D+ and -D-, by size, too.
  V lower[3];
  V higher[3];
  for (int axis = 0; axis < 3; ++axis) {
    lower[axis] = low[axis] - s.c;
    higher[axis] = high[axis] - s.c;
    d.second[axis] = higher[axis] + lower[axis];
  }
  d.two_central[0] = s.dx;
  d.two_central[1] = s.yp - s.ym;
  d.two_central[2] = s.zp - s.zm;
  d.four_mixed[0] = s.dx_yp - s.dx_ym;
  d.four_mixed[1] = s.dx_zp - s.dx_zm;
  d.four_mixed[2] = (s.ypzp - s.ypzm) - (s.ymzp - s.ymzm);
  // The lowest neighbour gives it where phi > 0, the highest where phi < 0.
  const V lowest = min(min(low[0], low[1]), low[2]);
  const V highest = max(max(high[0], high[1]), high[2]);
  d.lowest_product = min(s.c * lowest, s.c * highest);
  if constexpr (kAnisotropic) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = lower[axis] * inverse[axis];
      higher[axis] = higher[axis] * inverse[axis];
      d.two_central[axis] = d.two_central[axis] * inverse[axis];
      d.second[axis] = d.second[axis] * (inverse[axis] * inverse[axis]);
    }
    d.four_mixed[0] = d.four_mixed[0] * (inverse[0] * inverse[1]);
    d.four_mixed[1] = d.four_mixed[1] * (inverse[0] * inverse[2]);
    d.four_mixed[2] = d.four_mixed[2] * (inverse[1] * inverse[2]);
  }

  // A surface that grows looks at the neighbours above, one that shrinks at those below.
  const V zero = V(Real(0));
  V higher_up[3];
  V lower_up[3];
  V higher_down[3];
  V lower_down[3];
  for (int axis = 0; axis < 3; ++axis) {
    higher_up[axis] = max(higher[axis], zero);
    lower_up[axis] = max(lower[axis], zero);
    higher_down[axis] = min(higher[axis], zero);
    lower_down[axis] = min(lower[axis], zero);
  }
  // In this order -phi, where higher and lower change places, gives the same sums.
  d.upwind_growing = sqrt(sum_of_squares(higher_up, lower_up));
  d.upwind_shrinking = sqrt(sum_of_squares(lower_down, higher_down));
  return d;
}

}  // namespace tidemark::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
