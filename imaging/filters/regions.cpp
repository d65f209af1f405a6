// Thresholds and regions connected across faces. ITK's filters would need a float copy of the source and
// eight bytes a voxel for labels; one byte a voxel and a list of line pieces do.
#include <algorithm>

#include "core/typed_volume.h"
#include "imaging/filters/filters.h"

namespace tidemark::imaging {
namespace {

constexpr std::uint8_t kOutside = 0;
constexpr std::uint8_t kInside = 1;
constexpr std::uint8_t kTaken = 2;  // in the region that is being or was collected

// Marks the region of kInside voxels around `seed` as `mark`; returns how many voxels it has. Works by whole
// pieces of rows, so that the list of what is to do stays short.
std::int64_t collect(std::vector<std::uint8_t>& voxels, const Geometry& geometry, Index3 seed,
                     std::uint8_t mark) {
  std::int64_t count = 0;
  std::vector<Index3> waiting{seed};
  const auto at = [&](Index3 v) -> std::uint8_t& {
    return voxels[static_cast<std::size_t>(geometry.offset(v))];
  };
  while (!waiting.empty()) {
    Index3 v = waiting.back();
    waiting.pop_back();
    if (at(v) != kInside) continue;
    while (v.x > 0 && at(v - Index3(1, 0, 0)) == kInside) --v.x;
    std::int64_t end = v.x;
    for (Index3 w = v; w.x < geometry.size.x && at(w) == kInside; ++w.x) {
      at(w) = mark;
      end = w.x + 1;
    }
    count += end - v.x;
    for (const Index3 step : {Index3(0, -1, 0), Index3(0, 1, 0), Index3(0, 0, -1), Index3(0, 0, 1)}) {
      bool before = false;  // one seed for each run of the neighbouring row
      Index3 w = v + step;
      if (!geometry.contains(w)) continue;
      for (; w.x < end; ++w.x) {
        const bool inside = at(w) == kInside;
        if (inside && !before) waiting.push_back(w);
        before = inside;
      }
    }
  }
  return count;
}

}  // namespace

Mask threshold(const Volume& volume, double low, double high) {
  Mask mask;
  mask.geometry = volume.geometry;
  mask.voxels.resize(static_cast<std::size_t>(volume.geometry.voxel_count()));
  with_type(volume, [&](const auto& typed) {
    std::transform(typed.stored.begin(), typed.stored.end(), mask.voxels.begin(), [&](auto voxel) {
      const double value{typed.rescaled(voxel)};
      return value >= low && value <= high ? kInside : kOutside;
    });
  });
  return mask;
}

Result<Mask> flood_fill(const Volume& volume, Index3 seed, double low, double high) {
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
  Mask mask = threshold(volume, low, high);
  collect(mask.voxels, mask.geometry, seed, kTaken);
  for (auto& voxel : mask.voxels) voxel = voxel == kTaken ? kInside : kOutside;
  return mask;
}

Components connected_components(const Mask& mask) {
  Components components;
  components.largest.geometry = mask.geometry;
  std::vector<std::uint8_t> voxels(mask.voxels.size());
  std::transform(mask.voxels.begin(), mask.voxels.end(), voxels.begin(),
                 [](std::uint8_t v) { return v != 0 ? kInside : kOutside; });
  std::int64_t largest = 0;
  Index3 largest_seed{0, 0, 0};
  const auto count = static_cast<std::int64_t>(voxels.size());
  for (std::int64_t i = 0; i < count; ++i) {
    if (voxels[static_cast<std::size_t>(i)] != kInside) continue;
    const Index3 seed = mask.geometry.voxel_at(i);
    const std::int64_t size = collect(voxels, mask.geometry, seed, kTaken);
    ++components.count;
    if (size > largest) {
      largest = size;
      largest_seed = seed;
    }
  }
  // Once more for the largest alone: no labels need to be kept.
  for (auto& voxel : voxels) voxel = voxel == kTaken ? kInside : kOutside;
  if (largest > 0) collect(voxels, mask.geometry, largest_seed, kTaken);
  for (auto& voxel : voxels) voxel = voxel == kTaken ? kInside : kOutside;
  components.largest.voxels = std::move(voxels);
  return components;
}

}  // namespace tidemark::imaging
