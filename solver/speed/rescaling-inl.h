// The rescaling term G_r (paper eq. 5): keeps phi a clamped distance transform.

#if defined(TIDEMARK_SPEED_RESCALING_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TIDEMARK_SPEED_RESCALING_INL_H_
#undef TIDEMARK_SPEED_RESCALING_INL_H_
#else
#define TIDEMARK_SPEED_RESCALING_INL_H_
#endif

#include "solver/speed/stencil-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::HWY_NAMESPACE {

// phi (g_phi - |grad phi|), the gradient taken from the side of the surface. Beside the surface the mean of
// both one-sided gradients stands in, which keeps the surface where it is to about a tenth of a voxel.
template <class V, class Real>
HWY_INLINE V rescaling_speed(const Differences<V>& d, const StepConstants<Real>& k) {
  const V toward_surface = if_positive(d.phi, d.upwind_shrinking, d.upwind_growing);
  const V both = (d.upwind_growing + d.upwind_shrinking) * V(Real(0.5));
  const V gradient = if_negative(d.lowest_product, both, toward_surface);
  return d.phi * (V(k.target_gradient) - gradient);
}

}  // namespace tidemark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
