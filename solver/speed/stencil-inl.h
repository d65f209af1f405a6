// The 19 values of phi around a voxel, and the differences that every speed term is made of.
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

#include "solver/model.h"
#include "solver/speed/numbers-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::HWY_NAMESPACE {

// phi at a voxel (c), at its face neighbours (xm: x - 1, xp: x + 1) and at its edge neighbours.
template <class V>
struct Stencil {
  V c;
  V xm, xp, ym, yp, zm, zp;
  V xmym, xmyp, xpym, xpyp;
  V xmzm, xmzp, xpzm, xpzp;
  V ymzm, ymzp, ypzm, ypzp;
};

// What the terms of one voxel share. Lengths are in units of the smallest spacing.
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
HWY_INLINE V sum_of_squares(const V (&v)[3]) {
  return mul_add(v[2], v[2], mul_add(v[1], v[1], v[0] * v[0]));
}

// Factors of the two upwind gradients.
template <class V>
struct UpwindWeights {
  V growing;
  V shrinking;
};

// kAnisotropic = false leaves out the divisions by spacings that are all 1.
template <bool kAnisotropic, class V, class Real>
HWY_INLINE Differences<V> differences(const Stencil<V>& s, const StepConstants<Real>& k) {
  Differences<V> d;
  d.phi = s.c;
  // To each neighbour: -D- and D+. By size, the two of an axis are the same for a mirrored field.
  const V behind[3] = {s.xm - s.c, s.ym - s.c, s.zm - s.c};
  const V ahead[3] = {s.xp - s.c, s.yp - s.c, s.zp - s.c};
  V lower[3];
  V higher[3];
  for (int axis = 0; axis < 3; ++axis) {
    d.second[axis] = ahead[axis] + behind[axis];
    d.two_central[axis] = ahead[axis] - behind[axis];
    lower[axis] = min(ahead[axis], behind[axis]);
    higher[axis] = max(ahead[axis], behind[axis]);
  }
  d.four_mixed[0] = (s.xpyp - s.xpym) - (s.xmyp - s.xmym);
  d.four_mixed[1] = (s.xpzp - s.xpzm) - (s.xmzp - s.xmzm);
  d.four_mixed[2] = (s.ypzp - s.ypzm) - (s.ymzp - s.ymzm);
  // The way to the neighbour that is least on phi's side.
  const V to_least =
      if_positive(s.c, min(min(lower[0], lower[1]), lower[2]), max(max(higher[0], higher[1]), higher[2]));
  d.lowest_product = s.c * (s.c + to_least);
  if constexpr (kAnisotropic) {
    const V inverse[3] = {V(k.inverse_spacing[0]), V(k.inverse_spacing[1]), V(k.inverse_spacing[2])};
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
  d.upwind_growing = sqrt(sum_of_squares(higher_up) + sum_of_squares(lower_up));
  d.upwind_shrinking = sqrt(sum_of_squares(higher_down) + sum_of_squares(lower_down));
  return d;
}

}  // namespace tidemark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
