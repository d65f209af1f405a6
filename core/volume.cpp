#include "core/volume.h"

#include <algorithm>
#include <cmath>

#include "core/large_pages.h"
#include "core/typed_volume.h"

namespace tidemark {
namespace {

template <class Stored>
std::vector<Stored> every(std::int64_t stride, const std::vector<Stored>& voxels) {
  if (stride == 1) return voxels;
  std::vector<Stored> sample;
  sample.reserve(voxels.size() / static_cast<std::size_t>(stride) + 1);
  for (std::size_t i = 0; i < voxels.size(); i += static_cast<std::size_t>(stride))
    sample.push_back(voxels[i]);
  return sample;
}

// The smallest and largest of a sample but for `tail` of them at either end. Changes the sample's order.
std::pair<float, float> without_tails(std::vector<float>& sample, std::size_t tail) {
  const auto at = static_cast<std::ptrdiff_t>(tail);
  std::nth_element(sample.begin(), sample.begin() + at, sample.end());
  const float low = sample[tail];
  std::nth_element(sample.begin() + at, sample.end() - 1 - at, sample.end());
  return {low, *(sample.end() - 1 - at)};
}

// Of whole numbers a count of each is many times quicker.
template <class Stored>
std::pair<Stored, Stored> without_tails(const std::vector<Stored>& sample, std::size_t tail) {
  const auto [least, most] = std::minmax_element(sample.begin(), sample.end());
  std::vector<std::size_t> counts(static_cast<std::size_t>(*most - *least) + 1);
  for (const Stored value : sample) ++counts[static_cast<std::size_t>(value - *least)];
  std::size_t low = 0;
  for (std::size_t below = counts[0]; below <= tail; below += counts[low]) ++low;
  std::size_t high = counts.size() - 1;
  for (std::size_t above = counts[high]; above <= tail; above += counts[high]) --high;
  return {static_cast<Stored>(*least + static_cast<int>(low)),
          static_cast<Stored>(*least + static_cast<int>(high))};
}

}  // namespace

const char* Volume::scalar_name() const {
  constexpr const char* kNames[] = {"int16", "uint16", "float"};
  return kNames[voxels.index()];
}

float Volume::value(std::int64_t offset) const {
  return with_type(*this, [&](const auto& typed) { return typed.value(offset); });
}

std::vector<float> Volume::values() const {
  return with_type(*this, [](const auto& typed) {
    auto result = make_large_vector<float>(typed.stored.size());
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
  return with_type(*this, [&](const auto& typed) {
    auto sample = every(stride, typed.stored);
    const auto [low, high] = without_tails(sample, sample.size() / 200);
    // The slope may be negative.
    return std::pair<float, float>(std::minmax({typed.rescaled(low), typed.rescaled(high)}));
  });
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
