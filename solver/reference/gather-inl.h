// The stencil of one voxel, gathered without regard to speed.

#if defined(TIDEMARK_REFERENCE_GATHER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TIDEMARK_REFERENCE_GATHER_INL_H_
#undef TIDEMARK_REFERENCE_GATHER_INL_H_
#else
#define TIDEMARK_REFERENCE_GATHER_INL_H_
#endif

#include <algorithm>

#include "core/geometry.h"
#include "solver/speed/stencil-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::solver::HWY_NAMESPACE {

// `value` returns phi at a voxel; at the border of a volume of that size the index is clamped (Neumann).
template <class Value>
Stencil<double> gather(const Value& value, Index3 size, Index3 v) {
  const auto at = [&](int dx, int dy, int dz) {
    return static_cast<double>(value(Index3(std::clamp<std::int64_t>(v.x + dx, 0, size.x - 1),
                                            std::clamp<std::int64_t>(v.y + dy, 0, size.y - 1),
                                            std::clamp<std::int64_t>(v.z + dz, 0, size.z - 1))));
  };
  Stencil<double> s;
  s.c = at(0, 0, 0);
  s.xm = at(-1, 0, 0);
  s.xp = at(1, 0, 0);
  s.ym = at(0, -1, 0);
  s.yp = at(0, 1, 0);
  s.zm = at(0, 0, -1);
  s.zp = at(0, 0, 1);
  s.ymzm = at(0, -1, -1);
  s.ymzp = at(0, -1, 1);
  s.ypzm = at(0, 1, -1);
  s.ypzp = at(0, 1, 1);
  const auto dx = [&](int dy, int dz) { return at(1, dy, dz) - at(-1, dy, dz); };
  s.dx = dx(0, 0);
  s.dx_ym = dx(-1, 0);
  s.dx_yp = dx(1, 0);
  s.dx_zm = dx(0, -1);
  s.dx_zp = dx(0, 1);
  return s;
}

}  // namespace tidemark::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
