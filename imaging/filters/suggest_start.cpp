#include "imaging/filters/suggest_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <utility>
#include <vector>

#include "core/index_walk.h"
#include "core/thread_pool.h"
#include "core/typed_volume.h"

namespace tidemark::imaging {
namespace {

constexpr int kBins = 1024;
constexpr std::int64_t kMostCounted = std::int64_t{1} << 22;  // in larger volumes only every n-th voxel
constexpr std::int64_t kHalfWidth = 2;                        // neighbourhoods of 5 voxels along each axis
constexpr std::int64_t kMostCandidates = 250'000;  // in larger volumes only every n-th voxel is tried
constexpr double kSpanShare = 0.05;
constexpr double kSeedSpacings = 3.0;  // the seed's radius in smallest spacings

// Of computed tomography, in Hounsfield units: between fluid and bone.
constexpr double kSoftTissueLow = 20.0;
constexpr double kSoftTissueHigh = 200.0;
constexpr double kSoftTissueRange = 30.0;  // the smallest: organs differ by little, but noise does not
constexpr double kEvenEnough = 4.0;        // in variance: twice the noise
constexpr double kAir = -900.0;            // no other modality has such values in most of its studies

struct Spread {
  double mean = 0.0;
  double variance = 0.0;
};

template <class Stored>
Spread neighbourhood(const TypedVolume<Stored>& volume, Index3 centre) {
  const Index3 last = volume.geometry.size - Index3(1);
  const Index3 low = glm::max(centre - kHalfWidth, Index3(0));
  const Index3 high = glm::min(centre + kHalfWidth, last);
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  const double shift = volume.value(centre);  // keeps the squares small
  for_each_index(low, high + Index3(1), [&](Index3 voxel) {
    const double value = volume.value(voxel) - shift;
    sum += value;
    squares += value * value;
    count += 1.0;
  });
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

template <class Stored>
Histogram histogram(const TypedVolume<Stored>& volume, float lowest, float highest) {
  Histogram result;
  result.low = lowest;
  result.bin_width = (static_cast<double>(highest) - lowest) / kBins;
  const std::int64_t count = volume.geometry.voxel_count();
  // An odd stride does not follow rows or slices.
  const std::int64_t stride = std::max<std::int64_t>(1, count / kMostCounted) | 1;
  for (std::int64_t offset = 0; offset < count; offset += stride) {
    const double bin = (volume.value(offset) - result.low) / result.bin_width;
    result.counts[static_cast<std::size_t>(std::clamp(bin, 0.0, kBins - 1.0))] += 1.0;
  }
  const std::int64_t counted = (count + stride - 1) / stride;
  result.total = static_cast<double>(counted);
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

// The values in which a start is sought.
struct Wanted {
  double low = 0.0;
  double high = 0.0;
  double even_enough = 1.0;  // variances up to so many times the smallest; of these the nearest to the centre
};

bool looks_like_ct(const Volume& volume, const Histogram& values) {
  if (!volume.modality.empty()) return volume.modality == "CT";
  return values.percentile(0.01) <= kAir && values.percentile(0.99) >= kSoftTissueLow;
}

struct Candidate {
  Index3 voxel{0};
  double variance = 0.0;
};

// In the central half along each axis; in the order of voxels.
template <class Stored>
std::vector<Candidate> candidates(const TypedVolume<Stored>& volume, const Wanted& wanted, ThreadPool& pool,
                                  const Progress& progress) {
  const Index3 size = volume.geometry.size;
  const Span x = middle_half(size.x);
  const Span y = middle_half(size.y);
  const Span z = middle_half(size.z);
  const double tried = static_cast<double>((x.end - x.begin) * (y.end - y.begin)) *
                       static_cast<double>(z.end - z.begin) / static_cast<double>(kMostCandidates);
  const auto stride = std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil(std::cbrt(tried))));
  const auto steps = [&](const Span& span) {
    return static_cast<std::size_t>((span.end - span.begin + stride - 1) / stride);
  };
  std::vector<std::vector<Candidate>> of_slice(steps(z));
  // Here, because nothing may throw in the pool.
  for (auto& found : of_slice) found.reserve(steps(x) * steps(y));
  const auto look_in = [&](std::int64_t slice) {
    for (std::int64_t j = y.begin; j < y.end; j += stride) {
      for (std::int64_t i = x.begin; i < x.end; i += stride) {
        const Index3 voxel(i, j, z.begin + slice * stride);
        const double value = volume.value(voxel);
        if (value >= wanted.low && value <= wanted.high) {
          of_slice[static_cast<std::size_t>(slice)].push_back({voxel, neighbourhood(volume, voxel).variance});
        }
      }
    }
  };
  progress(0.0, "looking for a start");
  pool.for_each(static_cast<std::int64_t>(of_slice.size()), 1,
                [&](std::int64_t begin, std::int64_t end, int) {
                  for (std::int64_t slice = begin; slice < end && !progress.cancelled(); ++slice)
                    look_in(slice);
                });
  std::vector<Candidate> all;
  for (const auto& found : of_slice) all.insert(all.end(), found.begin(), found.end());
  return all;
}

template <class Stored>
std::optional<Index3> most_even_voxel(const TypedVolume<Stored>& volume, const Wanted& wanted,
                                      ThreadPool& pool, const Progress& progress) {
  const std::vector<Candidate> all = candidates(volume, wanted, pool, progress);
  if (all.empty()) return std::nullopt;
  const auto varies_less = [](const Candidate& a, const Candidate& b) { return a.variance < b.variance; };
  const double most = wanted.even_enough * std::min_element(all.begin(), all.end(), varies_less)->variance;
  const glm::dvec3 centre = 0.5 * glm::dvec3(volume.geometry.size - Index3(1));
  // Even ones before others, then by distance.
  const auto rank = [&](const Candidate& one) {
    const glm::dvec3 offset = glm::dvec3(one.voxel) - centre;
    return std::pair(one.variance > most, glm::dot(offset, offset));
  };
  return std::min_element(all.begin(), all.end(),
                          [&](const Candidate& a, const Candidate& b) { return rank(a) < rank(b); })
      ->voxel;
}

template <class Stored>
Result<SuggestedStart> suggest(const Volume& source, const TypedVolume<Stored>& volume,
                               const StartHints& hints, const Progress& progress) {
  const auto [lowest, highest] = source.range();
  if (!(highest > lowest)) {
    return fail(ErrorKind::input, "all voxels have the value {}: there is nothing to find", lowest);
  }
  ThreadPool pool;
  const Histogram values = histogram(volume, lowest, highest);
  const bool ct = looks_like_ct(source, values);
  const double span = values.percentile(0.99) - values.percentile(0.01);
  std::optional<Index3> seed = hints.seed;
  if (!seed && hints.target) {
    const double within = hints.range ? 0.5 * *hints.range : kSpanShare * span;
    seed = most_even_voxel(volume, {*hints.target - within, *hints.target + within, kEvenEnough}, pool,
                           progress);
    if (!seed && !progress.cancelled()) {
      return fail(ErrorKind::input,
                  "no voxel in the middle half of the volume has a value within {:.6g} of {:.6g}", within,
                  *hints.target);
    }
  }
  // The most even tissue of a body is often fat, and its most frequent value, too.
  if (!seed && ct)
    seed = most_even_voxel(volume, {kSoftTissueLow, kSoftTissueHigh, kEvenEnough}, pool, progress);
  if (!seed) seed = most_even_voxel(volume, {otsu_threshold(values), highest}, pool, progress);
  if (progress.cancelled()) return cancelled_error();
  // Nothing of the kind in the middle: the middle itself.
  const Index3 voxel = seed.value_or(volume.geometry.size / std::int64_t{2});
  const Spread spread = neighbourhood(volume, voxel);
  const glm::dvec3 spacing = volume.geometry.spacing_mm;

  SuggestedStart suggestion;
  suggestion.voxel = voxel;
  suggestion.radius_mm = kSeedSpacings * std::min({spacing.x, spacing.y, spacing.z});
  suggestion.target = spread.mean;
  suggestion.range = std::max(2.0 * std::sqrt(spread.variance), ct ? kSoftTissueRange : kSpanShare * span);
  if (suggestion.range <= 0.0) suggestion.range = kSpanShare * (static_cast<double>(highest) - lowest);
  return suggestion;
}

}  // namespace

Result<SuggestedStart> suggest_start(const Volume& volume, const StartHints& hints,
                                     const Progress& progress) {
  return with_type(volume, [&](const auto& typed) { return suggest(volume, typed, hints, progress); });
}

}  // namespace tidemark::imaging
