#include "tests/imaging/phantom/measures.h"

#include <QtGlobal>
#include <algorithm>
#include <array>
#include <cmath>

#include "imaging/phantom/kinds.h"

namespace tidemark::test {
namespace {

constexpr std::array<Index3, 6> kFaces = {
    {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}}};

// The distance from a voxel inside to the nearest one outside, by looking at the nearest first.
class DistanceOutwards {
 public:
  DistanceOutwards(const Mask& mask, int radius) : mask_(mask), radius_(radius) {
    for (int z = -radius; z <= radius; ++z) {
      for (int y = -radius; y <= radius; ++y) {
        for (int x = -radius; x <= radius; ++x) {
          const int squared = x * x + y * y + z * z;
          if (squared > 0 && squared <= radius * radius) nearest_.push_back({squared, {x, y, z}});
        }
      }
    }
    std::stable_sort(nearest_.begin(), nearest_.end(),
                     [](const Step& a, const Step& b) { return a.squared < b.squared; });
  }

  [[nodiscard]] bool inside(Index3 v) const {
    return mask_.geometry.contains(v) &&
           mask_.voxels[static_cast<std::size_t>(mask_.geometry.offset(v))] != 0;
  }

  [[nodiscard]] double at(Index3 v) const {
    if (!inside(v)) return 0.0;
    for (const Step& step : nearest_) {
      if (!inside(v + step.offset)) return std::sqrt(static_cast<double>(step.squared));
    }
    return radius_;
  }

 private:
  struct Step {
    int squared;
    Index3 offset;
  };
  const Mask& mask_;
  double radius_;
  std::vector<Step> nearest_;
};

}  // namespace

imaging::Phantom made(std::string_view kind, const imaging::PhantomOptions& options, int threads) {
  ThreadPool pool(threads);
  Result<imaging::Phantom> phantom = imaging::phantom::make_on(pool, kind, options, {});
  if (!phantom) qFatal("%s", phantom.error().message.c_str());
  return std::move(*phantom);
}

const std::vector<std::int16_t>& stored(const imaging::Phantom& phantom) {
  return std::get<std::vector<std::int16_t>>(phantom.volume.voxels);
}

std::uint64_t checksum(const imaging::Phantom& phantom) {
  std::uint64_t sum = 0xcbf29ce484222325ULL;
  const auto add = [&](unsigned byte) { sum = (sum ^ (byte & 0xff)) * 0x100000001b3ULL; };
  for (const std::int16_t value : stored(phantom)) {
    add(static_cast<unsigned>(value));
    add(static_cast<unsigned>(value) >> 8);
  }
  for (const std::uint8_t voxel : phantom.truth.voxels) add(voxel);
  return sum;
}

Contrast contrast_of(const imaging::Phantom& phantom) {
  Contrast contrast;
  const auto& values = stored(phantom);
  double sum = 0.0;
  std::int64_t in_range = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (phantom.truth.voxels[i] == 0) continue;
    ++contrast.voxels;
    sum += values[i];
    if (std::abs(values[i] - phantom.target) < phantom.range) ++in_range;
  }
  const auto count = static_cast<double>(contrast.voxels);
  contrast.mean = sum / count;
  contrast.in_range = static_cast<double>(in_range) / count;
  return contrast;
}

double largest_part(const Mask& mask) {
  const Geometry& geometry = mask.geometry;
  std::vector<std::uint8_t> left = mask.voxels;
  std::vector<Index3> front;
  std::int64_t largest = 0;
  std::int64_t all = 0;
  for (std::int64_t start = 0; start < geometry.voxel_count(); ++start) {
    if (left[static_cast<std::size_t>(start)] == 0) continue;
    left[static_cast<std::size_t>(start)] = 0;
    front.assign(1, geometry.voxel_at(start));
    std::int64_t size = 0;
    while (!front.empty()) {
      const Index3 v = front.back();
      front.pop_back();
      ++size;
      for (const Index3& face : kFaces) {
        const Index3 next = v + face;
        if (!geometry.contains(next)) continue;
        std::uint8_t& there = left[static_cast<std::size_t>(geometry.offset(next))];
        if (there != 0) front.push_back(next);
        there = 0;
      }
    }
    largest = std::max(largest, size);
    all += size;
  }
  return static_cast<double>(largest) / static_cast<double>(all);
}

std::map<int, std::int64_t> thickness(const Mask& mask, int radius, int step) {
  const DistanceOutwards distance(mask, radius);
  const Geometry& geometry = mask.geometry;
  std::map<int, std::int64_t> found;
  for (std::int64_t k = step; k < geometry.size.z - radius; k += step) {
    for (std::int64_t j = 0; j < geometry.size.y; ++j) {
      for (std::int64_t i = 0; i < geometry.size.x; ++i) {
        const Index3 v(i, j, k);
        const double here = distance.at(v);
        if (here < 1.5) continue;  // a corner, not the middle of anything
        const bool largest = std::all_of(kFaces.begin(), kFaces.end(),
                                         [&](const Index3& face) { return distance.at(v + face) <= here; });
        if (largest) ++found[static_cast<int>(std::lround(2.0 * here - 1.0))];
      }
    }
  }
  return found;
}

}  // namespace tidemark::test
