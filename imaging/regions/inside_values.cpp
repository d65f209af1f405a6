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

template <class Stored>
double highest_ball(const Region& region, const TypedVolume<Stored>& image) {
  constexpr double kBallMm3 = 1000.0;
  const Ball ball = ball_of(image.geometry, std::cbrt(3.0 * kBallMm3 / (4.0 * std::numbers::pi)));
  double highest = std::numeric_limits<double>::lowest();
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    for (const std::int64_t end = voxel.x + length; voxel.x < end; ++voxel.x) {
      double sum = 0.0;
      std::int64_t count = 0;
      for (const BallRow& row : ball.rows) {
        const Index3 first(std::max<std::int64_t>(voxel.x - row.half, 0), voxel.y + row.j, voxel.z + row.k);
        if (!image.geometry.contains(first)) continue;
        const std::int64_t last = std::min(voxel.x + row.half, image.geometry.size.x - 1);
        const Stored* const values = image.stored.data() + image.geometry.offset(first);
        sum = std::accumulate(values, values + (last - first.x + 1), sum);
        count += last - first.x + 1;
      }
      highest = std::max(highest, image.slope * sum / static_cast<double>(count) + image.intercept);
    }
  });
  return highest;
}

}  // namespace

InsideValues values_inside(const Region& region, const Volume& image) {
  return with_type(image, [&]<class Stored>(const TypedVolume<Stored>& typed) {
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
      inside.uptake = Uptake{highest_ball(region, typed), inside.mean * ml};
    }
    return inside;
  });
}

}  // namespace tidemark::imaging
