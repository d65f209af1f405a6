// Numbers that the speed terms compute with: double, and (Lanes) a vector of floats.

#if defined(TIDEMARK_SPEED_NUMBERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TIDEMARK_SPEED_NUMBERS_INL_H_
#undef TIDEMARK_SPEED_NUMBERS_INL_H_
#else
#define TIDEMARK_SPEED_NUMBERS_INL_H_
#endif

#include <cmath>

#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::solver::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

HWY_INLINE double max(double a, double b) {
  return a > b ? a : b;
}
HWY_INLINE double min(double a, double b) {
  return a < b ? a : b;
}
HWY_INLINE double abs(double a) {
  return std::abs(a);
}
// a within [-limit, limit]
HWY_INLINE double clamp(double a, double limit) {
  return max(min(a, limit), -limit);
}
HWY_INLINE double sqrt(double a) {
  return std::sqrt(a);
}
HWY_INLINE double inverse(double a) {
  return 1.0 / a;
}
// a b + c, a b - c and c - a b
HWY_INLINE double mul_add(double a, double b, double c) {
  return a * b + c;
}
HWY_INLINE double mul_sub(double a, double b, double c) {
  return a * b - c;
}
HWY_INLINE double neg_mul_add(double a, double b, double c) {
  return c - a * b;
}

// Two rows of a page at most: 16 lanes.
using LanesTag = hn::CappedTag<float, 16>;

#if HWY_TARGET <= HWY_AVX3
// The one that is smaller by size, with the sign of a: one instruction, which Highway has not.
HWY_INLINE hn::Vec<LanesTag> clamp(hn::Vec<LanesTag> a, hn::Vec<LanesTag> limit) {
  return {_mm512_range_ps(a.raw, limit.raw, 0x2)};
}
#else
HWY_INLINE hn::Vec<LanesTag> clamp(hn::Vec<LanesTag> a, hn::Vec<LanesTag> limit) {
  return hn::Max(hn::Min(a, limit), hn::Neg(limit));
}
#endif

struct Lanes {
  hn::Vec<LanesTag> v;

  Lanes() = default;
  HWY_INLINE explicit Lanes(hn::Vec<LanesTag> vector) : v(vector) {}
  HWY_INLINE explicit Lanes(float value) : v(hn::Set(LanesTag(), value)) {}

  friend HWY_INLINE Lanes operator+(Lanes a, Lanes b) { return Lanes(hn::Add(a.v, b.v)); }
  friend HWY_INLINE Lanes operator-(Lanes a, Lanes b) { return Lanes(hn::Sub(a.v, b.v)); }
  friend HWY_INLINE Lanes operator*(Lanes a, Lanes b) { return Lanes(hn::Mul(a.v, b.v)); }
  friend HWY_INLINE Lanes operator/(Lanes a, Lanes b) { return Lanes(hn::Div(a.v, b.v)); }
  friend HWY_INLINE Lanes max(Lanes a, Lanes b) { return Lanes(hn::Max(a.v, b.v)); }
  friend HWY_INLINE Lanes min(Lanes a, Lanes b) { return Lanes(hn::Min(a.v, b.v)); }
  friend HWY_INLINE Lanes abs(Lanes a) { return Lanes(hn::Abs(a.v)); }
  friend HWY_INLINE Lanes clamp(Lanes a, Lanes limit) { return Lanes(clamp(a.v, limit.v)); }
  friend HWY_INLINE Lanes sqrt(Lanes a) { return Lanes(hn::Sqrt(a.v)); }
  // The processor's estimate after one Newton step: some 22 bits, a fraction of the cost of a division.
  friend HWY_INLINE Lanes inverse(Lanes a) {
    const auto estimate = hn::ApproximateReciprocal(a.v);
    const auto error = hn::NegMulAdd(a.v, estimate, hn::Set(LanesTag(), 2.0F));
    return Lanes(hn::Mul(estimate, error));
  }
  friend HWY_INLINE Lanes mul_add(Lanes a, Lanes b, Lanes c) { return Lanes(hn::MulAdd(a.v, b.v, c.v)); }
  friend HWY_INLINE Lanes mul_sub(Lanes a, Lanes b, Lanes c) { return Lanes(hn::MulSub(a.v, b.v, c.v)); }
  friend HWY_INLINE Lanes neg_mul_add(Lanes a, Lanes b, Lanes c) {
    return Lanes(hn::NegMulAdd(a.v, b.v, c.v));
  }
};

}  // namespace tidemark::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
