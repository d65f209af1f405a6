// One explicit step of dphi/dt (paper eq. 5 to 7): the sum of the speed terms.

#if defined(TIDEMARK_SPEED_UPDATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TIDEMARK_SPEED_UPDATE_INL_H_
#undef TIDEMARK_SPEED_UPDATE_INL_H_
#else
#define TIDEMARK_SPEED_UPDATE_INL_H_
#endif

#include "solver/speed/curvature-inl.h"
#include "solver/speed/data-inl.h"
#include "solver/speed/rescaling-inl.h"
#include "solver/speed/stencil-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::HWY_NAMESPACE {

// The new phi of a voxel. kPaper: eq. 6 literally, with one upwind gradient for the total speed.
//
// dphi/dt is linear in the upwind gradients. Their weights are put together first, which a processor does
// while it draws the roots of the gradients.
template <bool kPaper, class V, class Real>
HWY_INLINE V updated_phi(const Differences<V>& d, V source, const StepConstants<Real>& k) {
  const V zero = V(Real(0));
  const V data = V(k.data_weight) * data_speed(source, k);
  const V upwind_speed = kPaper ? data + V(k.curvature_weight) * curvature<Real>(d) : data;
  UpwindWeights<V> weights{max(upwind_speed, zero), min(upwind_speed, zero)};

  // w phi (g_phi - |grad phi|)
  const V rescaling = V(k.rescaling_weight) * d.phi;
  const UpwindWeights<V> shares = rescaling_shares<Real>(d);
  weights.growing = neg_mul_add(rescaling, shares.growing, weights.growing);
  weights.shrinking = neg_mul_add(rescaling, shares.shrinking, weights.shrinking);
  V change = rescaling * V(k.target_gradient);

  if constexpr (!kPaper) change = mul_add(V(k.curvature_weight), curvature_motion<Real>(d), change);
  // Not fused: inside and outside are alike to the last bit.
  change = change + (weights.growing * d.upwind_growing + weights.shrinking * d.upwind_shrinking);
  const V phi = mul_add(V(k.time_step), change, d.phi);
  return max(min(phi, V(k.band)), V(k.minus_band));
}

}  // namespace tidemark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
