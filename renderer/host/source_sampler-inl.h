// The source around places in lanes: its value, and its slope within a voxel and from voxel to voxel.

// Highway's per-target include guard.
#if defined(TIDEMARK_SOURCE_SAMPLER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TIDEMARK_SOURCE_SAMPLER_INL_H_
#undef TIDEMARK_SOURCE_SAMPLER_INL_H_
#else
#define TIDEMARK_SOURCE_SAMPLER_INL_H_
#endif

#include <algorithm>
#include <cstring>
#include <type_traits>

#include "hwy/highway.h"
#include "renderer/host/shade_pieces.h"

HWY_BEFORE_NAMESPACE();
namespace tidemark::renderer::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<float, Pieces::kMost>;
using IntTag = hn::RebindToSigned<Tag>;
using V = hn::Vec<Tag>;
using I = hn::Vec<IntTag>;

HWY_INLINE V set(float value) {
  return hn::Set(Tag(), value);
}
HWY_INLINE V mix(V a, V b, V share) {
  return hn::MulAdd(hn::Sub(b, a), share, a);
}

struct Place {
  V x, y, z;
};

constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
using Lane = std::size_t;

// Neighbours along x of each lane, as they are stored. Lane by lane, because that is faster than the
// processor's own gathering: two or four voxels are one word.
template <class T, int kVoxels>
struct Rows {
  alignas(64) T voxels[kLanes][kVoxels];
};

HWY_INLINE V to_float(I words) {
  return hn::ConvertTo(Tag(), words);
}
template <class T>
HWY_INLINE V low_half(I words) {
  if constexpr (std::is_signed_v<T>) return to_float(hn::ShiftRight<16>(hn::ShiftLeft<16>(words)));
  return to_float(hn::And(words, hn::Set(IntTag(), 0xFFFF)));
}
template <class T>
HWY_INLINE V high_half(I words) {
  if constexpr (std::is_signed_v<T>) return to_float(hn::ShiftRight<16>(words));
  return to_float(hn::And(hn::ShiftRight<16>(words), hn::Set(IntTag(), 0xFFFF)));
}

// Two voxels side by side.
struct Pair {
  V first, second;
};
HWY_INLINE I load_words(const void* from) {
  return hn::LoadU(IntTag(), static_cast<const std::int32_t*>(from));
}
// The even and the odd ones of two vectors.
HWY_INLINE I even_of(I second, I first) {
#if HWY_TARGET == HWY_SCALAR
  (void)second;
  return first;
#else
  return hn::ConcatEven(IntTag(), second, first);
#endif
}
HWY_INLINE I odd_of(I second, I first) {
#if HWY_TARGET == HWY_SCALAR
  (void)first;
  return second;
#else
  return hn::ConcatOdd(IntTag(), second, first);
#endif
}
HWY_INLINE I even_words(const void* from) {
  const auto* words = static_cast<const std::int32_t*>(from);
  return even_of(load_words(words + kLanes), load_words(words));
}
HWY_INLINE I odd_words(const void* from) {
  const auto* words = static_cast<const std::int32_t*>(from);
  return odd_of(load_words(words + kLanes), load_words(words));
}
template <class T>
HWY_INLINE Pair pair_of(const Rows<T, 2>& rows) {
  if constexpr (std::is_same_v<T, float>) {
    return {hn::BitCast(Tag(), even_words(rows.voxels)), hn::BitCast(Tag(), odd_words(rows.voxels))};
  } else {
    const I words = load_words(rows.voxels);
    return {low_half<T>(words), high_half<T>(words)};
  }
}
// The first two of four, and the others.
template <class T>
HWY_INLINE Pair left_of(const Rows<T, 4>& rows) {
  if constexpr (std::is_same_v<T, float>) {
    const float* voxels = &rows.voxels[0][0];
    return {hn::BitCast(Tag(), even_of(even_words(voxels + 2 * kLanes), even_words(voxels))),
            hn::BitCast(Tag(), even_of(odd_words(voxels + 2 * kLanes), odd_words(voxels)))};
  } else {
    const I words = even_words(rows.voxels);
    return {low_half<T>(words), high_half<T>(words)};
  }
}
template <class T>
HWY_INLINE Pair right_of(const Rows<T, 4>& rows) {
  if constexpr (std::is_same_v<T, float>) {
    const float* voxels = &rows.voxels[0][0];
    return {hn::BitCast(Tag(), odd_of(even_words(voxels + 2 * kLanes), even_words(voxels))),
            hn::BitCast(Tag(), odd_of(odd_words(voxels + 2 * kLanes), odd_words(voxels)))};
  } else {
    const I words = odd_words(rows.voxels);
    return {low_half<T>(words), high_half<T>(words)};
  }
}

// The source around the lanes' places, in stored units. Offsets count from a slice near all of them, so that
// they fit 32 bits (longest_together()).
template <class T>
class Sampler {
 public:
  Sampler(const SourceSamples& source, float z_from, float z_to)
      : size_(source.size()), row_(source.row_stride()), slice_(row_ * size_.y) {
    constexpr float kReach = 3.0F;
    const float low = std::min(z_from, z_to) - kReach;
    first_slice_ = std::clamp(static_cast<int>(low), 0, size_.z - 1);
    base_ = static_cast<const T*>(source.voxels()) + std::int64_t{first_slice_} * slice_;
    step_y_ = size_.y > 1 ? row_ : 0;
    step_z_ = size_.z > 1 ? slice_ : 0;
  }

  // The voxels below the places along each axis, and how far the places are beyond them.
  struct Cell {
    I x, y, z;
    V share_x, share_y, share_z;
  };
  HWY_INLINE Cell cell(const Place& place) const {
    Cell cell;
    along(place.x, size_.x, cell.x, cell.share_x);
    along(place.y, size_.y, cell.y, cell.share_y);
    along(place.z, size_.z, cell.z, cell.share_z);
    return cell;
  }

  // Asks for the voxels of value(), which are needed soon.
  HWY_INLINE void ask_for(const Cell& cell) const {
    alignas(64) std::int32_t at[kLanes];
    hn::Store(offset(cell), IntTag(), at);
    for (Lane lane = 0; lane < kLanes; ++lane) {
      const T* first = base_ + at[lane];
      for (int i = 0; i < 4; ++i) __builtin_prefetch(first + (i & 1) * step_y_ + (i >> 1) * step_z_);
    }
  }

  HWY_INLINE V value(const Cell& cell) const {
    V rows[4];
    Pair pairs[4];
    fetch(cell, pairs, rows);
    return mix(mix(rows[0], rows[1], cell.share_y), mix(rows[2], rows[3], cell.share_y), cell.share_z);
  }

  // The value and its derivative within the cell, per voxel.
  HWY_INLINE V value(const Cell& cell, Place& slope) const {
    V rows[4];
    Pair p[4];
    fetch(cell, p, rows);
    const V x_below = mix(hn::Sub(p[0].second, p[0].first), hn::Sub(p[1].second, p[1].first), cell.share_y);
    const V x_above = mix(hn::Sub(p[2].second, p[2].first), hn::Sub(p[3].second, p[3].first), cell.share_y);
    const V below = mix(rows[0], rows[1], cell.share_y);
    const V above = mix(rows[2], rows[3], cell.share_y);
    slope.x = mix(x_below, x_above, cell.share_z);
    slope.y = mix(hn::Sub(rows[1], rows[0]), hn::Sub(rows[3], rows[2]), cell.share_z);
    slope.z = hn::Sub(above, below);
    return mix(below, above, cell.share_z);
  }

  // From differences over a voxel to each side, per voxel. Of the lanes that are `wanted`; others get any.
  HWY_INLINE Place central_slope(const Place& place, hn::Mask<Tag> wanted) const {
    const Cell cell = this->cell(place);
    const Cell inner{to_inner(cell.x, size_.x),
                     to_inner(cell.y, size_.y),
                     to_inner(cell.z, size_.z),
                     cell.share_x,
                     cell.share_y,
                     cell.share_z};
    const auto moved =
        hn::Or(hn::Ne(cell.x, inner.x), hn::Or(hn::Ne(cell.y, inner.y), hn::Ne(cell.z, inner.z)));
    const bool has_room = std::min({size_.x, size_.y, size_.z}) > 3;
    if (has_room && hn::AllFalse(IntTag(), hn::And(moved, hn::RebindMask(IntTag(), wanted)))) {
      return inner_slope(inner);
    }
    return border_slope(place);
  }

 private:
  HWY_INLINE static void along(V position, int size, I& low, V& share) {
    const V p = hn::Min(hn::Max(position, hn::Zero(Tag())), set(static_cast<float>(size - 1)));
    low = hn::Min(hn::ConvertTo(IntTag(), p), hn::Set(IntTag(), std::max(size - 2, 0)));
    share = hn::Sub(p, hn::ConvertTo(Tag(), low));
  }
  HWY_INLINE I offset(const Cell& cell) const {
    const I z = hn::Sub(cell.z, hn::Set(IntTag(), first_slice_));
    return hn::Add(cell.x,
                   hn::Add(hn::Mul(cell.y, hn::Set(IntTag(), row_)), hn::Mul(z, hn::Set(IntTag(), slice_))));
  }
  // The four pairs of a cell, and what is between them along x.
  HWY_INLINE void fetch(const Cell& cell, Pair (&pairs)[4], V (&rows)[4]) const {
    alignas(64) std::int32_t at[kLanes];
    hn::Store(offset(cell), IntTag(), at);
    Rows<T, 2> words[4];
    for (Lane lane = 0; lane < kLanes; ++lane) {
      const T* first = base_ + at[lane];
      for (int i = 0; i < 4; ++i) {
        std::memcpy(words[i].voxels[lane], first + (i & 1) * step_y_ + (i >> 1) * step_z_, 2 * sizeof(T));
      }
    }
    for (int i = 0; i < 4; ++i) {
      pairs[i] = pair_of(words[i]);
      rows[i] = mix(pairs[i].first, pairs[i].second, cell.share_x);
    }
  }

  // The nearest cell that has voxels on both sides.
  HWY_INLINE static I to_inner(I low, int size) {
    return hn::Max(hn::Min(low, hn::Set(IntTag(), size - 3)), hn::Set(IntTag(), 1));
  }

  // The voxels around lanes' cells from which central differences come.
  struct Surroundings {
    Rows<T, 4> inner[4];
    Rows<T, 2> outer[8];  // before and behind along y, for both z; then along z, for both y
  };

  HWY_INLINE Place inner_slope(const Cell& cell) const {
    alignas(64) std::int32_t at[kLanes];
    hn::Store(offset(cell), IntTag(), at);
    Surroundings around;
    for (Lane lane = 0; lane < kLanes; ++lane) {
      const T* first = base_ + at[lane];
      for (int i = 0; i < 4; ++i) {
        std::memcpy(around.inner[i].voxels[lane], first - 1 + (i & 1) * step_y_ + (i >> 1) * step_z_,
                    4 * sizeof(T));
      }
      for (int i = 0; i < 2; ++i) {
        const T* in_slice = first + i * step_z_;
        std::memcpy(around.outer[2 * i].voxels[lane], in_slice - step_y_, 2 * sizeof(T));
        std::memcpy(around.outer[2 * i + 1].voxels[lane], in_slice + 2 * step_y_, 2 * sizeof(T));
        const T* in_row = first + i * step_y_;
        std::memcpy(around.outer[4 + 2 * i].voxels[lane], in_row - step_z_, 2 * sizeof(T));
        std::memcpy(around.outer[5 + 2 * i].voxels[lane], in_row + 2 * step_z_, 2 * sizeof(T));
      }
    }
    return slope(around, cell);
  }

  // The same where the voxels on the volume's faces go on beyond them.
  HWY_NOINLINE Place border_slope(const Place& place) const {
    alignas(64) std::int32_t low[3][kLanes];
    Cell cell;
    below(place.x, low[0], cell.share_x);
    below(place.y, low[1], cell.share_y);
    below(place.z, low[2], cell.share_z);
    Surroundings around;
    for (Lane lane = 0; lane < kLanes; ++lane) {
      std::ptrdiff_t x[4], y[4], z[4];  // offsets of the voxels from one before to two behind
      for (int i = 0; i < 4; ++i) {
        x[i] = std::clamp(low[0][lane] - 1 + i, 0, size_.x - 1);
        y[i] = std::ptrdiff_t{std::clamp(low[1][lane] - 1 + i, 0, size_.y - 1)} * row_;
        z[i] = std::ptrdiff_t{std::clamp(low[2][lane] - 1 + i, 0, size_.z - 1) - first_slice_} * slice_;
      }
      for (int i = 0; i < 4; ++i) {
        const T* row = base_ + y[1 + (i & 1)] + z[1 + (i >> 1)];
        for (int k = 0; k < 4; ++k) around.inner[i].voxels[lane][k] = row[x[k]];
        const T* along_y = base_ + y[3 * (i & 1)] + z[1 + (i >> 1)];
        const T* along_z = base_ + y[1 + (i >> 1)] + z[3 * (i & 1)];
        for (int k = 0; k < 2; ++k) {
          around.outer[i].voxels[lane][k] = along_y[x[1 + k]];
          around.outer[4 + i].voxels[lane][k] = along_z[x[1 + k]];
        }
      }
    }
    return slope(around, cell);
  }
  HWY_INLINE static void below(V position, std::int32_t (&low)[kLanes], V& share) {
    const V whole = hn::Floor(position);
    hn::Store(hn::ConvertTo(IntTag(), whole), IntTag(), low);
    share = hn::Sub(position, whole);
  }

  // Trilinear means of the voxels' central differences, which is the same as central differences between
  // voxels.
  HWY_INLINE static Place slope(const Surroundings& around, const Cell& cell) {
    V rows[4];  // between voxels along x
    V along_x[4];
    for (int i = 0; i < 4; ++i) {
      const Pair left = left_of(around.inner[i]);
      const Pair right = right_of(around.inner[i]);
      rows[i] = mix(left.second, right.first, cell.share_x);
      along_x[i] = mix(hn::Sub(right.first, left.first), hn::Sub(right.second, left.second), cell.share_x);
    }
    const auto row = [&](int i) HWY_ATTR {
      const Pair pair = pair_of(around.outer[i]);
      return mix(pair.first, pair.second, cell.share_x);
    };
    // `i`: of the row before.
    const auto across = [&](int i, V own, V next, V share)
                            HWY_ATTR { return mix(hn::Sub(next, row(i)), hn::Sub(row(i + 1), own), share); };
    Place slope;
    slope.x = mix(mix(along_x[0], along_x[1], cell.share_y), mix(along_x[2], along_x[3], cell.share_y),
                  cell.share_z);
    slope.y = mix(across(0, rows[0], rows[1], cell.share_y), across(2, rows[2], rows[3], cell.share_y),
                  cell.share_z);
    slope.z = mix(across(4, rows[0], rows[2], cell.share_z), across(6, rows[1], rows[3], cell.share_z),
                  cell.share_y);
    const V half = set(0.5F);
    return {hn::Mul(slope.x, half), hn::Mul(slope.y, half), hn::Mul(slope.z, half)};
  }

  glm::ivec3 size_;
  int row_;
  int slice_;
  int step_y_ = 0;
  int step_z_ = 0;
  int first_slice_ = 0;
  const T* base_ = nullptr;
};

}  // namespace
}  // namespace tidemark::renderer::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
