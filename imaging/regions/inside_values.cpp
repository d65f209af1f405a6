#include "imaging/regions/inside_values.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "core/typed_volume.h"
#include "imaging/regions/ball.h"

namespace tidemark::imaging {
namespace {

// Changes the order of the values.
template <class Stored>
double percentile(std::vector<Stored>& values, double percent) {
  const double rank = percent / 100.0 * static_cast<double>(values.size() - 1);
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(rank);
  std::nth_element(values.begin(), at, values.end());
  const auto value = static_cast<double>(*at);
  const double share = rank - std::floor(rank);
  if (share == 0.0) return value;
  return std::lerp(value, static_cast<double>(*std::min_element(at + 1, values.end())), share);
}

// The sums over the balls around the voxels of a run, and how many voxels of the image each of them has.
struct BallSums {
  std::vector<double> sums;
  std::vector<std::int64_t> counts;
};

// Of the voxels of a row of the image up to one of them.
struct SumSoFar {
  double sum = 0.0;
  std::int64_t count = 0;
};

// Adds a row of the ball for each voxel of the run that begins at `voxel`. `so_far` is room for the sums
// along that row of the image.
template <class Stored>
void add_row(const TypedVolume<Stored>& image, const Region* covered, const BallRow& row, Index3 voxel,
             std::vector<SumSoFar>& so_far, BallSums& balls) {
  const auto length = static_cast<std::int64_t>(balls.sums.size());
  const std::int64_t width = image.geometry.size.x;
  const Index3 first(std::max<std::int64_t>(voxel.x - row.half, 0), voxel.y + row.j, voxel.z + row.k);
  if (!image.geometry.contains(first)) return;
  const Stored* const values = image.stored.data() + image.geometry.offset(first);
  so_far.assign(1, {});
  for (std::int64_t x = first.x; x < std::min(voxel.x + length + row.half, width); ++x) {
    SumSoFar next = so_far.back();
    if (covered == nullptr || covered->contains({x, first.y, first.z})) {
      next.sum += static_cast<double>(values[x - first.x]);
      ++next.count;
    }
    so_far.push_back(next);
  }
  for (std::int64_t n = 0; n < length; ++n) {
    const std::int64_t from = std::max<std::int64_t>(voxel.x + n - row.half, 0) - first.x;
    const std::int64_t to = std::min(voxel.x + n + row.half + 1, width) - first.x;
    const SumSoFar& before = so_far[static_cast<std::size_t>(from)];
    const SumSoFar& behind = so_far[static_cast<std::size_t>(to)];
    balls.sums[static_cast<std::size_t>(n)] += behind.sum - before.sum;
    balls.counts[static_cast<std::size_t>(n)] += behind.count - before.count;
  }
}

// Fails (ErrorKind::cancelled).
template <class Stored>
Result<double> highest_ball(const Region& region, const TypedVolume<Stored>& image, const Region* covered,
                            const Progress& progress) {
  constexpr double kBallMm3 = 1000.0;
  const Ball ball = ball_of(image.geometry, std::cbrt(3.0 * kBallMm3 / (4.0 * std::numbers::pi)));
  double highest = std::numeric_limits<double>::lowest();
  BallSums balls;
  std::vector<SumSoFar> so_far;
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    if (progress.cancelled()) return;
    balls.sums.assign(static_cast<std::size_t>(length), 0.0);
    balls.counts.assign(static_cast<std::size_t>(length), 0);
    for (const BallRow& row : ball.rows) add_row(image, covered, row, voxel, so_far, balls);
    for (std::size_t n = 0; n < balls.sums.size(); ++n) {
      const double mean =
          image.slope * balls.sums[n] / static_cast<double>(balls.counts[n]) + image.intercept;
      highest = std::max(highest, mean);
    }
  });
  if (progress.cancelled()) return cancelled_error();
  return highest;
}

}  // namespace

Result<InsideValues> values_inside(const Region& region, const Volume& image, const Progress& progress,
                                   const Region* covered) {
  return with_type(image, [&]<class Stored>(const TypedVolume<Stored>& typed) -> Result<InsideValues> {
    std::vector<Stored> values;
    region.for_each_run([&](Index3 voxel, std::int64_t length) {
      const auto first = typed.stored.begin() + typed.geometry.offset(voxel);
      values.insert(values.end(), first, first + length);
    });
    const auto rescaled = [&](double stored) { return typed.slope * stored + typed.intercept; };
    const auto count = static_cast<double>(values.size());
    const double mean = std::accumulate(values.begin(), values.end(), 0.0) / count;
    double squares = 0.0;
    for (const Stored value : values)
      squares += (static_cast<double>(value) - mean) * (static_cast<double>(value) - mean);
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const auto [smallest, largest] =
        std::minmax({rescaled(static_cast<double>(*low)), rescaled(static_cast<double>(*high))});
    InsideValues inside;
    inside.smallest = smallest;
    inside.largest = largest;
    inside.mean = rescaled(mean);
    inside.standard_deviation = std::abs(typed.slope) * std::sqrt(squares / count);
    for (std::size_t n = 0; n < kPercentiles.size(); ++n) {
      const double percent = typed.slope < 0.0 ? 100.0 - kPercentiles[n] : kPercentiles[n];
      inside.percentiles[n] = rescaled(percentile(values, percent));
    }
    if (image.unit.starts_with("SUV")) {
      const double ml = count * image.geometry.voxel_volume_ml();
      const auto peak = highest_ball(region, typed, covered, progress);
      if (!peak) return pass_on(peak);
      inside.uptake = Uptake{*peak, inside.mean * ml};
    }
    return inside;
  });
}

}  // namespace tidemark::imaging
