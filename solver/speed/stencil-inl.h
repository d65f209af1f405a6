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

// kAnisotropic = false leaves out the divisions by spacings that are all 1.
template <bool kAnisotropic, class V, class Real>
HWY_INLINE Differences<V> differences(const Stencil<V>& s, const StepConstants<Real>& k) {
  Differences<V> d;
  d.phi = s.c;
  // One-sided first differences D- and D+.
  V minus[3] = {s.c - s.xm, s.c - s.ym, s.c - s.zm};
  V plus[3] = {s.xp - s.c, s.yp - s.c, s.zp - s.c};
  for (int axis = 0; axis < 3; ++axis) {
    d.second[axis] = plus[axis] - minus[axis];
    d.two_central[axis] = plus[axis] + minus[axis];
  }
  d.four_mixed[0] = (s.xpyp - s.xpym) - (s.xmyp - s.xmym);
  d.four_mixed[1] = (s.xpzp - s.xpzm) - (s.xmzp - s.xmzm);
  d.four_mixed[2] = (s.ypzp - s.ypzm) - (s.ymzp - s.ymzm);
  if constexpr (kAnisotropic) {
    const V inverse[3] = {V(k.inverse_spacing[0]), V(k.inverse_spacing[1]), V(k.inverse_spacing[2])};
    for (int axis = 0; axis < 3; ++axis) {
      minus[axis] = minus[axis] * inverse[axis];
      plus[axis] = plus[axis] * inverse[axis];
      d.two_central[axis] = d.two_central[axis] * inverse[axis];
      d.second[axis] = d.second[axis] * (inverse[axis] * inverse[axis]);
    }
    d.four_mixed[0] = d.four_mixed[0] * (inverse[0] * inverse[1]);
    d.four_mixed[1] = d.four_mixed[1] * (inverse[0] * inverse[2]);
    d.four_mixed[2] = d.four_mixed[2] * (inverse[1] * inverse[2]);
  }

  const V zero = V(Real(0));
  V growing[3];
  V shrinking[3];
  for (int axis = 0; axis < 3; ++axis) {
    const V rise_ahead = max(plus[axis], zero);
    const V fall_behind = min(minus[axis], zero);
    const V fall_ahead = min(plus[axis], zero);
    const V rise_behind = max(minus[axis], zero);
    growing[axis] = rise_ahead * rise_ahead + fall_behind * fall_behind;
    shrinking[axis] = fall_ahead * fall_ahead + rise_behind * rise_behind;
  }
  d.upwind_growing = sqrt(growing[0] + growing[1] + growing[2]);
  d.upwind_shrinking = sqrt(shrinking[0] + shrinking[1] + shrinking[2]);
  d.lowest_product =
      min(min(min(s.xm * s.c, s.xp * s.c), min(s.ym * s.c, s.yp * s.c)), min(s.zm * s.c, s.zp * s.c));
  return d;
}

}  // namespace tidemark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
