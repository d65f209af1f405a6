#include <fmt/format.h>

#include <cmath>

#include "bench/peers/measurements.h"

namespace tidemark::bench {
namespace {

constexpr std::int64_t kSide = 256;
constexpr double kRange = 4.0;

// The distance from the centre, so that a sphere of radius r stops near T = r - epsilon.
Volume distance_volume() {
  Volume volume;
  volume.geometry.size = Index3(kSide);
  const glm::dvec3 centre(0.5 * static_cast<double>(kSide - 1));
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(volume.geometry.voxel_count()));
  for (std::int64_t k = 0; k < kSide; ++k) {
    for (std::int64_t j = 0; j < kSide; ++j) {
      for (std::int64_t i = 0; i < kSide; ++i) {
        values.push_back(static_cast<float>(glm::length(glm::dvec3(i, j, k) - centre)));
      }
    }
  }
  volume.voxels = std::move(values);
  return volume;
}

struct Point {
  double radius = 0.0;
  std::unique_ptr<solver::Executor> executor;
  double resident_voxels = 0.0;
  double bytes = 0.0;
  std::vector<double> step_seconds;
};

Result<Point> make_point(const std::shared_ptr<const Volume>& source, double radius) {
  solver::Parameters parameters;
  parameters.target = radius - kRange;
  parameters.range = kRange;
  parameters.alpha = 0.5;
  solver::ExecutorOptions options;
  options.threads = kThreads;
  options.skip_quiet_pages = false;
  auto executor = solver::make_executor(solver::ExecutorKind::host, source, parameters, options);
  if (!executor) return pass_on(executor);
  const glm::dvec3 centre(0.5 * static_cast<double>(kSide - 1));
  TIDEMARK_TRY((*executor)->paint({centre, radius}, solver::Brush::add));
  TIDEMARK_TRY((*executor)->advance({.steps = 20}));
  const solver::MemoryReport memory = (*executor)->memory();
  Point point;
  point.radius = radius;
  point.resident_voxels = static_cast<double>(memory.resident_pages) * 512.0;
  point.bytes = static_cast<double>(memory.peak_state_bytes);
  point.executor = std::move(*executor);
  return point;
}

// How well a straight line explains y.
double r_squared(const std::vector<double>& x, const std::vector<double>& y) {
  const auto n = static_cast<double>(x.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    mean_x += x[i] / n;
    mean_y += y[i] / n;
  }
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
    yy += (y[i] - mean_y) * (y[i] - mean_y);
  }
  return xy * xy / (xx * yy);
}

}  // namespace

Status measure_scaling(const Settings& settings, Report& report) {
  const auto source = std::make_shared<const Volume>(distance_volume());
  std::vector<Point> points;
  for (double radius = 20; radius <= 120; radius += 20) {
    auto point = make_point(source, radius);
    if (!point) return pass_on(point);
    points.push_back(std::move(*point));
  }
  // Short turns, so that a slower minute of the machine meets every radius.
  const int turns = settings.quick ? 3 : 5 * settings.rounds;
  for (int turn = 0; turn < turns; ++turn) {
    for (Point& point : points) {
      const auto steps = static_cast<std::int64_t>(4e7 / point.resident_voxels) + 1;
      auto run = point.executor->advance({.steps = steps});
      if (!run) return pass_on(run);
      point.step_seconds.push_back(run->seconds / static_cast<double>(run->steps));
    }
  }
  std::vector<double> voxels;
  std::vector<double> seconds;
  std::vector<double> bytes;
  std::vector<std::vector<Cell>> rows;
  for (const Point& point : points) {
    voxels.push_back(point.resident_voxels);
    seconds.push_back(median(point.step_seconds));
    bytes.push_back(point.bytes);
    rows.push_back({text(fmt::format("{:.0f}", point.radius)), number(point.resident_voxels),
                    number(1e6 * seconds.back(), 1), number(1e9 * seconds.back() / point.resident_voxels, 3),
                    number(point.bytes / 1e6, 2), number(point.bytes / point.resident_voxels, 2)});
  }
  report.table("Spheres in 256^3, every page computed",
               {"radius", "resident voxels", "us/step", "ns/voxel", "MB", "bytes/voxel"}, rows);
  report.at_least("spheres: time per step linear in resident voxels, R^2", r_squared(voxels, seconds), 0.99,
                  4);
  report.at_least("spheres: bytes linear in resident voxels, R^2", r_squared(voxels, bytes), 0.99, 4);
  return {};
}

}  // namespace tidemark::bench
