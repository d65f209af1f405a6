// Statistics of the volume's values by region.
#include <cmath>

#include "document/labels.h"

namespace tidemark::document {
namespace {

// Sums of one region. The shift keeps the squares small where all values are far from 0 (Welford's update
// would divide at every voxel).
struct Sums {
  std::int64_t voxels = 0;
  double shift = 0.0;
  double sum = 0.0;
  double squares = 0.0;

  void add(double value) {
    if (voxels++ == 0) shift = value;
    const double d = value - shift;
    sum += d;
    squares += d * d;
  }
  [[nodiscard]] RegionStatistics result(const Volume& volume) const {
    RegionStatistics statistics;
    statistics.voxels = voxels;
    statistics.volume_ml = static_cast<double>(voxels) * volume.geometry.voxel_volume_ml();
    if (voxels == 0) return statistics;
    const double n = static_cast<double>(voxels);
    // Of stored values so far.
    statistics.mean = volume.slope * (shift + sum / n) + volume.intercept;
    const double variance = std::max(squares / n - (sum / n) * (sum / n), 0.0);
    statistics.standard_deviation = std::abs(volume.slope) * std::sqrt(variance);
    return statistics;
  }
};

}  // namespace

RegionStatistics statistics_in(const Volume& volume, const Mask& mask) {
  Sums sums;
  std::visit(
      [&](const auto& stored) {
        for (std::size_t i = 0; i < stored.size() && i < mask.voxels.size(); ++i) {
          if (mask.voxels[i] != 0) sums.add(static_cast<double>(stored[i]));
        }
      },
      volume.voxels);
  return sums.result(volume);
}

std::vector<RegionStatistics> statistics_by_label(const Volume& volume, const Labels& labels) {
  std::vector<Sums> sums(256);
  const std::span<const std::uint8_t> ids = labels.voxels();
  std::visit(
      [&](const auto& stored) {
        for (std::size_t i = 0; i < stored.size() && i < ids.size(); ++i) {
          if (ids[i] != 0) sums[ids[i]].add(static_cast<double>(stored[i]));
        }
      },
      volume.voxels);
  std::vector<RegionStatistics> statistics;
  for (const Sums& one : sums) statistics.push_back(one.result(volume));
  return statistics;
}

}  // namespace tidemark::document
