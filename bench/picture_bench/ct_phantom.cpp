#include "bench/picture_bench/ct_phantom.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/large_pages.h"
#include "core/thread_pool.h"

namespace tidemark::bench {
namespace {

constexpr double kAir = -1000.0;
constexpr double kTable = 150.0;
constexpr double kFat = -90.0;
constexpr double kMuscle = 50.0;
constexpr double kLung = -850.0;
constexpr double kVessel = 260.0;
constexpr double kBone = 700.0;

// Below 1 inside.
double ellipse(double x, double y, double middle_x, double middle_y, double half_x, double half_y) {
  return std::hypot((x - middle_x) / half_x, (y - middle_y) / half_y);
}

// x and y from -1 to 1 across the picture, z from 0 to 1.
double anatomy(double x, double y, double z) {
  if (std::abs(y - 0.62 - 0.08 * x * x) < 0.012 && std::abs(x) < 0.9) return kTable;
  const double body = ellipse(x, y, 0.0, 0.0, 0.78, 0.55);
  if (body > 1.0) return kAir;
  if (body > 0.92) return kFat;
  const double spine = ellipse(x, y, 0.0, 0.33, 0.11, 0.1);
  if (spine < 1.0) return spine > 0.8 ? kBone : 0.4 * kBone;
  const double aorta = ellipse(x, y, 0.08, 0.15, 0.05, 0.05);
  if (aorta < 1.0) return kVessel;
  const double rib = std::sin(40.0 * z + 3.0 * y);
  if (body > 0.84 && body < 0.9 && rib > 0.6) return kBone;
  const double reach = 0.6 + 0.4 * std::sin(3.1415927 * z);
  for (const double side : {-1.0, 1.0}) {
    if (ellipse(x, y, 0.36 * side, -0.02, 0.28 * reach, 0.4 * reach) > 1.0) continue;
    // Vessels: tubes that wind through the lung.
    for (int i = 0; i < 6; ++i) {
      const double middle_x = side * (0.3 + 0.13 * std::sin(5.0 * z + 2.1 * i));
      const double middle_y = -0.25 + 0.1 * i + 0.06 * std::cos(7.0 * z + i);
      if (ellipse(x, y, middle_x, middle_y, 0.018, 0.018) < 1.0) return kVessel;
    }
    return kLung;
  }
  return kMuscle;
}

// Evenly spread over [0, 1), the same for a voxel each time.
double spread(std::uint64_t number) {
  number = (number + 0x9E3779B97F4A7C15ULL) * 0xBF58476D1CE4E5B9ULL;
  number = (number ^ (number >> 27)) * 0x94D049BB133111EBULL;
  return static_cast<double>(number >> 11) * 0x1.0p-53;
}

}  // namespace

Volume ct_phantom(Index3 size) {
  constexpr double kNoise = 12.0;
  Volume volume;
  volume.geometry.size = size;
  volume.geometry.spacing_mm = {0.75, 0.75, 1.0};
  volume.modality = "CT";
  volume.unit = "HU";
  // As a study lies that was read from files.
  auto voxels = make_large_vector<std::int16_t>(static_cast<std::size_t>(size.x * size.y * size.z));
  const auto fill_slice = [&](std::int64_t k) {
    for (std::int64_t j = 0; j < size.y; ++j) {
      for (std::int64_t i = 0; i < size.x; ++i) {
        const double x = 2.0 * (static_cast<double>(i) + 0.5) / static_cast<double>(size.x) - 1.0;
        const double y = 2.0 * (static_cast<double>(j) + 0.5) / static_cast<double>(size.y) - 1.0;
        const auto offset = static_cast<std::uint64_t>(volume.geometry.offset({i, j, k}));
        double noise = -6.0;
        for (std::uint64_t n = 0; n < 12; ++n) noise += spread(12 * offset + n);
        const double value =
            anatomy(x, y, static_cast<double>(k) / static_cast<double>(size.z)) + kNoise * noise;
        voxels[offset] = static_cast<std::int16_t>(std::lround(std::max(value, -1024.0)));
      }
    }
  };
  ThreadPool threads;
  threads.for_each(size.z, 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t k = begin; k < end; ++k) fill_slice(k);
  });
  volume.voxels = std::move(voxels);
  return volume;
}

}  // namespace tidemark::bench
