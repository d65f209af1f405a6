#include "document/sweep.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <utility>

#include "core/checked.h"
#include "core/thread_pool.h"
#include "core/without_exceptions.h"
#include "document/executor_setup.h"
#include "solver/inside_region.h"
#include "solver/speed/speed_registry.h"
#include "solver/statistics.h"

namespace tidemark::document {
namespace {

// Of a run's share of the budget for its executor: the rest is for the copy of phi that it ends with.
constexpr double kExecutorShare = 0.75;

// The runs of a sweep while they are computed.
class Runs {
 public:
  Runs(const SweepStart& start, const SweepOptions& options, const Progress& progress)
      : start_(start), options_(options), progress_(progress) {}

  Result<Sweep> compute();

 private:
  void plan();
  Status share_memory(int threads);
  void compute_one(SweepRun& run);
  Status evolve(SweepRun& run);
  Result<std::shared_ptr<const solver::SpeedFunction>> speed_of(const SweepRun& run);
  void end(SweepRun& run, const Status& status);
  [[nodiscard]] const std::shared_ptr<const Drive>& drive_of(const SweepRun& run) const {
    return run.drive == nullptr ? start_.drive : run.drive;
  }
  [[nodiscard]] Progress silent() const { return {nullptr, stop_.get_token()}; }

  const SweepStart& start_;
  const SweepOptions& options_;
  const Progress& progress_;
  Sweep sweep_;
  std::int64_t executor_budget_ = 0;  // bytes, of each run

  std::stop_source stop_;  // of all runs: asked for, or one of them has failed
  std::mutex mutex_;       // of what follows
  std::size_t ended_ = 0;
  Status failure_;

  // Functions that are not made yet, one for each drive of runs (null: of SweepStart): runs that share one
  // wait for each other.
  struct Made {
    std::once_flag once;
    Result<std::shared_ptr<const solver::SpeedFunction>> speed{nullptr};
  };
  std::map<const Drive*, Made> made_;  // filled before the runs begin
};

void Runs::plan() {
  sweep_.axes = options_.axes;
  std::map<std::vector<double>, std::shared_ptr<const Drive>> drives;
  for (int row = 0; row < sweep_.rows(); ++row) {
    for (int column = 0; column < sweep_.columns(); ++column) {
      SweepRun run;
      run.parameters = start_.parameters;
      Drive drive = value_of(start_.drive);
      std::vector<double> of_speed;
      for (std::size_t i = 0; i < sweep_.axes.size(); ++i) {
        const SweepAxis& axis = sweep_.axes[i];
        const double value = axis.value(i == 0 ? column : row);
        set_parameter(axis.parameter, value, run.parameters, drive.setting);
        if (is_of_speed(axis.parameter)) of_speed.push_back(value);
      }
      if (!of_speed.empty()) {
        auto& shared = drives[of_speed];
        if (shared == nullptr) shared = std::make_shared<const Drive>(std::move(drive));
        run.drive = shared;
      }
      made_[run.drive.get()];
      sweep_.runs.push_back(std::move(run));
    }
  }
}

Status Runs::share_memory(int threads) {
  const Index3 size = start_.source->geometry.size;
  const auto bits = checked_product(most_region_bytes(size), std::ssize(sweep_.runs));
  const auto counts = checked_product(size.x, size.y, size.z);
  const std::int64_t left =
      bits && counts ? options_.memory_budget_bytes - *bits - *counts : std::int64_t{-1};
  if (left <= 0) {
    return fail(ErrorKind::capability,
                "the memory budget of {} MB does not hold the results of {} runs on {} x {} x {} voxels",
                options_.memory_budget_bytes >> 20, sweep_.runs.size(), size.x, size.y, size.z);
  }
  const std::int64_t share = left / threads;
  executor_budget_ = static_cast<std::int64_t>(kExecutorShare * static_cast<double>(share));
  return {};
}

Result<Sweep> Runs::compute() {
  TIDEMARK_TRY(check(options_.axes, start_.parameters, value_of(start_.drive).setting));
  plan();
  const auto count = std::ssize(sweep_.runs);
  ThreadPool pool(static_cast<int>(
      std::min<std::int64_t>(count, options_.threads > 0 ? options_.threads : available_processors())));
  TIDEMARK_TRY(share_memory(pool.threads()));
  const std::stop_callback pass_on_stop(progress_.stop, [this] { stop_.request_stop(); });
  pool.for_each(count, 1, [this](std::int64_t begin, std::int64_t end, int /*member*/) {
    for (; begin < end; ++begin) compute_one(sweep_.runs[static_cast<std::size_t>(begin)]);
  });
  if (progress_.cancelled()) return cancelled_error();
  TIDEMARK_TRY(std::move(failure_));
  std::vector<const Region*> surfaces;
  for (const SweepRun& run : sweep_.runs) {
    if (run.problem.empty()) surfaces.push_back(&run.inside);
  }
  if (surfaces.empty()) {
    return fail(ErrorKind::capability, "no run has an end: {}", sweep_.runs.front().problem);
  }
  sweep_.agreement = Agreement(surfaces, start_.source->geometry.size);
  return std::move(sweep_);
}

void Runs::compute_one(SweepRun& run) {
  if (stop_.stop_requested()) return;
  end(run, without_exceptions([&] { return evolve(run); }));
}

// Without memory a run has no end; whatever else fails, fails the sweep.
void Runs::end(SweepRun& run, const Status& status) {
  const std::lock_guard lock(mutex_);
  ++ended_;
  if (!status) {
    if (status.error().kind == ErrorKind::capability) {
      run.problem = status.error().message;
    } else if (!stop_.stop_requested()) {
      failure_ = status;
      stop_.request_stop();
    }
  }
  if (!stop_.stop_requested()) {
    progress_(static_cast<double>(ended_) / static_cast<double>(sweep_.runs.size()), "runs");
  }
}

Result<std::shared_ptr<const solver::SpeedFunction>> Runs::speed_of(const SweepRun& run) {
  if (run.drive == nullptr && start_.speed != nullptr) return start_.speed;
  Made& made = made_.at(run.drive.get());
  std::call_once(made.once, [&] {
    made.speed = without_exceptions(
        [&] { return make_speed(*drive_of(run), start_.source, start_.parameters, silent()); });
  });
  return made.speed;
}

Status Runs::evolve(SweepRun& run) {
  solver::ExecutorOptions options;
  options.threads = 1;
  options.memory_budget_bytes = executor_budget_;
  options.skip_quiet_pages = options_.skip_quiet_pages;
  auto setup = ExecutorSetup::create(start_.source, 0.0, run.parameters, solver::ExecutorKind::host, options);
  if (!setup) return pass_on(setup);
  if (drive_of(run) != nullptr) {
    auto speed = speed_of(run);
    if (!speed) return pass_on(speed);
    TIDEMARK_TRY(setup->set_drive(drive_of(run), std::move(*speed)));
  }
  TIDEMARK_TRY(setup->set_limit(start_.limit));
  TIDEMARK_TRY(setup->executor().restore(*start_.phi));
  const auto report = setup->executor().advance({options_.steps, options_.until_converged, silent()});
  if (!report) return pass_on(report);
  if (stop_.stop_requested()) return cancelled_error();
  const auto phi = setup->executor().snapshot();
  if (!phi) return pass_on(phi);
  const solver::SurfaceStatistics surface = solver::measure(*phi);
  run.steps = report->steps;
  run.converged = report->converged;
  run.volume_ml = surface.volume_ml;
  run.outcome =
      outcome_of({*phi, surface.voxels_inside, run.steps, run.converged, start_.phi.get(), *start_.source,
                  run.parameters, setup->executor().speed().get(), setup->executor().constraints().get()});
  run.inside = solver::inside_region(*phi);
  if (options_.truth != nullptr) run.dice = dice(run.inside, *options_.truth);
  return {};
}

}  // namespace

Result<SweepStart> sweep_start(const Recipe& recipe, std::shared_ptr<const Volume> volume,
                               const Progress& progress) {
  auto setup = ExecutorSetup::create(std::move(volume), recipe.smoothed_mm, recipe.parameters,
                                     solver::ExecutorKind::host, {});
  if (!setup) return pass_on(setup);
  if (recipe.drive != nullptr) {
    TIDEMARK_TRY(setup->set_drive(recipe.drive, Progress{nullptr, progress.stop}));
  }
  TIDEMARK_TRY(setup->begin(recipe.start, {nullptr, progress.stop}));
  TIDEMARK_TRY(setup->play(recipe.up_to(0), 0, 0, 0, {nullptr, progress.stop}));
  auto phi = setup->executor().snapshot();
  if (!phi) return pass_on(phi);
  return SweepStart{setup->source(),      std::make_shared<const solver::Field>(std::move(*phi)),
                    recipe.start.limit(), setup->executor().parameters(),
                    setup->drive(),       setup->executor().speed()};
}

Result<Sweep> run_sweep(const SweepStart& start, const SweepOptions& options, const Progress& progress) {
  return Runs(start, options, progress).compute();
}

}  // namespace tidemark::document
