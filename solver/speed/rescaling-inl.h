// The rescaling term G_r (paper eq. 5): keeps phi a clamped distance transform.

#if defined(TIDEMARK_SPEED_RESCALING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TIDEMARK_SPEED_RESCALING_INL_H_
#undef TIDEMARK_SPEED_RESCALING_INL_H_
#else
#define TIDEMARK_SPEED_RESCALING_INL_H_
#endif

#include "solver/speed/stencil-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::solver::HWY_NAMESPACE {

// The product of phi with a neighbour of the other sign at which that neighbour counts in full.
inline constexpr double kFullSignChange = 0.1;

// The share of the two one-sided gradients in |grad phi| here. At 1 the one from the surface's side counts
// alone. At 0, beside the surface, their mean counts, which moves the surface by about a tenth of a
// voxel. The transition is continuous as a neighbour changes sign: with a switch voxels would flip between
// both for ever, and the surface would never stop.
template <class Real, class V>
HWY_INLINE V one_sidedness(const Differences<V>& d) {
  const V one = V(Real(1));
  return max(min(mul_add(d.lowest_product, V(Real(1.0 / kFullSignChange)), one), one), V(Real(0)));
}

// G_r = phi (g_phi - |grad phi|) alone, for pictures; a step has it in the weights of its gradients
// (update-inl.h).
template <class Real, class V>
HWY_INLINE V rescaling_speed(const Differences<V>& d, V target_gradient) {
  const V mean = d.phi * (d.upwind_growing + d.upwind_shrinking);
  const V one_sided = abs(d.phi) * one_sidedness<Real>(d) * (d.upwind_growing - d.upwind_shrinking);
  return mul_add(d.phi, target_gradient, V(Real(0.5)) * (one_sided - mean));
}

}  // namespace tidemark::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
