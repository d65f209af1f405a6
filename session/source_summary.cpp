#include "session/source_summary.h"

#include <algorithm>
#include <cmath>

namespace tidemark {
namespace {

int bin_of(float value, float low, float high) {
  if (!(high > low)) return 0;
  const float share = (value - low) / (high - low);
  return std::clamp(static_cast<int>(share * SourceSummary::kBins), 0, SourceSummary::kBins - 1);
}

constexpr std::int64_t kSamples = 2'000'000;  // of gradients: enough for the picture of a distribution

// A value and its gradient for every stride-th voxel.
std::vector<std::pair<float, float>> sample(const Volume& volume, const Progress& progress) {
  const std::int64_t count = volume.geometry.voxel_count();
  const std::int64_t stride = std::max<std::int64_t>(1, count / kSamples) | 1;  // odd: no column is favoured
  std::vector<std::pair<float, float>> samples;
  samples.reserve(static_cast<std::size_t>(count / stride + 1));
  const Index3 size = volume.geometry.size;
  for (std::int64_t offset = 0; offset < count && !progress.cancelled(); offset += stride) {
    const Index3 voxel{offset % size.x, offset / size.x % size.y, offset / (size.x * size.y)};
    samples.emplace_back(volume.value(offset), gradient_magnitude(volume, voxel));
  }
  return samples;
}

}  // namespace

float gradient_magnitude(const Volume& volume, Index3 voxel) {
  const Geometry& geometry = volume.geometry;
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    Index3 low = voxel;
    Index3 high = voxel;
    low[axis] = std::max<std::int64_t>(low[axis] - 1, 0);
    high[axis] = std::min(high[axis] + 1, geometry.size[axis] - 1);
    if (low[axis] == high[axis]) continue;
    const double distance_mm = static_cast<double>(high[axis] - low[axis]) * geometry.spacing_mm[axis];
    const double slope = (static_cast<double>(volume.value(high)) - volume.value(low)) / distance_mm;
    square += slope * slope;
  }
  return static_cast<float>(std::sqrt(square));
}

SourceSummary summarise(const Volume& volume, const Progress& progress) {
  SourceSummary summary;
  std::tie(summary.low, summary.high) = volume.common_range();
  std::tie(summary.lowest, summary.highest) = volume.range();
  summary.values.assign(SourceSummary::kBins, 0);
  summary.value_gradient.assign(std::size_t{SourceSummary::kBins} * SourceSummary::kBins, 0);
  for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); ++offset) {
    ++summary.values[static_cast<std::size_t>(bin_of(volume.value(offset), summary.lowest, summary.highest))];
  }
  auto samples = sample(volume, progress);
  if (samples.empty()) return summary;
  std::vector<float> slopes(samples.size());
  std::transform(samples.begin(), samples.end(), slopes.begin(), [](const auto& one) { return one.second; });
  const auto rank = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() - 1 - slopes.size() / 200);
  std::nth_element(slopes.begin(), rank, slopes.end());
  summary.steepest = *rank > 0.0F ? *rank : 1.0F;
  for (const auto& [value, slope] : samples) {
    const int column = bin_of(value, summary.low, summary.high);
    const int row = bin_of(slope, 0.0F, summary.steepest);
    ++summary.value_gradient[static_cast<std::size_t>(row * SourceSummary::kBins + column)];
  }
  return summary;
}

}  // namespace tidemark
