#include "bench/peers/dense_kernel.h"

// Compiled once for each instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/peers/dense_kernel.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#include "hwy/foreach_target.h"  // before highway.h
#include "hwy/highway.h"
#include "solver/speed/update-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::solver::HWY_NAMESPACE {

// The formulas are the solver's own; only where the values come from differs.
HWY_INLINE Stencil<Lanes> load_dense(const float* at, std::int64_t row, std::int64_t slice) {
  const auto load = [&](std::int64_t shift) HWY_ATTR { return Lanes(hn::LoadU(LanesTag(), at + shift)); };
  Stencil<Lanes> s;
  s.c = load(0);
  s.xm = load(-1);
  s.xp = load(1);
  s.ym = load(-row);
  s.yp = load(row);
  s.zm = load(-slice);
  s.zp = load(slice);
  s.ymzm = load(-row - slice);
  s.ymzp = load(-row + slice);
  s.ypzm = load(row - slice);
  s.ypzp = load(row + slice);
  const auto dx = [&](std::int64_t shift) HWY_ATTR { return load(shift + 1) - load(shift - 1); };
  s.dx = dx(0);
  s.dx_ym = dx(-row);
  s.dx_yp = dx(row);
  s.dx_zm = dx(-slice);
  s.dx_zp = dx(slice);
  return s;
}

void step_dense(const bench::DenseStep& step, Index3 begin, Index3 end) {
  const LanesTag d;
  const auto lanes = static_cast<std::int64_t>(hn::Lanes(d));
  const auto constants = update_constants<Lanes>(*step.constants);
  for (std::int64_t z = begin.z; z < end.z; ++z) {
    for (std::int64_t y = begin.y; y < end.y; ++y) {
      const std::int64_t first = y * step.row + z * step.slice;
      for (std::int64_t x = 0; x < step.length; x += lanes) {
        const std::int64_t at = first + x;
        const Stencil<Lanes> stencil = load_dense(step.phi + at, step.row, step.slice);
        const Lanes data(hn::LoadU(d, step.data + at));
        const auto differences_here = differences<false, float>(stencil, constants.inverse_spacing);
        const Lanes phi = updated_phi<false, float>(differences_here, data, constants);
        hn::StoreU(phi.v, d, step.next + at);
      }
    }
  }
}

}  // namespace tidemark::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tidemark::solver {

HWY_EXPORT(step_dense);

}  // namespace tidemark::solver

void tidemark::bench::step_dense(const DenseStep& step, Index3 begin, Index3 end) {
  HWY_DYNAMIC_DISPATCH(tidemark::solver::step_dense)(step, begin, end);
}
#endif  // HWY_ONCE
