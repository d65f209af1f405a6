#include "renderer/host/slice_samples.h"

// This file is compiled once for each of these instruction sets; the best one is chosen when the program
// runs.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "renderer/host/slice_samples.cpp"
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_AVX3_DL)
#include <cstring>

#include "hwy/foreach_target.h"  // before highway.h
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::renderer::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, 16>;
using IntTag = hn::RebindToSigned<Tag>;
using V = hn::Vec<Tag>;
using I = hn::Vec<IntTag>;

// Exactly a or b where the share is 0 or 1.
HWY_INLINE V mix(V a, V b, V share) {
  return hn::MulAdd(share, b, hn::NegMulAdd(share, a, a));
}

HWY_INLINE I words_at(const void* base, I bytes) {
#if HWY_TARGET <= HWY_AVX2
  return hn::GatherOffset(IntTag(), static_cast<const std::int32_t*>(base), bytes);
#else
  std::int32_t at[16];
  std::int32_t words[16];
  hn::StoreU(bytes, IntTag(), at);
  for (std::size_t lane = 0; lane < hn::Lanes(IntTag()); ++lane) {
    std::memcpy(words + lane, static_cast<const char*>(base) + at[lane], sizeof(std::int32_t));
  }
  return hn::LoadU(IntTag(), words);
#endif
}

// The mean of two voxels side by side, the first at `offset` voxels from `base`.
HWY_INLINE V along_x(const std::int16_t* base, I offset, V share) {
  const I words = words_at(base, hn::ShiftLeft<1>(offset));
  return mix(hn::ConvertTo(Tag(), hn::ShiftRight<16>(hn::ShiftLeft<16>(words))),
             hn::ConvertTo(Tag(), hn::ShiftRight<16>(words)), share);
}
HWY_INLINE V along_x(const std::uint16_t* base, I offset, V share) {
  const I words = words_at(base, hn::ShiftLeft<1>(offset));
  const I low = hn::Set(IntTag(), 0xFFFF);
  return mix(hn::ConvertTo(Tag(), hn::And(words, low)),
             hn::ConvertTo(Tag(), hn::And(hn::ShiftRight<16>(words), low)), share);
}
HWY_INLINE V along_x(const float* base, I offset, V share) {
  const I bytes = hn::ShiftLeft<2>(offset);
  return mix(hn::BitCast(Tag(), words_at(base, bytes)), hn::BitCast(Tag(), words_at(base + 1, bytes)), share);
}

// The voxel below a place along an axis, counted from `first`, and how far the place is beyond it.
struct Along {
  I low;
  V share;

  HWY_INLINE Along(const float* position, int size, int first, bool nearest) {
    const auto last = static_cast<float>(size - 1);
    V p = hn::Min(hn::Max(hn::LoadU(Tag(), position), hn::Zero(Tag())), hn::Set(Tag(), last));
    if (nearest) p = hn::Floor(hn::Add(p, hn::Set(Tag(), 0.5F)));
    const I voxel = hn::Min(hn::ConvertTo(IntTag(), p), hn::Set(IntTag(), std::max(size - 2, 0)));
    share = hn::Sub(p, hn::ConvertTo(Tag(), voxel));
    low = hn::Sub(voxel, hn::Set(IntTag(), first));
  }
};

template <class T>
HWY_INLINE void sample_stored(const SourceSamples& samples, bool nearest, SliceTile& tile) {
  const glm::ivec3 size = samples.size();
  const int row = samples.row_stride();
  const int slice = row * size.y;
  const int step_y = size.y > 1 ? row : 0;
  const int step_z = size.z > 1 ? slice : 0;
  const T* base = static_cast<const T*>(samples.voxels()) + tile.low.x + std::int64_t{row} * tile.low.y +
                  std::int64_t{slice} * tile.low.z;
  const V slope = hn::Set(Tag(), samples.slope());
  const V intercept = hn::Set(Tag(), samples.intercept());
  for (std::size_t i = 0; i < SliceTile::kPixels; i += hn::Lanes(Tag())) {
    const Along x(tile.x.data() + i, size.x, tile.low.x, nearest);
    const Along y(tile.y.data() + i, size.y, tile.low.y, nearest);
    const Along z(tile.z.data() + i, size.z, tile.low.z, nearest);
    const I first = hn::Add(
        x.low, hn::Add(hn::Mul(y.low, hn::Set(IntTag(), row)), hn::Mul(z.low, hn::Set(IntTag(), slice))));
    const auto along_y = [&](I from) HWY_ATTR {
      return mix(along_x(base, from, x.share),
                 along_x(base, hn::Add(from, hn::Set(IntTag(), step_y)), x.share), y.share);
    };
    V stored = along_y(first);
    if (!hn::AllTrue(Tag(), hn::Eq(z.share, hn::Zero(Tag())))) {
      stored = mix(stored, along_y(hn::Add(first, hn::Set(IntTag(), step_z))), z.share);
    }
    hn::StoreU(hn::MulAdd(stored, slope, intercept), Tag(), tile.source.data() + i);
  }
}

}  // namespace

void sample(const SourceSamples& samples, bool nearest, SliceTile& tile) {
  switch (samples.stored()) {
    case SourceSamples::Stored::int16:
      return sample_stored<std::int16_t>(samples, nearest, tile);
    case SourceSamples::Stored::uint16:
      return sample_stored<std::uint16_t>(samples, nearest, tile);
    case SourceSamples::Stored::float32:
      return sample_stored<float>(samples, nearest, tile);
  }
}

}  // namespace tidemark::renderer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tidemark::renderer {

namespace {

HWY_EXPORT(sample);

}  // namespace

void sample_source(const SourceSamples& samples, bool nearest, SliceTile& tile) {
  // Offsets in bytes from the tile's first voxel are to fit 32 bits; tiles that reach over so much are rare.
  const glm::ivec3 extent = tile.high - tile.low + 1;
  const std::int64_t reach =
      std::int64_t{extent.z} * samples.size().y * samples.row_stride() * std::int64_t{sizeof(float)};
  if (reach < INT32_MAX) {
    HWY_DYNAMIC_DISPATCH(sample)(samples, nearest, tile);
    return;
  }
  for (std::size_t i = 0; i < SliceTile::kPixels; ++i) {
    const glm::vec3 p = tile.position(i);
    tile.source[i] = nearest ? samples.at(nearest_voxel(p, samples.size())) : samples.between(p);
  }
}

}  // namespace tidemark::renderer
#endif  // HWY_ONCE
