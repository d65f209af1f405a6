// What has values in a range: everywhere, and connected to a seed. ITK's filters would need a float copy of
// the source; a bit a voxel and a list of line pieces do.
#include <algorithm>

#include "core/typed_volume.h"
#include "imaging/filters/filters.h"

namespace tidemark::imaging {
namespace {

// Voxels with values in a range, and a bit for each that is taken.
template <class Stored>
struct InRange {
  InRange(const TypedVolume<Stored>& all, double lowest, double highest, BitMask& region)
      : volume(all), low(lowest), high(highest), taken(region) {}

  [[nodiscard]] bool may_take(std::int64_t offset) const {
    const double value{volume.value(offset)};
    return value >= low && value <= high;
  }
  [[nodiscard]] bool is_taken(std::int64_t offset) const { return taken.contains(offset); }
  void take(std::int64_t offset) { taken.add(offset); }

  const TypedVolume<Stored>& volume;
  double low;
  double high;
  BitMask& taken;
};

// Takes what is connected to `seed`, which may be taken. Works by whole pieces of rows, each of which waits
// at most once, so that the list of what is to do stays short.
template <class Stored>
void collect(InRange<Stored>& voxels, const Geometry& geometry, Index3 seed) {
  std::vector<std::int64_t> waiting;  // the first voxels of pieces that are taken
  // The piece of the row from `begin` to `end` that the voxel lies in; the place behind it.
  const auto take_piece = [&](std::int64_t at, std::int64_t begin, std::int64_t end) {
    std::int64_t first = at;
    while (first > begin && voxels.may_take(first - 1)) --first;
    std::int64_t behind = first;
    for (; behind < end && voxels.may_take(behind); ++behind) voxels.take(behind);
    waiting.push_back(first);
    return behind;
  };
  const std::int64_t start = geometry.offset({0, seed.y, seed.z});
  take_piece(start + seed.x, start, start + geometry.size.x);
  while (!waiting.empty()) {
    const std::int64_t first = waiting.back();
    waiting.pop_back();
    const Index3 v = geometry.voxel_at(first);
    std::int64_t length = 1;
    while (v.x + length < geometry.size.x && voxels.may_take(first + length)) ++length;
    for (const Index3 step : {Index3(0, -1, 0), Index3(0, 1, 0), Index3(0, 0, -1), Index3(0, 0, 1)}) {
      const Index3 beside = v + step;
      if (!geometry.contains(beside)) continue;
      const std::int64_t row = geometry.offset({0, beside.y, beside.z});
      const std::int64_t end = row + v.x + length;
      for (std::int64_t at = row + v.x; at < end; ++at) {
        if (!voxels.may_take(at) || voxels.is_taken(at)) continue;
        at = take_piece(at, row, row + geometry.size.x);
      }
    }
  }
}

}  // namespace

Inside between(const Volume& volume, double low, double high) {
  return with_type(volume, [&](const auto& typed) {
    return Inside{volume.geometry, [typed, low, high](std::int64_t offset, std::span<std::uint8_t> voxels) {
                    const auto* const stored = typed.stored.data() + offset;
                    std::transform(stored, stored + voxels.size(), voxels.begin(), [&](auto voxel) {
                      const double value{typed.rescaled(voxel)};
                      return std::uint8_t(value >= low && value <= high);
                    });
                  }};
  });
}

Mask threshold(const Volume& volume, double low, double high) {
  return mask_of(between(volume, low, high));
}

Result<BitMask> flood_fill(const Volume& volume, Index3 seed, double low, double high) {
  if (!volume.geometry.contains(seed)) {
    const Index3 size = volume.geometry.size;
    return fail(ErrorKind::usage,
                "flood fill: the seed ({}, {}, {}) is outside the volume of {} x {} x {} voxels", seed.x,
                seed.y, seed.z, size.x, size.y, size.z);
  }
  const double value = static_cast<double>(volume.value(seed));
  if (!(value >= low && value <= high)) {
    return fail(ErrorKind::usage, "flood fill: the value {} at the seed ({}, {}, {}) is outside [{}, {}]",
                value, seed.x, seed.y, seed.z, low, high);
  }
  BitMask taken(volume.geometry);
  with_type(volume, [&](const auto& typed) {
    InRange voxels{typed, low, high, taken};
    collect(voxels, volume.geometry, seed);
  });
  return taken;
}

}  // namespace tidemark::imaging
