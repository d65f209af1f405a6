#include "solver/trial.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "core/index_walk.h"
#include "gpu/device.h"
#include "solver/compute/compute_executor.h"
#include "solver/host/host_executor.h"
#include "solver/inside_region.h"

namespace tidemark::solver {
namespace {

constexpr Index3 kSize{56, 48, 40};
constexpr double kInside = 1000.0;
// Few steps each: between runs the processor reads what the GPU has written, as in use.
constexpr int kRuns = 12;
constexpr std::int64_t kStepsOfARun = 8;
constexpr int kRunsBeforeTheCut = 8;
constexpr double kLeastDice = 0.999;

Status compare_after_run(Executor& tried, Executor& trusted, std::int64_t steps) {
  if (const Status tables = tried.validate(); !tables) {
    return fail(ErrorKind::capability, "after {} steps: {}", steps, tables.error().message);
  }
  const auto found = tried.snapshot();
  if (!found) return pass_on(found);
  const auto expected = trusted.snapshot();
  if (!expected) return pass_on(expected);
  const double agreement = dice(inside_region(*found), inside_region(*expected));
  if (agreement >= kLeastDice) return {};
  return fail(ErrorKind::capability, "after {} steps the Dice index with the processor's surface is {:.3f}",
              steps, agreement);
}

}  // namespace

// Of the type of most cases, whose shaders are then compiled once.
std::shared_ptr<const Volume> trial_source() {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = kSize;
  std::vector<std::int16_t> values(static_cast<std::size_t>(volume->geometry.voxel_count()));
  const glm::dvec3 middle = 0.5 * glm::dvec3(kSize - Index3(1));
  std::size_t at = 0;
  for_each_index(Index3(0), kSize, [&](Index3 voxel) {
    const double radius = glm::length(glm::dvec3(voxel) - middle);
    values[at++] = static_cast<std::int16_t>(std::lround(kInside / (1.0 + std::exp(radius - 17.0))));
  });
  volume->voxels = std::move(values);
  return volume;
}

Parameters trial_parameters() {
  Parameters parameters;
  parameters.target = kInside;
  parameters.range = 0.5 * kInside;
  parameters.alpha = 0.8;
  return parameters;
}

Status compare_in_trial(Executor& tried, Executor& trusted) {
  const Geometry grid = trial_source()->geometry;
  const glm::dvec3 middle = 0.5 * glm::dvec3(grid.size - Index3(1));
  const auto in_both = [&](const auto& step) -> Status {
    TIDEMARK_TRY(step(tried));
    return step(trusted);
  };
  TIDEMARK_TRY(in_both(
      [&](Executor& executor) { return executor.paint(sphere_at_voxel(grid, middle, 4.0), Brush::add); }));
  for (int run = 0; run < kRuns; ++run) {
    if (run == kRunsBeforeTheCut) {
      const Sphere cut = sphere_at_voxel(grid, middle + glm::dvec3(8.0, 0.0, 0.0), 6.0);
      TIDEMARK_TRY(in_both([&](Executor& executor) { return executor.paint(cut, Brush::erase); }));
    }
    TIDEMARK_TRY(in_both([](Executor& executor) -> Status {
      const auto report = executor.advance({.steps = kStepsOfARun});
      return report ? Status() : pass_on(report);
    }));
    TIDEMARK_TRY(compare_after_run(tried, trusted, (run + 1) * kStepsOfARun));
  }
  return {};
}

Status try_compute(const std::shared_ptr<gpu::Device>& device) {
  static std::mutex mutex;
  static std::set<std::string> passed;
  const gpu::Capabilities& driver = device->capabilities();
  const std::string name = fmt::format("{}, {}", driver.renderer, driver.version);
  const std::lock_guard lock(mutex);
  if (passed.contains(name)) return {};
  ExecutorOptions options;
  options.device = device;
  const auto source = trial_source();
  auto tried = ComputeExecutor::create(source, trial_parameters(), options);
  if (!tried) return pass_on(tried);
  options.device = nullptr;
  options.threads = 1;
  auto trusted = HostExecutor::create(source, trial_parameters(), options);
  if (!trusted) return pass_on(trusted);
  if (const Status same = compare_in_trial(**tried, **trusted); !same) {
    if (device->lost()) return same;  // which says nothing of how it computes
    return fail(ErrorKind::capability, "the graphics driver ({}) computes a trial wrongly: {}", name,
                same.error().message);
  }
  passed.insert(name);
  return {};
}

}  // namespace tidemark::solver
