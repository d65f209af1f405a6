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
namespace tidemark::HWY_NAMESPACE {
namespace {

// Copies `lanes of D` voxels of a page, whole rows, with those to their left and right into the tile.
template <class D>
HWY_INLINE void gather_rows(D d, const PageRow& from, int offset, Tile& tile, int to) {
  const hn::RebindToSigned<D> di;
  const auto lane = hn::Iota(di, 0);
  const auto x = hn::And(lane, hn::Set(di, kPageSide - 1));
  const auto row = hn::Sub(lane, x);
  const auto turned = [&](int by) HWY_ATTR {
    return hn::IndicesFromVec(d,
                              hn::Add(row, hn::And(hn::Add(x, hn::Set(di, by)), hn::Set(di, kPageSide - 1))));
  };
  const auto first = hn::RebindMask(d, hn::Eq(x, hn::Zero(di)));
  const auto last = hn::RebindMask(d, hn::Eq(x, hn::Set(di, kPageSide - 1)));
  const auto before = hn::LoadU(d, from.before + offset);
  const auto page = hn::LoadU(d, from.page + offset);
  const auto after = hn::LoadU(d, from.after + offset);
  hn::StoreU(hn::TableLookupLanes(hn::IfThenElse(last, before, page), turned(-1)), d, tile.left + to);
  hn::StoreU(page, d, tile.centre + to);
  hn::StoreU(hn::TableLookupLanes(hn::IfThenElse(first, after, page), turned(1)), d, tile.right + to);
}

// One row, in a vector where vectors are as long as that.
HWY_INLINE void gather_one_row(const PageRow& from, int offset, Tile& tile, int to) {
  const hn::CappedTag<float, kPageSide> d;
  if (hn::Lanes(d) == kPageSide) {
    gather_rows(d, from, offset, tile, to);
  } else {
    gather_row(from, offset, tile, to);
  }
}

// Gathers slices of a page that is surrounded by pages.
HWY_INLINE void gather_inner(const PageJob& job, unsigned slices) {
  const LanesTag d;
  Tile& tile = *job.tile;
  for (int dz = -1; dz <= 1; ++dz) {
    // Bit z + 1 for slice z: the pages below give slice -1, those above slice 8.
    const unsigned of_pages = dz < 0 ? 0x001U : dz > 0 ? 0x200U : 0x1feU;
    const PageRow below = page_row(*job.pool, job.buffer, *job.info, -1, dz);
    const PageRow own = page_row(*job.pool, job.buffer, *job.info, 0, dz);
    const PageRow above = page_row(*job.pool, job.buffer, *job.info, 1, dz);
    for (unsigned rest = slices & of_pages; rest != 0; rest &= rest - 1) {
      const int z = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero32(rest)) - 1;
      const int slice = (z & (kPageSide - 1)) * kPageRows;
      const int to = Tile::row(0, z);
      gather_one_row(below, slice + kPageRows - kPageSide, tile, to - Tile::kRowStride);
      if (hn::Lanes(d) > kPageSide) {
        for (int i = 0; i < kPageRows; i += static_cast<int>(hn::Lanes(d))) {
          gather_rows(d, own, slice + i, tile, to + i);
        }
      } else {
        for (int i = 0; i < kPageRows; i += kPageSide) gather_one_row(own, slice + i, tile, to + i);
      }
      gather_one_row(above, slice, tile, to + kPageRows);
    }
  }
}

// The stencil of the voxels that begin at `at` in the tile.
HWY_INLINE Stencil<Lanes> load_stencil(const Tile& tile, int at) {
  constexpr int kY = Tile::kRowStride;
  constexpr int kZ = Tile::kSliceStride;
  const auto load = [at](const float* values, int shift)
                        HWY_ATTR { return Lanes(hn::LoadU(LanesTag(), values + at + shift)); };
  Stencil<Lanes> s;
  s.c = load(tile.centre, 0);
  s.xm = load(tile.left, 0);
  s.xp = load(tile.right, 0);
  s.ym = load(tile.centre, -kY);
  s.yp = load(tile.centre, kY);
  s.zm = load(tile.centre, -kZ);
  s.zp = load(tile.centre, kZ);
  s.xmym = load(tile.left, -kY);
  s.xmyp = load(tile.left, kY);
  s.xpym = load(tile.right, -kY);
  s.xpyp = load(tile.right, kY);
  s.xmzm = load(tile.left, -kZ);
  s.xmzp = load(tile.left, kZ);
  s.xpzm = load(tile.right, -kZ);
  s.xpzp = load(tile.right, kZ);
  s.ymzm = load(tile.centre, -kY - kZ);
  s.ymzp = load(tile.centre, -kY + kZ);
  s.ypzm = load(tile.centre, kY - kZ);
  s.ypzp = load(tile.centre, kY + kZ);
  return s;
}

template <class Mask>
HWY_INLINE unsigned mask_bits(Mask mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(LanesTag(), mask, bytes);
  return bytes[0] | static_cast<unsigned>(bytes[1]) << 8U;
}

// One byte a row, one bit a voxel: which of them are W and which are -W. Kept as bytes while rows are
// computed, because deciding row by row would cost a mispredicted branch or two each.
struct ConstantVoxels {
  alignas(64) std::uint8_t inside[kPageRows] = {};
  alignas(64) std::uint8_t outside[kPageRows] = {};
};

// Bit r of the result is set when byte r, after `and_mask`, equals it.
HWY_INLINE Rows rows_where(const std::uint8_t* bytes, std::uint8_t and_mask) {
  const hn::CappedTag<std::uint8_t, 16> d;
  const auto wanted = hn::Set(d, and_mask);
  std::uint8_t bits[kPageRows / 8 + 8] = {};
  for (std::size_t i = 0; i < kPageRows; i += hn::Lanes(d)) {
    const auto equal = hn::Eq(hn::And(hn::Load(d, bytes + i), wanted), wanted);
    std::uint8_t part[8] = {};
    hn::StoreMaskBits(d, equal, part);
    bits[i / 8] |= static_cast<std::uint8_t>(part[0] << (i % 8));
    bits[i / 8 + 1] |= part[1];
  }
  Rows rows = 0;
  std::memcpy(&rows, bits, sizeof rows);
  return rows;
}

HWY_INLINE StepConstants<Lanes> in_every_lane(const StepConstants<float>& k) {
  StepConstants<Lanes> lanes;
  for (int axis = 0; axis < 3; ++axis) lanes.inverse_spacing[axis] = Lanes(k.inverse_spacing[axis]);
  lanes.time_step = Lanes(k.time_step);
  lanes.band = Lanes(k.band);
  lanes.minus_band = Lanes(k.minus_band);
  lanes.data_weight = Lanes(k.data_weight);
  lanes.curvature_weight = Lanes(k.curvature_weight);
  lanes.rescaling_weight = Lanes(k.rescaling_weight);
  lanes.target_gradient = Lanes(k.target_gradient);
  lanes.target = Lanes(k.target);
  lanes.near = Lanes(k.near);
  lanes.data_peak = Lanes(k.data_peak);
  lanes.data_slope = Lanes(k.data_slope);
  lanes.data_floor = Lanes(k.data_floor);
  return lanes;
}

template <bool kPaper, bool kAnisotropic, bool kMotion>
void update_page(const PageJob& job, PageResult& result) {
  const LanesTag d;
  const int lanes = static_cast<int>(hn::Lanes(d));
  const int rows_per_vector = lanes > kPageSide ? lanes / kPageSide : 1;
  const StepConstants<Lanes> constants = in_every_lane(*job.constants);

  const unsigned slices = slices_read(job.rows);
  if (at_border(*job.info)) {
    gather_at_border(*job.pool, job.buffer, *job.info, slices, *job.tile);
  } else {
    gather_inner(job, slices);
  }

  // The largest |phi| of a voxel whose change counts; padding never does.
  const int valid_x = job.info->valid[0];
  alignas(64) float near_limit[16];
  for (int i = 0; i < 16; ++i) near_limit[i] = i % kPageSide < valid_x ? job.constants->near : -1.0F;

  auto largest_change = hn::Zero(d);
  auto squared_change = hn::Zero(d);
  auto near_voxels = hn::Zero(d);
  ConstantVoxels constant;
  const Rows one_vector = (Rows{1} << rows_per_vector) - 1;
  PagePrefetch ahead(job.ahead, static_cast<int>(hwy::PopCount(job.rows)) / rows_per_vector);
  for (Rows rest = job.rows; rest != 0;) {
    ahead.go_on();
    const int row = static_cast<int>(hwy::Num0BitsBelowLS1Bit_Nonzero64(rest));
    rest &= ~(one_vector << row);
    const int tile_row = Tile::row(row % kPageSide, row / kPageSide);
    unsigned inside = 0;
    unsigned outside = 0;
    for (int x = 0; x < kPageSide; x += lanes) {
      const int voxel = row * kPageSide + x;
      const Stencil<Lanes> stencil = load_stencil(*job.tile, tile_row + x);
      const Lanes source(hn::LoadU(d, job.source + voxel));
      const auto phi =
          updated_phi<kPaper>(differences<kAnisotropic>(stencil, constants), source, constants).v;
      if constexpr (kMotion) {
        const auto near = hn::Le(hn::Abs(phi), hn::LoadU(d, near_limit + x));
        const auto change = hn::IfThenElseZero(near, hn::Abs(hn::Sub(phi, hn::LoadU(d, job.next + voxel))));
        largest_change = hn::Max(largest_change, change);
        squared_change = hn::MulAdd(change, change, squared_change);
        near_voxels = hn::Add(near_voxels, hn::IfThenElseZero(near, hn::Set(d, 1.0F)));
      }
      hn::StoreU(phi, d, job.next + voxel);
      inside |= mask_bits(hn::Eq(phi, constants.band.v)) << static_cast<unsigned>(x);
      outside |= mask_bits(hn::Eq(phi, constants.minus_band.v)) << static_cast<unsigned>(x);
    }
    for (int r = 0; r < rows_per_vector; ++r) {
      constant.inside[row + r] = static_cast<std::uint8_t>(inside >> (r * kPageSide));
      constant.outside[row + r] = static_cast<std::uint8_t>(outside >> (r * kPageSide));
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
  result.squared_change = hn::GetLane(hn::SumOfLanes(d, squared_change));
  result.near_voxels = static_cast<std::int32_t>(hn::GetLane(hn::SumOfLanes(d, near_voxels)));
}

template <bool kPaper, bool kAnisotropic>
void set_kernels(PageKernels& kernels) {
  kernels.kernels[kPaper][kAnisotropic][false] = update_page<kPaper, kAnisotropic, false>;
  kernels.kernels[kPaper][kAnisotropic][true] = update_page<kPaper, kAnisotropic, true>;
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

}  // namespace tidemark::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tidemark {
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

}  // namespace tidemark
#endif  // HWY_ONCE
