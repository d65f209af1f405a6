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
template <bool kPaper, class V, class Real>
HWY_INLINE V updated_phi(const Differences<V>& d, V source, const StepConstants<Real>& k) {
  const V data = V(k.data_weight) * data_speed(source, k);
  V change;
  if constexpr (kPaper) {
    const V speed = data + V(k.curvature_weight) * curvature<Real>(d);
    change = speed * if_positive(speed, d.upwind_growing, d.upwind_shrinking);
  } else {
    change = mul_add(data, if_positive(data, d.upwind_growing, d.upwind_shrinking),
                     V(k.curvature_weight) * curvature_motion<Real>(d));
  }
  change = mul_add(V(k.rescaling_weight), rescaling_speed(d, k), change);
  const V phi = mul_add(V(k.time_step), change, d.phi);
  return max(min(phi, V(k.band)), V(k.minus_band));
}

}  // namespace tidemark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
