// One explicit step of dphi/dt (paper eq. 5 to 7): the sum of the speed terms.

#if defined(TIDEMARK_SPEED_UPDATE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TIDEMARK_SPEED_UPDATE_INL_H_
#undef TIDEMARK_SPEED_UPDATE_INL_H_
#else
#define TIDEMARK_SPEED_UPDATE_INL_H_
#endif

#include "solver/speed/advection-inl.h"
#include "solver/speed/curvature-inl.h"
#include "solver/speed/rescaling-inl.h"
#include "solver/speed/stencil-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::solver::HWY_NAMESPACE {

// The factors of a step. The halves belong to terms that are added to both upwind parts of the result.
template <class V>
struct UpdateConstants {
  V inverse_spacing[3];
  V band;                  // W
  V curvature;             // dt (1 - alpha)
  V half_curvature;        // dt (1 - alpha) / 2
  V minus_half_rescaling;  // -dt w / 2
  V half_grown;            // (1 + dt w g_phi) / 2
};

template <class V, class Real>
HWY_INLINE UpdateConstants<V> update_constants(const StepConstants<Real>& k) {
  UpdateConstants<V> constants;
  for (int axis = 0; axis < 3; ++axis) constants.inverse_spacing[axis] = V(k.inverse_spacing[axis]);
  constants.band = V(k.band);
  const Real half = Real(0.5);
  const Real rescaling = k.time_step * k.rescaling_weight;
  constants.curvature = V(k.time_step * k.curvature_weight);
  constants.half_curvature = V(half * (k.time_step * k.curvature_weight));
  constants.minus_half_rescaling = V(-half * rescaling);
  constants.half_grown = V(half + half * rescaling * k.target_gradient);
  return constants;
}

// The new phi of a voxel; `data` is dt alpha D, how far the data term moves the surface in the step, and
// `advected` is from advected(). kPaper: eq. 6 literally, with one upwind gradient for the total speed.
//
// dphi/dt is linear in the upwind gradients. Their weights are computed first, beside the roots of the
// gradients, which take longest. Both parts are treated alike, so that inside and outside are
// alike to the last bit.
template <bool kPaper, class Real, class V, class... Advected>
HWY_INLINE V updated_phi(const Differences<V>& d, V data, const UpdateConstants<V>& k, Advected... advected) {
  const V moved = kPaper ? data + k.curvature * curvature<Real>(d) : data;
  // The weight of each gradient in -w phi |grad phi| where both share alike.
  const V shared = k.minus_half_rescaling * d.phi;
  const V one_sided = one_sidedness<Real>(d);
  const V growing = mul_add(abs(shared), one_sided, max(moved + shared, shared));
  const V shrinking = neg_mul_add(abs(shared), one_sided, min(moved + shared, shared));

  V half = k.half_grown * d.phi;
  if constexpr (!kPaper) half = mul_add(k.half_curvature, curvature_motion<Real>(d), half);
  if constexpr (sizeof...(Advected) != 0) half = mul_add(V(Real(0.5)), (advected + ...), half);
  const V phi = mul_add(growing, d.upwind_growing, half) + mul_add(shrinking, d.upwind_shrinking, half);
  return clamp(phi, k.band);
}

}  // namespace tidemark::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
