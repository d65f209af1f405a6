#include "engine/source_summary.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <tuple>
#include <type_traits>

#include "core/thread_pool.h"
#include "core/typed_volume.h"
#include "renderer/sheet.h"

namespace tidemark::engine {
namespace {

constexpr std::int64_t kPiece = 1'000'000;    // voxels between two looks whether to stop
constexpr std::int64_t kSamples = 2'000'000;  // of gradients: enough for the picture of a distribution

int bin_of(float value, float low, float high) {
  if (!(high > low)) return 0;
  // What lies far beyond the range does not fit into an int.
  const float share = std::clamp((value - low) / (high - low), 0.0F, 1.0F);
  return std::min(static_cast<int>(share * SourceSummary::kBins), SourceSummary::kBins - 1);
}

template <class Stored>
float gradient_magnitude(const TypedVolume<Stored>& volume, Index3 voxel) {
  const Geometry& geometry = volume.geometry;
  double square = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    Index3 low = voxel;
    Index3 high = voxel;
    low[axis] = std::max<std::int64_t>(low[axis] - 1, 0);
    high[axis] = std::min(high[axis] + 1, geometry.size[axis] - 1);
    if (low[axis] == high[axis]) continue;
    const double distance_mm = static_cast<double>(high[axis] - low[axis]) * geometry.spacing_mm[axis];
    const double rise = (double{volume.value(high)} - double{volume.value(low)}) / distance_mm;
    square += rise * rise;
  }
  return static_cast<float>(std::sqrt(square));
}

// What count(piece of the voxels, counts) adds up in `size` counters, on every thread in counters of its own.
// Stops early on request.
template <class Stored, class Count>
std::vector<std::int64_t> add_up(const std::vector<Stored>& voxels, std::size_t size, ThreadPool& pool,
                                 const Progress& progress, const Count& count) {
  std::vector<std::vector<std::int64_t>> counts(static_cast<std::size_t>(pool.threads()),
                                                std::vector<std::int64_t>(size));
  const auto piece = [&](std::int64_t begin, std::int64_t end, int member) {
    if (progress.cancelled()) return;
    count(std::span(voxels).subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin)),
          counts[static_cast<std::size_t>(member)]);
  };
  pool.for_each(static_cast<std::int64_t>(voxels.size()), kPiece, piece);
  std::vector<std::int64_t> sum(size);
  for (const auto& own : counts)
    std::transform(own.begin(), own.end(), sum.begin(), sum.begin(), std::plus());
  return sum;
}

// Integers have a counter for each value that can be stored, and are looked at once.
template <class Stored>
void count_integers(const TypedVolume<Stored>& volume, SourceSummary& summary, ThreadPool& pool,
                    const Progress& progress) {
  using Limits = std::numeric_limits<Stored>;
  const std::vector<std::int64_t> counts =
      add_up(volume.stored, std::size_t{1} << 16U, pool, progress,
             [](std::span<const Stored> voxels, std::vector<std::int64_t>& own) {
               for (const Stored voxel : voxels) ++own[static_cast<std::size_t>(voxel - Limits::min())];
             });
  const auto value_at = [&](std::size_t place) {
    return volume.rescaled(static_cast<Stored>(static_cast<int>(place) + Limits::min()));
  };
  std::vector<std::size_t> places;  // that occur
  for (std::size_t place = 0; place < counts.size(); ++place) {
    if (counts[place] > 0) places.push_back(place);
  }
  if (places.empty()) return;
  // The slope may be negative.
  std::tie(summary.lowest, summary.highest) =
      std::minmax({value_at(places.front()), value_at(places.back())});
  for (const std::size_t place : places) {
    const int bin = bin_of(value_at(place), summary.lowest, summary.highest);
    summary.values[static_cast<std::size_t>(bin)] += counts[place];
  }
}

void count_numbers(const TypedVolume<float>& volume, SourceSummary& summary, ThreadPool& pool,
                   const Progress& progress) {
  summary.values = add_up(volume.stored, SourceSummary::kBins, pool, progress,
                          [&](std::span<const float> voxels, std::vector<std::int64_t>& own) {
                            for (const float voxel : voxels) {
                              const int bin = bin_of(volume.rescaled(voxel), summary.lowest, summary.highest);
                              ++own[static_cast<std::size_t>(bin)];
                            }
                          });
}

// A value and its gradient.
using Sample = std::pair<float, float>;

// Of every stride-th voxel.
template <class Stored>
std::vector<Sample> sample(const TypedVolume<Stored>& volume, ThreadPool& pool, const Progress& progress) {
  const auto count = static_cast<std::int64_t>(volume.stored.size());
  const std::int64_t stride = std::max<std::int64_t>(1, count / kSamples) | 1;  // odd: no column is favoured
  std::vector<Sample> samples(static_cast<std::size_t>((count + stride - 1) / stride));
  const auto piece = [&](std::int64_t begin, std::int64_t end, int) {
    if (progress.cancelled()) return;
    for (std::int64_t i = begin; i < end; ++i) {
      const std::int64_t offset = i * stride;
      samples[static_cast<std::size_t>(i)] = {volume.value(offset),
                                              gradient_magnitude(volume, volume.geometry.voxel_at(offset))};
    }
  };
  pool.for_each(static_cast<std::int64_t>(samples.size()), kPiece / 16, piece);
  if (progress.cancelled()) samples.clear();
  return samples;
}

void count_gradients(const std::vector<Sample>& samples, SourceSummary& summary) {
  if (samples.empty()) return;
  std::vector<float> slopes(samples.size());
  std::transform(samples.begin(), samples.end(), slopes.begin(),
                 [](const Sample& one) { return one.second; });
  const auto rank = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() - 1 - slopes.size() / 200);
  std::nth_element(slopes.begin(), rank, slopes.end());
  summary.steepest = *rank > 0.0F ? *rank : 1.0F;
  for (const auto& [value, slope] : samples) {
    const int column = bin_of(value, summary.low, summary.high);
    const int row = bin_of(slope, 0.0F, summary.steepest);
    ++summary.value_gradient[static_cast<std::size_t>(row * SourceSummary::kBins + column)];
  }
}

}  // namespace

float gradient_magnitude(const Volume& volume, Index3 voxel) {
  return with_type(volume, [&](const auto& typed) { return gradient_magnitude(typed, voxel); });
}

SourceSummary summarise(const Volume& volume, const Progress& progress) {
  ThreadPool pool;
  SourceSummary summary;
  std::tie(summary.low, summary.high) = volume.common_range();
  summary.window = renderer::window_of(volume);
  summary.values.assign(SourceSummary::kBins, 0);
  summary.value_gradient.assign(std::size_t{SourceSummary::kBins} * SourceSummary::kBins, 0);
  with_type(volume, [&](const auto& typed) {
    if constexpr (std::is_integral_v<std::decay_t<decltype(typed.stored.front())>>) {
      count_integers(typed, summary, pool, progress);
    } else {
      std::tie(summary.lowest, summary.highest) = volume.range();
      count_numbers(typed, summary, pool, progress);
    }
    count_gradients(sample(typed, pool, progress), summary);
  });
  return summary;
}

}  // namespace tidemark::engine
