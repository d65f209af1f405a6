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

// The product of phi with a neighbour of the other sign at which that neighbour counts in full.
inline constexpr double kFullSignChange = 0.1;

// How the two one-sided gradients share in |grad phi| here: at 1 the one from the side of the surface counts
// alone; at 0, beside the surface, the mean of both stands in, which keeps the surface where it is to about a
// tenth of a voxel. The one goes over into the other continuously as a neighbour changes sign: a switch would
// leave voxels flipping between the two for ever, and the surface would never come to rest.
template <class Real, class V>
HWY_INLINE V one_sidedness(const Differences<V>& d) {
  const V one = V(Real(1));
  return max(min(mul_add(d.lowest_product, V(Real(1.0 / kFullSignChange)), one), one), V(Real(0)));
}

}  // namespace tidemark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
