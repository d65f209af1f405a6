#include "core/volume.h"

#include <algorithm>
#include <cmath>

#include "core/typed_volume.h"

namespace tidemark {

const char* Volume::scalar_name() const {
  constexpr const char* kNames[] = {"int16", "uint16", "float"};
  return kNames[voxels.index()];
}

float Volume::value(std::int64_t offset) const {
  return with_type(*this, [&](const auto& typed) { return typed.value(offset); });
}

std::vector<float> Volume::values() const {
  return with_type(*this, [](const auto& typed) {
    std::vector<float> result(typed.stored.size());
    std::transform(typed.stored.begin(), typed.stored.end(), result.begin(),
                   [&](auto voxel) { return typed.rescaled(voxel); });
    return result;
  });
}

std::pair<float, float> Volume::range() const {
  return with_type(*this, [](const auto& typed) {
    // Two plain reductions, which compilers make vectors of; of std::minmax_element they do not.
    auto low = typed.stored.front();
    auto high = low;
    for (const auto voxel : typed.stored) {
      low = std::min(low, voxel);
      high = std::max(high, voxel);
    }
    // The slope may be negative.
    return std::pair<float, float>(std::minmax({typed.rescaled(low), typed.rescaled(high)}));
  });
}

std::pair<float, float> Volume::common_range() const {
  constexpr std::int64_t kSample = 1'000'000;
  // An odd stride does not follow rows or slices.
  const std::int64_t stride = std::max<std::int64_t>(1, geometry.voxel_count() / kSample) | 1;
  std::vector<float> sample;
  sample.reserve(static_cast<std::size_t>((geometry.voxel_count() + stride - 1) / stride));
  with_type(*this, [&](const auto& typed) {
    for (std::int64_t i = 0; i < geometry.voxel_count(); i += stride) sample.push_back(typed.value(i));
  });
  const auto one_in = static_cast<std::ptrdiff_t>(sample.size() / 200);
  std::nth_element(sample.begin(), sample.begin() + one_in, sample.end());
  const float low = sample[static_cast<std::size_t>(one_in)];
  std::nth_element(sample.begin() + one_in, sample.end() - 1 - one_in, sample.end());
  return {low, *(sample.end() - 1 - one_in)};
}

std::int64_t Mask::count() const {
  return std::count_if(voxels.begin(), voxels.end(), [](std::uint8_t v) { return v != 0; });
}

double dice(const Mask& a, const Mask& b) {
  std::int64_t both = 0;
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < a.voxels.size(); ++i) {
    const bool in_a = a.voxels[i] != 0;
    const bool in_b = b.voxels[i] != 0;
    both += in_a && in_b;
    sum += in_a + in_b;
  }
  return sum == 0 ? 1.0 : 2.0 * static_cast<double>(both) / static_cast<double>(sum);
}

Status require_finite(const Volume& volume, const std::string& source) {
  const auto* values = std::get_if<std::vector<float>>(&volume.voxels);
  if (values == nullptr) return {};
  const auto bad = std::find_if(values->begin(), values->end(), [](float v) { return !std::isfinite(v); });
  if (bad == values->end()) return {};
  const Index3 v = volume.geometry.voxel_at(bad - values->begin());
  return fail(ErrorKind::input, "{}: voxel ({}, {}, {}) is {}", source, v.x, v.y, v.z,
              std::isnan(*bad) ? "NaN" : "infinite");
}

}  // namespace tidemark
