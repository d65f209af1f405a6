#include "imaging/phantom/scene.h"

#include <cmath>
#include <limits>

#include "imaging/phantom/noise.h"

namespace tidemark::imaging::phantom {
namespace {

std::int16_t to_stored(double value) {
  constexpr double kLow = std::numeric_limits<std::int16_t>::min();
  constexpr double kHigh = std::numeric_limits<std::int16_t>::max();
  return static_cast<std::int16_t>(std::floor(std::clamp(value, kLow, kHigh) + 0.5));
}

// The scanner's value for a true one.
struct Receiver {
  double deviation;
  bool magnitude;  // MR: the length of a complex number, so that dark voxels are never negative
  std::uint64_t seed;

  [[nodiscard]] double receive(double value, std::uint64_t voxel) const {
    if (deviation == 0.0) return value;
    const double real = value + deviation * gaussian(seed, 2 * voxel);
    if (!magnitude) return real;
    const double imaginary = deviation * gaussian(seed, 2 * voxel + 1);
    return std::sqrt(real * real + imaginary * imaginary);
  }
};

Geometry centred(const Index3& size, double spacing_mm) {
  Geometry geometry;
  geometry.size = size;
  geometry.spacing_mm = glm::dvec3(spacing_mm);
  geometry.origin_mm = -0.5 * spacing_mm * glm::dvec3(size - std::int64_t{1});
  return geometry;
}

}  // namespace

Result<Phantom> scan(const Scene& scene, const PhantomOptions& options, ThreadPool& pool,
                     const Progress& progress) {
  Phantom phantom;
  const Geometry geometry = centred(scene.size, scene.spacing_mm);
  const auto count = static_cast<std::size_t>(geometry.voxel_count());
  std::vector<std::int16_t> voxels(count);
  std::vector<std::uint8_t> truth(count);

  const double percent = options.noise_percent < 0 ? scene.default_noise_percent : options.noise_percent;
  const Receiver receiver{percent / 100.0 * scene.brightest, scene.modality == "MR",
                          hash(options.random_seed, 0x6e6f697365)};

  const auto fill_row = [&](std::int64_t j, std::int64_t k) {
    for (std::int64_t i = 0; i < geometry.size.x; ++i) {
      const glm::dvec3 p = geometry.origin_mm + geometry.spacing_mm * glm::dvec3(i, j, k);
      const auto offset = static_cast<std::size_t>(geometry.offset({i, j, k}));
      const Mixture mixture = scene.tissue(p);
      const double gain = scene.gain ? scene.gain(p) : 1.0;
      voxels[offset] = to_stored(receiver.receive(gain * mixture.value(), offset));
      truth[offset] = mixture.inside() ? 1 : 0;
    }
  };

  // Blocks of slices, so that the caller's thread reports progress and notices a request to stop.
  constexpr std::int64_t kBlock = 8;
  for (std::int64_t begin = 0; begin < geometry.size.z; begin += kBlock) {
    if (progress.cancelled()) return cancelled_error();
    progress(static_cast<double>(begin) / static_cast<double>(geometry.size.z), "making the phantom");
    const std::int64_t slices = std::min(kBlock, geometry.size.z - begin);
    pool.for_each(slices * geometry.size.y, 8, [&](std::int64_t first, std::int64_t last, int) {
      for (std::int64_t row = first; row < last; ++row) {
        fill_row(row % geometry.size.y, begin + row / geometry.size.y);
      }
    });
  }
  progress(1.0, "making the phantom");

  phantom.volume.geometry = geometry;
  phantom.volume.voxels = std::move(voxels);
  phantom.volume.modality = scene.modality;
  if (scene.modality == "CT") phantom.volume.unit = "HU";
  phantom.volume.description = scene.description;
  phantom.volume.window = scene.window;
  phantom.truth = {geometry, std::move(truth)};
  phantom.noise_percent = percent;
  phantom.random_seed = options.random_seed;
  return phantom;
}

std::array<double, 4> seed_at(const Geometry& geometry, const glm::dvec3& p_mm, double radius_mm) {
  const glm::dvec3 voxel = geometry.to_voxel(p_mm);
  return {std::floor(voxel.x + 0.5), std::floor(voxel.y + 0.5), std::floor(voxel.z + 0.5), radius_mm};
}

}  // namespace tidemark::imaging::phantom
