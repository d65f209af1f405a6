#include "solver/executor_base.h"

#include "core/stopwatch.h"

namespace tidemark::solver {

ExecutorBase::ExecutorBase(std::shared_ptr<const Volume> source, const Parameters& parameters)
    : source_(std::move(source)), model_(*source_, parameters) {}

Result<Model> ExecutorBase::model_with(const Parameters& parameters) const {
  TIDEMARK_TRY(check(parameters));
  Model model(*source_, parameters);
  if (model.band() != model_.band()) return fail(ErrorKind::usage, "the band W cannot change in mid-run");
  return model;
}

Result<AdvanceReport> ExecutorBase::run_steps(const Advance& run,
                                              const std::function<Result<bool>(AdvanceReport&)>& step) {
  constexpr double kSecondsBetweenReports = 0.05;
  const Stopwatch whole;
  Stopwatch since_report;
  AdvanceReport report;
  steps_of_last_run_ = 0;
  while (report.steps < run.steps && !run.progress.cancelled()) {
    steps_of_last_run_ = ++report.steps;
    auto window_ended = step(report);
    if (!window_ended) return pass_on(window_ended);
    if (since_report.seconds() > kSecondsBetweenReports) {
      run.progress(static_cast<double>(report.steps) / static_cast<double>(run.steps), "steps");
      since_report.restart();
    }
    if (*window_ended) {
      report.converged = surface_speed_ < kConvergedSpeed;
      if (report.converged && run.until_converged) break;
    }
  }
  report.surface_speed = surface_speed_;
  report.seconds = whole.seconds();
  return report;
}

}  // namespace tidemark::solver
