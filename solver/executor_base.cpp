#include "solver/executor_base.h"

#include "core/stopwatch.h"
#include "solver/speed/tent_speed.h"
#include "solver/stream/pass_record.h"

namespace tidemark::solver {

Result<PassRecord> Executor::record_step(std::int64_t /*page*/) {
  return fail(ErrorKind::capability, "the executor {} runs no passes that could be recorded", name());
}

ExecutorBase::ExecutorBase(std::shared_ptr<const Volume> source, const Parameters& parameters)
    : source_(std::move(source)),
      speed_(std::make_shared<TentSpeed>(source_, parameters)),
      model_(source_->geometry, parameters, *speed_) {}

Result<ExecutorBase::Drive> ExecutorBase::drive_with(const Parameters& parameters,
                                                     std::shared_ptr<const SpeedFunction> given) const {
  TIDEMARK_TRY(check(parameters));
  std::shared_ptr<const SpeedFunction> used = given;
  if (used == nullptr) used = std::make_shared<TentSpeed>(source_, parameters);
  const Model model(source_->geometry, parameters, *used);
  if (model.band() != model_.band()) return fail(ErrorKind::usage, "the band W cannot change in mid-run");
  return Drive{std::move(given), std::move(used), model};
}

void ExecutorBase::take(Drive drive) {
  given_speed_ = std::move(drive.given);
  speed_ = std::move(drive.used);
  model_ = drive.model;
}

Status ExecutorBase::follow_surface() {
  if (steps_in_window_ != 0 || !speed_->follows_surface()) return {};
  const auto phi = snapshot();
  if (!phi) return pass_on(phi);
  auto speed = speed_->following(*phi);
  if (speed == nullptr) return {};  // the present one fits
  is_following_ = true;
  Status taken = set_speed(std::move(speed));
  is_following_ = false;
  return taken;
}

Status ExecutorBase::check_fits(const Constraints& constraints) const {
  if (constraints.layout().domain_size() == source_->geometry.size) return {};
  return fail(ErrorKind::usage, "walls and anchors are on another grid than the volume");
}

RestRule ExecutorBase::rest_rule(std::int64_t voxels_per_page) const {
  const auto constants = model_.constants<double>();
  return RestRule::of(model_.time_step(), constants.data_weight, constants.near, voxels_per_page);
}

void ExecutorBase::restart_watch(std::int64_t voxels_per_page) {
  steps_in_window_ = 0;
  if (!is_following_) watch_.restart(rest_rule(voxels_per_page));
}

Result<AdvanceReport> ExecutorBase::run_steps(const Advance& run,
                                              const std::function<Result<bool>(AdvanceReport&)>& step) {
  constexpr double kSecondsBetweenReports = 0.05;
  const Stopwatch whole;
  Stopwatch since_report;
  AdvanceReport report;
  steps_of_last_run_ = 0;
  while (report.steps < run.steps && !run.progress.cancelled()) {
    TIDEMARK_TRY(follow_surface());
    steps_of_last_run_ = ++report.steps;
    auto window_ended = step(report);
    if (!window_ended) return pass_on(window_ended);
    if (since_report.seconds() > kSecondsBetweenReports) {
      run.progress(static_cast<double>(report.steps) / static_cast<double>(run.steps), "steps");
      since_report.restart();
    }
    if (*window_ended && watch_.rests() && run.until_converged) break;
  }
  report.converged = watch_.rests();
  report.surface_speed = watch_.speed();
  report.moving_pages = watch_.moving_pages();
  report.seconds = whole.seconds();
  return report;
}

}  // namespace tidemark::solver
