#include "solver/host/page_kernel.h"

// This file is compiled once for each of these instruction sets; the best one is chosen when the program
// runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "solver/host/page_kernel.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#include <cstring>
#include <mutex>

#include "hwy/foreach_target.h"  // before highway.h
#include "hwy/highway.h"
#include "solver/speed/update-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::solver::HWY_NAMESPACE {
namespace {

#if HWY_TARGET <= HWY_AVX2  // vectors of at least a row

// The voxels to the left and to the right of whole rows: `before` and `after` are the same rows of the pages
// beside theirs.
#if HWY_TARGET <= HWY_AVX3
// One permutation of two vectors, which Highway 1.0 has not.
HWY_INLINE hn::Vec512<float> lanes_of_two(hn::Vec512<float> a, hn::Vec512<float> b,
                                          hn::Vec512<std::int32_t> lanes) {
  return {_mm512_permutex2var_ps(a.raw, lanes.raw, b.raw)};
}
HWY_INLINE hn::Vec256<float> lanes_of_two(hn::Vec256<float> a, hn::Vec256<float> b,
                                          hn::Vec256<std::int32_t> lanes) {
  return {_mm256_permutex2var_ps(a.raw, lanes.raw, b.raw)};
}

template <class D, class V>
HWY_INLINE V to_the_left(D d, V before, V page) {
  const hn::RebindToSigned<D> di;
  const auto x = hn::And(hn::Iota(di, 0), hn::Set(di, kPageSide - 1));
  const auto last_before = hn::Iota(di, static_cast<int>(hn::Lanes(d)) + kPageSide - 1);
  return lanes_of_two(page, before, hn::IfThenElse(hn::Eq(x, hn::Zero(di)), last_before, hn::Iota(di, -1)));
}

template <class D, class V>
HWY_INLINE V to_the_right(D d, V page, V after) {
  const hn::RebindToSigned<D> di;
  const auto end = hn::Set(di, kPageSide - 1);
  const auto x = hn::And(hn::Iota(di, 0), end);
  const auto first_after = hn::Iota(di, static_cast<int>(hn::Lanes(d)) - kPageSide + 1);
  return lanes_of_two(page, after, hn::IfThenElse(hn::Eq(x, end), first_after, hn::Iota(di, 1)));
}
#else
// Halves of two rows side by side, then a shift within them.
template <class D, class V>
HWY_INLINE V to_the_left(D d, V before, V page) {
  return hn::CombineShiftRightLanes<3>(d, page, hn::ConcatLowerUpper(d, page, before));
}

template <class D, class V>
HWY_INLINE V to_the_right(D d, V page, V after) {
  return hn::CombineShiftRightLanes<1>(d, hn::ConcatLowerUpper(d, after, page), page);
}
#endif

// Copies whole rows, `lanes of D` voxels at `offset` in their page, into the tile at `to`: phi and its
// differences along x. kOwn: the page is the one that is computed, so what is to the left and right goes
// there, too.
template <bool kOwn, class D>
HWY_INLINE void gather_rows(D d, const PageRow& from, int offset, Tile& tile, int to) {
  const auto page = hn::LoadU(d, from.page + offset);
  const auto left = to_the_left(d, hn::LoadU(d, from.before + offset), page);
  const auto right = to_the_right(d, page, hn::LoadU(d, from.after + offset));
  hn::StoreU(page, d, tile.centre + to);
  hn::StoreU(hn::Sub(right, left), d, tile.dx + to);
  if constexpr (kOwn) {
    hn::StoreU(left, d, tile.left + offset);
    hn::StoreU(right, d, tile.right + offset);
  }
}

// A slice, at `offset` in its pages.
template <bool kOwn>
HWY_INLINE void gather_slice(const PageRow& from, int offset, Tile& tile, int to) {
  const LanesTag d;
  for (int i = 0; i < kPageRows; i += static_cast<int>(hn::Lanes(d))) {
    gather_rows<kOwn>(d, from, offset + i, tile, to + i);
  }
}

// Gathers slices of a page that is surrounded by pages.
HWY_INLINE void gather_inner(const PageJob& job, unsigned slices) {
  constexpr int kLastRow = kPageRows - kPageSide;
  const hn::CappedTag<float, kPageSide> one_row;
  Tile& tile = *job.tile;
  const auto pages = [&](int dy, int dz) { return page_row(*job.fields, job.buffer, *job.info, dy, dz); };
  // Bit z + 1 for slice z: the pages below give slice -1, those above slice 8.
  for (const int dz : {-1, 1}) {
    const int z = dz < 0 ? -1 : kPageSide;
    if ((slices >> static_cast<unsigned>(z + 1) & 1U) == 0) continue;
    const int offset = dz < 0 ? kPageVoxels - kPageRows : 0;
    const int to = Tile::row(0, z);
    const auto copy_row = [&](const float* from, int row)
                              HWY_ATTR { hn::StoreU(hn::LoadU(one_row, from), one_row, tile.centre + row); };
    copy_row(pages(-1, dz).page + offset + kLastRow, to - Tile::kRowStride);
    gather_slice<false>(pages(0, dz), offset, tile, to);
    copy_row(pages(1, dz).page + offset, to + kPageRows);
  }
  const PageRow below = pages(-1, 0);
  const PageRow own = pages(0, 0);
  const PageRow above = pages(1, 0);
  for (unsigned rest = slices >> 1U & 0xffU; rest != 0; rest &= rest - 1) {
    const int z = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest));
    const int offset = z * kPageRows;
    const int to = Tile::row(0, z);
    gather_rows<false>(one_row, below, offset + kLastRow, tile, to - Tile::kRowStride);
    gather_slice<true>(own, offset, tile, to);
    gather_rows<false>(one_row, above, offset, tile, to + kPageRows);
  }
}

#endif  // vectors of at least a row

HWY_INLINE void gather_page(const PageJob& job) {
  const unsigned slices = slices_read(job.rows);
#if HWY_TARGET <= HWY_AVX2
  if (!at_border(*job.info)) return gather_inner(job, slices);
#endif
  gather(*job.fields, job.buffer, *job.info, slices, *job.tile);
}

// The stencil of the voxels that begin at `voxel` in the page and at `at` in the tile.
HWY_INLINE Stencil<Lanes> load_stencil(const Tile& tile, std::size_t voxel, std::size_t at) {
  constexpr int kY = Tile::kRowStride;
  constexpr int kZ = Tile::kSliceStride;
  const auto load = [](const float* values) HWY_ATTR { return Lanes(hn::LoadU(LanesTag(), values)); };
  const float* phi = tile.centre + at;
  const float* dx = tile.dx + at;
  Stencil<Lanes> s;
  s.c = load(phi);
  s.xm = load(tile.left + voxel);
  s.xp = load(tile.right + voxel);
  s.ym = load(phi - kY);
  s.yp = load(phi + kY);
  s.zm = load(phi - kZ);
  s.zp = load(phi + kZ);
  s.ymzm = load(phi - kY - kZ);
  s.ymzp = load(phi - kY + kZ);
  s.ypzm = load(phi + kY - kZ);
  s.ypzp = load(phi + kY + kZ);
  s.dx = load(dx);
  s.dx_ym = load(dx - kY);
  s.dx_yp = load(dx + kY);
  s.dx_zm = load(dx - kZ);
  s.dx_zp = load(dx + kZ);
  return s;
}

// One byte a row, one bit a voxel: which of them are W and which are -W. Kept as bytes while rows are
// computed, because deciding row by row would cost a mispredicted branch or two each.
struct ConstantVoxels {
  alignas(64) std::uint8_t inside[kPageRows] = {};
  alignas(64) std::uint8_t outside[kPageRows] = {};
};

// Sets the bits of the voxels that begin at `voxel`.
template <class Mask>
HWY_INLINE void set_bits(Mask mask, std::size_t voxel, std::uint8_t* rows) {
  const LanesTag d;
  if (hn::Lanes(d) >= kPageSide) {
    hn::StoreMaskBits(d, mask, rows + voxel / kPageSide);
  } else {
    std::uint8_t bits[8];
    hn::StoreMaskBits(d, mask, bits);
    rows[voxel / kPageSide] |= static_cast<std::uint8_t>(bits[0] << static_cast<unsigned>(voxel % kPageSide));
  }
}

// Bit r of the result is set when byte r, after `and_mask`, equals it.
HWY_INLINE Rows rows_where(const std::uint8_t* bytes, std::uint8_t and_mask) {
  const hn::CappedTag<std::uint8_t, kPageRows> d;
  const auto wanted = hn::Set(d, and_mask);
  std::uint8_t bits[kPageRows / 8 + 8] = {};
  for (std::size_t i = 0; i < kPageRows; i += hn::Lanes(d)) {
    const auto equal = hn::Eq(hn::And(hn::Load(d, bytes + i), wanted), wanted);
    if (hn::Lanes(d) >= 8) {
      hn::StoreMaskBits(d, equal, bits + i / 8);
    } else {
      std::uint8_t part[8] = {};
      hn::StoreMaskBits(d, equal, part);
      bits[i / 8] |= static_cast<std::uint8_t>(part[0] << (i % 8));
    }
  }
  Rows rows = 0;
  std::memcpy(&rows, bits, sizeof rows);
  return rows;
}

template <bool kPaper, bool kAnisotropic, bool kMotion, bool kAdvection>
void update_page(const PageJob& job, PageResult& result) {
  const LanesTag d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const int rows_per_vector = lanes > kPageSide ? lanes / kPageSide : 1;
  const auto constants = update_constants<Lanes>(*job.constants);
  const auto minus_band = hn::Neg(constants.band.v);

  gather_page(job);

  // The largest |phi| of a voxel whose change counts; padding never does.
  const int valid_x = job.info->valid[0];
  // The second set is for a vector of two rows of which the second is padding.
  alignas(64) float near_limit[2][16];
  for (int i = 0; i < 16; ++i) {
    near_limit[0][i] = i % kPageSide < valid_x ? job.constants->near : -1.0F;
    near_limit[1][i] = i < kPageSide ? near_limit[0][i] : -1.0F;
  }

  auto largest_change = hn::Zero(d);
  const auto near_here = hn::Set(d, job.constants->near);
  auto content = hn::Zero(d);
  std::size_t near_voxels = 0;
  ConstantVoxels constant;
  // Bytes are written in the loop, which the compiler takes for changes of the job.
  const Tile& tile = *job.tile;
  const float* const data_motion = job.data_motion;
  const float* const advection = job.advection;
  float* const next = job.next;
  const Rows one_vector = (Rows{1} << rows_per_vector) - 1;
  PagePrefetch::Turns ahead(*job.ahead, static_cast<int>(hwy::PopCount(job.rows)) / rows_per_vector);
  for (Rows rest = job.rows; rest != 0;) {
    ahead.go_on();
    const std::size_t row = hwy::Num0BitsBelowLS1Bit_Nonzero64(rest);
    rest &= rows_per_vector == 1 ? rest - 1 : ~(one_vector << row);  // the first is one instruction
    const std::size_t tile_row = Tile::row(row);
    for (int x = 0; x < kPageSide; x += lanes) {
      const std::size_t voxel = row * kPageSide + x;
      const Stencil<Lanes> stencil = load_stencil(tile, voxel, tile_row + x);
      const auto differences_here = differences<kAnisotropic, float>(stencil, constants.inverse_spacing);
      const Lanes data(hn::LoadU(d, data_motion + voxel));
      hn::Vec<decltype(d)> phi;
      if constexpr (kAdvection) {
        const float* v = advection + voxel;
        const StepVelocity<Lanes> velocity{Lanes(hn::LoadU(d, v)), Lanes(hn::LoadU(d, v + kPageVoxels)),
                                           Lanes(hn::LoadU(d, v + 2 * kPageVoxels))};
        phi = updated_phi<kPaper, float>(differences_here, data, constants, advected(stencil, velocity)).v;
      } else {
        phi = updated_phi<kPaper, float>(differences_here, data, constants).v;
      }
      if constexpr (kMotion) {
        const std::size_t ends_in_padding = job.info->padding >> (row + rows_per_vector - 1) & 1U;
        const auto limit = hn::LoadU(d, near_limit[ends_in_padding] + x);
        const auto near = hn::Le(hn::Abs(phi), limit);
        const auto change = hn::IfThenElseZero(near, hn::Sub(phi, hn::LoadU(d, next + voxel)));
        largest_change = hn::Max(largest_change, hn::Abs(change));
        const auto within = hn::Max(hn::Min(phi, near_here), hn::Neg(near_here));
        content = hn::Add(content, hn::IfThenElseZero(hn::Eq(limit, near_here), hn::Add(within, near_here)));
        near_voxels += hn::CountTrue(d, near);
      }
      hn::StoreU(phi, d, next + voxel);
      set_bits(hn::Eq(phi, constants.band.v), voxel, constant.inside);
      set_bits(hn::Eq(phi, minus_band), voxel, constant.outside);
    }
  }
  // Padding voxels count as constant: only the others are asked for.
  const auto valid = static_cast<std::uint8_t>((1U << static_cast<unsigned>(valid_x)) - 1U);
  const auto last = static_cast<std::uint8_t>(0x80U & valid);
  result.masks.inside = rows_where(constant.inside, valid) & job.rows;
  result.masks.inside_first = rows_where(constant.inside, 0x01U) & job.rows;
  result.masks.inside_last = rows_where(constant.inside, last) & job.rows;
  result.masks.outside = rows_where(constant.outside, valid) & job.rows;
  result.masks.outside_first = rows_where(constant.outside, 0x01U) & job.rows;
  result.masks.outside_last = rows_where(constant.outside, last) & job.rows;
  result.largest_change = hn::GetLane(hn::MaxOfLanes(d, largest_change));
  result.content = hn::GetLane(hn::SumOfLanes(d, content));
  result.near_voxels = static_cast<std::int32_t>(near_voxels);
}

template <bool kPaper, bool kAnisotropic>
void set_kernels(PageKernels& kernels) {
  auto& some = kernels.kernels[kPaper][kAnisotropic];
  some[false][false] = update_page<kPaper, kAnisotropic, false, false>;
  some[false][true] = update_page<kPaper, kAnisotropic, false, true>;
  some[true][false] = update_page<kPaper, kAnisotropic, true, false>;
  some[true][true] = update_page<kPaper, kAnisotropic, true, true>;
}

}  // namespace

// This instruction set's kernels.
PageKernels page_kernels() {
  PageKernels kernels;
  set_kernels<false, false>(kernels);
  set_kernels<false, true>(kernels);
  set_kernels<true, false>(kernels);
  set_kernels<true, true>(kernels);
  kernels.rows_per_vector = static_cast<int>(hn::Lanes(LanesTag()) + kPageSide - 1) / kPageSide;
  return kernels;
}

}  // namespace tidemark::solver::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tidemark::solver {
namespace {

HWY_EXPORT(page_kernels);

// Highway numbers better instruction sets lower.
struct Family {
  const char* name;
  std::int64_t targets;
};

#if defined(__x86_64__)
constexpr Family kFamilies[] = {
    {"avx512", HWY_AVX2 - 1}, {"avx2", HWY_AVX2}, {"sse4", HWY_SSE4}, {"portable", ~(2 * HWY_SSE4 - 1)}};
#else
constexpr Family kFamilies[] = {{"portable", ~std::int64_t{0}}};
#endif

}  // namespace

Result<PageKernels> select_page_kernels(std::string_view name) {
  // Highway keeps its choice in one table for the process; it is changed for this look-up alone.
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  bool known = name.empty();
  for (const Family& family : kFamilies) {
    known = known || name == family.name;
    const std::int64_t available = hwy::SupportedTargets() & HWY_TARGETS & family.targets;
    if (available == 0 || (!name.empty() && name != family.name)) continue;
    hwy::SetSupportedTargetsForTest(available);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    PageKernels kernels = HWY_DYNAMIC_DISPATCH(page_kernels)();
    hwy::SetSupportedTargetsForTest(0);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    kernels.name = family.name;
    return kernels;
  }
  if (known) return fail(ErrorKind::capability, "this processor lacks {}", name);
  return fail(ErrorKind::usage, "unknown instruction set '{}': sse4, avx2 or avx512", name);
}

}  // namespace tidemark::solver
#endif  // HWY_ONCE
