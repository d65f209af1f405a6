// Our host executor.
#include <chrono>

#include "bench/peers/contestants.h"
#include "solver/distance_transform.h"
#include "solver/model.h"

namespace tidemark::bench {
namespace {

Result<std::unique_ptr<solver::Executor>> start_executor(const Problem& problem, bool skip_quiet_pages) {
  solver::ExecutorOptions options;
  options.threads = kThreads;
  options.skip_quiet_pages = skip_quiet_pages;
  auto executor =
      solver::make_executor(solver::ExecutorKind::host, problem.source, problem.parameters, options);
  if (!executor) return executor;
  const Status started =
      problem.seed ? (*executor)->paint(*problem.seed, solver::Brush::add)
                   : (*executor)->restore(solver::distance_transform(*problem.start, (*executor)->band()));
  if (!started) return pass_on(started);
  return executor;
}

class TidemarkHost final : public Contestant {
 public:
  explicit TidemarkHost(std::unique_ptr<solver::Executor> executor) : executor_(std::move(executor)) {}

  Result<Cost> advance(std::int64_t steps) override {
    auto report = executor_->advance({.steps = steps});
    if (!report) return pass_on(report);
    return Cost{report->steps, report->seconds, report->voxel_updates, report->paging_seconds};
  }
  Mask finish() override { return executor_->snapshot().value().mask(); }
  [[nodiscard]] const solver::Executor* executor() const override { return executor_.get(); }

 private:
  std::unique_ptr<solver::Executor> executor_;
};

Result<Convergence> converge(const Problem& problem, bool skip_quiet_pages) {
  const auto start = std::chrono::steady_clock::now();
  auto executor = start_executor(problem, skip_quiet_pages);
  if (!executor) return pass_on(executor);
  auto report = (*executor)->advance({.steps = kMostSteps, .until_converged = true});
  if (!report) return pass_on(report);
  Convergence run;
  run.steps = report->steps;
  run.converged = report->converged;
  auto phi = (*executor)->snapshot();
  if (!phi) return pass_on(phi);
  run.result = phi->mask();
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return run;
}

}  // namespace

ContestantKind tidemark_host(bool skip_quiet_pages) {
  ContestantKind kind;
  kind.name = skip_quiet_pages ? "host" : "host-all-pages";
  kind.description =
      skip_quiet_pages ? "Tidemark host, 2 threads" : "Tidemark host, no page is quiet, 2 threads";
  kind.make = [=](const Problem& problem) -> Result<std::unique_ptr<Contestant>> {
    auto executor = start_executor(problem, skip_quiet_pages);
    if (!executor) return pass_on(executor);
    return std::make_unique<TidemarkHost>(std::move(*executor));
  };
  kind.converge = [=](const Problem& problem) { return converge(problem, skip_quiet_pages); };
  return kind;
}

}  // namespace tidemark::bench
