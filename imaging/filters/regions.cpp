// Thresholds and regions connected across faces. ITK's filters would need a float copy of the source and
// eight bytes a voxel for labels; a bit or a byte a voxel and a list of line pieces do.
#include <algorithm>

#include "core/typed_volume.h"
#include "imaging/filters/filters.h"

namespace tidemark::imaging {
namespace {

constexpr std::uint8_t kOutside = 0;
constexpr std::uint8_t kInside = 1;
constexpr std::uint8_t kTaken = 2;  // in a region that was collected

// Takes the region around `seed`, which is in it and not taken; returns how many voxels it has. Works by
// whole pieces of rows, each of which waits at most once, so that the list of what is to do stays short.
// `voxels` has may_take(offset), of voxels that are taken too, is_taken(offset) and take(offset).
template <class Voxels>
std::int64_t collect(Voxels& voxels, const Geometry& geometry, Index3 seed) {
  std::int64_t count = 0;
  std::vector<std::int64_t> waiting;  // the first voxels of pieces that are taken
  // The piece of the row from `begin` to `end` that the voxel lies in; the place behind it.
  const auto take_piece = [&](std::int64_t at, std::int64_t begin, std::int64_t end) {
    std::int64_t first = at;
    while (first > begin && voxels.may_take(first - 1)) --first;
    std::int64_t behind = first;
    for (; behind < end && voxels.may_take(behind); ++behind) voxels.take(behind);
    count += behind - first;
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
  return count;
}

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

// A byte a voxel for both.
struct Bytes {
  [[nodiscard]] bool may_take(std::int64_t offset) const { return at(offset) != kOutside; }
  [[nodiscard]] bool is_taken(std::int64_t offset) const { return at(offset) == kTaken; }
  void take(std::int64_t offset) { voxels[static_cast<std::size_t>(offset)] = kTaken; }
  [[nodiscard]] std::uint8_t at(std::int64_t offset) const {
    return voxels[static_cast<std::size_t>(offset)];
  }

  std::vector<std::uint8_t>& voxels;
};

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
    return collect(voxels, volume.geometry, seed);
  });
  return taken;
}

Components connected_components(const Mask& mask) {
  Components components;
  components.largest.geometry = mask.geometry;
  std::vector<std::uint8_t> voxels(mask.voxels.size());
  std::transform(mask.voxels.begin(), mask.voxels.end(), voxels.begin(),
                 [](std::uint8_t v) { return v != 0 ? kInside : kOutside; });
  std::int64_t largest = 0;
  Index3 largest_seed{0, 0, 0};
  Bytes bytes{voxels};
  const auto count = static_cast<std::int64_t>(voxels.size());
  for (std::int64_t i = 0; i < count; ++i) {
    if (voxels[static_cast<std::size_t>(i)] != kInside) continue;
    const Index3 seed = mask.geometry.voxel_at(i);
    const std::int64_t size = collect(bytes, mask.geometry, seed);
    ++components.count;
    if (size > largest) {
      largest = size;
      largest_seed = seed;
    }
  }
  // Once more for the largest alone: no labels need to be kept.
  for (auto& voxel : voxels) voxel = voxel == kTaken ? kInside : kOutside;
  if (largest > 0) collect(bytes, mask.geometry, largest_seed);
  for (auto& voxel : voxels) voxel = voxel == kTaken ? kInside : kOutside;
  components.largest.voxels = std::move(voxels);
  return components;
}

}  // namespace tidemark::imaging
