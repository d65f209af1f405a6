#include "imaging/filters/suggest_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <vector>

namespace tidemark {
namespace {

constexpr int kBins = 1024;
constexpr std::int64_t kHalfWidth = 2;               // neighbourhoods of 5 voxels along each axis
constexpr std::int64_t kMostCandidates = 1'000'000;  // in larger volumes only every n-th voxel is tried
constexpr double kSpanShare = 0.05;
constexpr double kSeedSpacings = 3.0;  // the seed's radius in smallest spacings

struct Spread {
  double mean = 0.0;
  double variance = 0.0;
};

Spread neighbourhood(const Volume& volume, Index3 centre) {
  const Index3 last = volume.geometry.size - Index3(1);
  const Index3 low = glm::max(centre - kHalfWidth, Index3(0));
  const Index3 high = glm::min(centre + kHalfWidth, last);
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  const double shift = volume.value(centre);  // keeps the squares small
  for (std::int64_t k = low.z; k <= high.z; ++k) {
    for (std::int64_t j = low.y; j <= high.y; ++j) {
      for (std::int64_t i = low.x; i <= high.x; ++i) {
        const double value = volume.value(Index3(i, j, k)) - shift;
        sum += value;
        squares += value * value;
        count += 1.0;
      }
    }
  }
  const double mean = sum / count;
  return {mean + shift, std::max(0.0, squares / count - mean * mean)};
}

struct Histogram {
  double low = 0.0;
  double bin_width = 1.0;
  std::array<double, kBins> counts{};
  double total = 0.0;

  // The value below which that share of the voxels lies.
  [[nodiscard]] double percentile(double share) const {
    double below = 0.0;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      below += counts[bin];
      if (below >= share * total) return low + (static_cast<double>(bin) + 0.5) * bin_width;
    }
    return low + kBins * bin_width;
  }
};

Histogram histogram(const Volume& volume, float lowest, float highest) {
  Histogram result;
  result.low = lowest;
  result.bin_width = (static_cast<double>(highest) - lowest) / kBins;
  const std::int64_t count = volume.geometry.voxel_count();
  for (std::int64_t offset = 0; offset < count; ++offset) {
    const double bin = (volume.value(offset) - result.low) / result.bin_width;
    result.counts[static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0))] += 1.0;
  }
  result.total = static_cast<double>(count);
  return result;
}

// The value that parts the histogram into the two classes with the largest variance between them.
double otsu_threshold(const Histogram& values) {
  double all = 0.0;
  for (std::size_t bin = 0; bin < kBins; ++bin) all += static_cast<double>(bin) * values.counts[bin];
  double below = 0.0;
  double sum_below = 0.0;
  double best = -1.0;
  std::size_t best_bin = 0;
  for (std::size_t bin = 0; bin + 1 < kBins; ++bin) {
    below += values.counts[bin];
    sum_below += static_cast<double>(bin) * values.counts[bin];
    const double above = values.total - below;
    if (below <= 0.0 || above <= 0.0) continue;
    const double difference = sum_below / below - (all - sum_below) / above;
    const double between = below * above * difference * difference;
    if (between > best) {
      best = between;
      best_bin = bin;
    }
  }
  return values.low + static_cast<double>(best_bin + 1) * values.bin_width;
}

// The middle half of an axis: at least one voxel.
struct Span {
  std::int64_t begin;
  std::int64_t end;
};
Span middle_half(std::int64_t size) {
  const std::int64_t begin = size / 4;
  return {begin, std::max(begin + 1, size - size / 4)};
}

struct Candidate {
  Index3 voxel{0};
  double variance = -1.0;
  double distance = 0.0;  // squared, from the centre, in voxels
};

std::optional<Index3> most_even_voxel(const Volume& volume, double threshold, const Progress& progress) {
  const Index3 size = volume.geometry.size;
  const Span x = middle_half(size.x);
  const Span y = middle_half(size.y);
  const Span z = middle_half(size.z);
  const double tried = static_cast<double>((x.end - x.begin) * (y.end - y.begin)) *
                       static_cast<double>(z.end - z.begin) / static_cast<double>(kMostCandidates);
  const auto stride = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(std::cbrt(tried))));
  const glm::dvec3 centre = 0.5 * glm::dvec3(size - Index3(1));
  Candidate best;
  for (std::int64_t k = z.begin; k < z.end && !progress.cancelled(); k += stride) {
    progress(static_cast<double>(k - z.begin) / static_cast<double>(z.end - z.begin), "looking for a start");
    for (std::int64_t j = y.begin; j < y.end; j += stride) {
      for (std::int64_t i = x.begin; i < x.end; i += stride) {
        const Index3 voxel(i, j, k);
        if (volume.value(voxel) < threshold) continue;
        const double variance = neighbourhood(volume, voxel).variance;
        const glm::dvec3 offset = glm::dvec3(voxel) - centre;
        const double distance = offset.x * offset.x + offset.y * offset.y + offset.z * offset.z;
        const bool better = best.variance < 0.0 || variance < best.variance ||
                            (variance == best.variance && distance < best.distance);
        if (better) best = {voxel, variance, distance};
      }
    }
  }
  if (best.variance < 0.0) return std::nullopt;
  return best.voxel;
}

}  // namespace

Result<SuggestedStart> suggest_start(const Volume& volume, std::optional<Index3> seed,
                                     const Progress& progress) {
  const auto [lowest, highest] = volume.range();
  if (!(highest > lowest)) {
    return fail(ErrorKind::input, "all voxels have the value {}: there is nothing to find", lowest);
  }
  const Histogram values = histogram(volume, lowest, highest);
  if (!seed) seed = most_even_voxel(volume, otsu_threshold(values), progress);
  if (progress.cancelled()) return cancelled_error();
  // Nothing bright in the middle: the middle itself.
  const Index3 voxel = seed.value_or(volume.geometry.size / std::int64_t{2});
  const Spread spread = neighbourhood(volume, voxel);
  const double span = values.percentile(0.99) - values.percentile(0.01);
  const glm::dvec3 spacing = volume.geometry.spacing_mm;

  SuggestedStart suggestion;
  suggestion.voxel = voxel;
  suggestion.radius_mm = kSeedSpacings * std::min({spacing.x, spacing.y, spacing.z});
  suggestion.target = spread.mean;
  suggestion.range = std::max(2.0 * std::sqrt(spread.variance), kSpanShare * span);
  if (suggestion.range <= 0.0) suggestion.range = kSpanShare * (static_cast<double>(highest) - lowest);
  return suggestion;
}

}  // namespace tidemark
