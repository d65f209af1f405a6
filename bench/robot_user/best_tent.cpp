#include "best_tent.h"

#include <algorithm>
#include <vector>

#include "robot.h"
#include "solver/executor.h"

namespace tidemark {
namespace {

constexpr double kLow[] = {0.0, 0.01, 0.03, 0.06, 0.1, 0.2, 0.3};
constexpr double kHigh[] = {0.7, 0.8, 0.9, 0.94, 0.97, 0.99, 1.0};
constexpr std::size_t kTried = 3;

struct Interval {
  double low = 0.0;
  double high = 0.0;
  double dice = 0.0;  // by a threshold
};

std::vector<Interval> intervals(const std::vector<double>& values, const Mask& truth, Index3 seed) {
  std::vector<double> inside;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (truth.voxels[i] != 0) inside.push_back(values[i]);
  }
  std::sort(inside.begin(), inside.end());
  const auto quantile = [&](double share) {
    return inside[static_cast<std::size_t>(share * static_cast<double>(inside.size() - 1))];
  };
  std::vector<Interval> found;
  std::vector<double> within(values.size());
  for (const double low_share : kLow) {
    for (const double high_share : kHigh) {
      Interval interval{quantile(low_share), quantile(high_share)};
      if (interval.low >= interval.high) continue;
      std::transform(values.begin(), values.end(), within.begin(), [&](double value) {
        return value >= interval.low && value <= interval.high ? 1.0 : 0.0;
      });
      interval.dice = dice(connected(truth.geometry, within, {seed}), truth);
      found.push_back(interval);
    }
  }
  std::sort(found.begin(), found.end(), [](const Interval& a, const Interval& b) { return a.dice > b.dice; });
  found.resize(std::min(found.size(), kTried));
  return found;
}

}  // namespace

Result<double> best_tent(const std::shared_ptr<const Volume>& source, const Mask& truth, Index3 seed,
                         double alpha, std::int64_t steps) {
  const Geometry& grid = truth.geometry;
  std::vector<double> values(static_cast<std::size_t>(grid.voxel_count()));
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = static_cast<double>(source->value(static_cast<std::int64_t>(i)));
  }
  const double unit = std::min({grid.spacing_mm.x, grid.spacing_mm.y, grid.spacing_mm.z});
  double best = 0.0;
  for (const Interval& interval : intervals(values, truth, seed)) {
    solver::Parameters parameters;
    parameters.alpha = alpha;
    parameters.target = 0.5 * (interval.low + interval.high);
    parameters.range = 0.5 * (interval.high - interval.low);
    auto executor = solver::make_executor(solver::ExecutorKind::host, source, parameters);
    if (!executor) return pass_on(executor);
    TIDEMARK_TRY(
        (*executor)->paint(solver::sphere_at_voxel(grid, glm::dvec3(seed), 4.0 * unit), solver::Brush::add));
    const auto report = (*executor)->advance({.steps = steps, .until_converged = true});
    if (!report) return pass_on(report);
    const auto phi = (*executor)->snapshot();
    if (!phi) return pass_on(phi);
    best = std::max(best, dice(phi->mask(), truth));
  }
  return best;
}

}  // namespace tidemark
