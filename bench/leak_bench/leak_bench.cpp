// Leaks that are found, missed and seen where there are none.
//   leak_bench                                  phantoms with and without a neck
//   leak_bench IMAGE T EPSILON ALPHA I J K MM   a study, from a ball around a voxel
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>
#include <vector>

#include "document/leak.h"
#include "imaging/load_study.h"
#include "imaging/phantom/phantom.h"
#include "solver/executor.h"
#include "tests/document/lobes.h"

using namespace tidemark;

namespace {

constexpr std::int64_t kSteps = 8;  // between two looks
const document::LeakRule rule;

struct Run {
  std::shared_ptr<const Volume> volume;
  solver::Parameters parameters;
  solver::Sphere seed;
  std::function<bool(Index3)> behind;
  double least_behind = 100;
};

struct Alarm {
  bool raised = false;
  bool is_leak = false;   // something has grown behind the neck
  std::int64_t late = 0;  // steps after it had
};

Alarm try_run(const std::string& name, const Run& run, std::int64_t most) {
  auto made = solver::make_executor(solver::ExecutorKind::host, run.volume, run.parameters);
  if (!made) return fmt::print("{}: {}\n", name, made.error().message), Alarm{};
  solver::Executor& executor = **made;
  (void)executor.paint(run.seed, solver::Brush::add);
  solver::FrontPatches patches(run.volume->geometry);
  document::LeakFinder finder;
  (void)patches.restart(executor);
  double solver_s = 0.0, look_s = 0.0, find_s = 0.0;
  std::int64_t step = 0, leaked_at = -1;
  bool converged = false;
  const auto now = [] { return std::chrono::steady_clock::now(); };
  const auto since = [&](auto t) { return std::chrono::duration<double>(now() - t).count(); };
  std::optional<document::Leak> leak;
  while (step < most && !converged) {
    auto t = now();
    const auto report = executor.advance({.steps = kSteps, .until_converged = true});
    solver_s += since(t);
    step += report->steps;
    converged = report->converged;
    t = now();
    const auto arrived = patches.look(executor);
    look_s += since(t);
    if (run.behind && leaked_at < 0) {
      const Mask mask = executor.snapshot()->mask();
      std::int64_t count = 0;
      for (std::int64_t o = 0; o < run.volume->geometry.voxel_count(); ++o)
        if (mask.voxels[static_cast<std::size_t>(o)] != 0 && run.behind(run.volume->geometry.voxel_at(o)))
          ++count;
      if (count >= run.least_behind) leaked_at = step;
    }
    if (*arrived == 0) continue;
    t = now();
    leak = finder.find(patches, rule);
    find_s += since(t);
    if (leak) break;
  }
  fmt::print("{:12} {} at {:5} (leaked at {:5}) steps; solver {:.3f} s, looks {:.3f} s, search {:.3f} s",
             name, leak ? "LEAK" : "none", step, leaked_at, solver_s, look_s, find_s);
  if (leak) {
    fmt::print("; neck ({}, {}, {}) {:.0f} mm2, {:.2f} ml behind, {} voxels", leak->middle.x, leak->middle.y,
               leak->middle.z, leak->area_mm2, leak->volume_ml, leak->neck.size());
  }
  fmt::print("\n");
  return {leak.has_value(), leaked_at >= 0, step - leaked_at};
}

// How many of the runs raised an alarm, and how late those that leaked did at the most.
void tell(const char* what, const std::vector<Alarm>& alarms) {
  std::size_t raised = 0;
  std::int64_t latest = 0;
  for (const Alarm& alarm : alarms) {
    raised += alarm.raised ? 1 : 0;
    if (alarm.raised && alarm.is_leak) latest = std::max(latest, alarm.late);
  }
  fmt::print("{}: {} of {} with an alarm, at most {} steps after the leak\n", what, raised, alarms.size(),
             latest);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 9) {
    auto study = imaging::load_volume(argv[1]);
    if (!study) return fmt::print("{}\n", study.error().message), 3;
    Run run;
    run.volume = std::make_shared<const Volume>(std::move(*study));
    run.parameters.target = std::atof(argv[2]);
    run.parameters.range = std::atof(argv[3]);
    run.parameters.alpha = std::atof(argv[4]);
    run.seed = {run.volume->geometry.to_patient({std::atof(argv[5]), std::atof(argv[6]), std::atof(argv[7])}),
                std::atof(argv[8])};
    try_run("study", run, 20000);
    return 0;
  }
  for (const std::string_view kind : imaging::phantom_kinds()) {
    imaging::Phantom phantom = *imaging::make_phantom(kind);
    if (!phantom.seed) continue;
    Run run;
    run.parameters.target = phantom.target;
    run.parameters.range = phantom.range;
    run.parameters.alpha = phantom.alpha;
    run.volume = std::make_shared<const Volume>(std::move(phantom.volume));
    const auto& seed = *phantom.seed;
    run.seed = {run.volume->geometry.to_patient({seed[0], seed[1], seed[2]}), seed[3]};
    try_run(std::string(kind), run, 20000);
    for (const double alpha : {0.9, 1.0}) {
      if (kind != "bridge" && kind != "organ") continue;
      run.parameters.alpha = alpha;
      try_run(fmt::format("{} {}", kind, alpha), run, 20000);
    }
  }
  std::vector<Alarm> with_neck, without_neck;
  for (unsigned n = 0; n < 20; ++n) {
    test::Lobes lobes = test::lobes_with_neck(n);
    const double least_behind = std::max(100.0, 2.0 / 3.0 * M_PI * std::pow(2.0 * lobes.neck_mm, 3));
    with_neck.push_back(try_run(fmt::format("neck {}", n),
                                {lobes.volume, lobes.parameters, lobes.seed, lobes.behind, least_behind},
                                20000));
    lobes = test::lobes_without_neck(n);
    without_neck.push_back(
        try_run(fmt::format("no neck {}", n), {lobes.volume, lobes.parameters, lobes.seed, {}}, 20000));
  }
  tell("with a neck", with_neck);
  tell("without one", without_neck);
  return 0;
}
