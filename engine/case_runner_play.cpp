// A case that plays: its steps, alone and in lock-step with others.
#include <algorithm>
#include <chrono>
#include <utility>

#include "engine/case_runner.h"
#include "engine/lock_step.h"

namespace tidemark::engine {
namespace {

// Between two looks whether the others of a group can go on.
constexpr std::chrono::milliseconds kWaitForOthers(10);

}  // namespace

void CaseRunner::set_playing(bool playing) {
  if (const auto group = group_.lock()) return group->set_playing(playing);
  play_alone(playing);
}

void CaseRunner::join(std::weak_ptr<LockStep> group) {
  if (const auto former = group_.lock()) former->remove(*this);
  group_ = std::move(group);
}

void CaseRunner::play_alone(bool playing) {
  const bool begins = playing && !playing_;
  stroke_steps_ = 0;
  if (begins) {
    case_speed_.try_again();
    leak_watch_.forget_alarm();
    schedule_.restart();
  }
  playing_ = playing && case_->level_set().begun();
  if (begins && playing_) post_steps();
  if (!playing_) end_run();
}

Status CaseRunner::step(std::int64_t steps, const Progress& progress) {
  if (!case_->level_set().begun()) return {};
  if (holds_steps()) {
    case_speed_.try_again();  // what cannot be had says so once more
    return {};
  }
  if (const auto group = group_.lock()) return group->step(steps, progress);
  // Steps by hand are one entry while nothing else is done.
  if (playing_ || !case_->level_set().in_run()) play_alone(false);
  return advance(steps, progress);
}

void CaseRunner::play(Run run) {
  play_alone(false);
  run_ = std::move(run);
  if (run_->steps > 0) play_alone(true);
  if (!playing_) end_run();
}

void CaseRunner::report_end_of_run() {
  if (!ended_run_) return;
  if (ended_run_->ended) {
    receiver_.weak_receiver->send(
        [ended = std::move(ended_run_->ended), reached = ended_run_->steps == 0] { ended(reached); });
  }
  ended_run_.reset();
}

void CaseRunner::end_run() {
  if (run_) {
    ended_run_ = std::exchange(run_, std::nullopt);
    if (ended_run_->until_rest && meter_.converged()) ended_run_->steps = 0;
  }
  if (auto status = case_->level_set().end_run(); !status) report_failure(status.error());
}

void CaseRunner::post_steps(Engine::Clock::time_point due) {
  engine_.post(
      Priority::step, this,
      [self = shared_from_this(), turn = ++turn_](std::stop_token stop) {
        self->run_steps(turn, std::move(stop));
      },
      [self = shared_from_this()](const Error& error) { self->recover(error); }, due);
}

void CaseRunner::set_pace(double steps_per_second) {
  if (const auto group = group_.lock()) return group->set_pace(steps_per_second);
  set_pace_alone(steps_per_second);
}

void CaseRunner::set_pace_alone(double steps_per_second) {
  schedule_.set(steps_per_second);
  if (playing_) post_steps();
}

void CaseRunner::run_steps(std::uint64_t turn, std::stop_token stop) {
  if (turn != turn_ || !playing_ || !case_ || holds_steps()) return;
  Status status = follow_graphics();
  const auto group = group_.lock();
  const std::int64_t before = case_->level_set().step();
  const Progress progress{nullptr, std::move(stop)};
  schedule_.begin_steps();
  const std::int64_t most = run_ ? std::min(run_->steps, steps_to_next_picture()) : steps_to_next_picture();
  if (status) status = group ? group->advance(*this, progress) : advance(most, progress);
  const std::int64_t done = case_->level_set().step() - before;
  schedule_.end_steps();
  if (run_) run_->steps -= done;
  if (run_ && run_->steps <= 0) playing_ = false;
  if (!status && status.error().kind != ErrorKind::cancelled &&
      !(engine_.device() && engine_.device()->lost())) {
    set_playing(false);
    report_failure(status.error());
  }
  if (playing_ && group && done == 0 && group->any_holds_steps()) {
    post_steps(Engine::Clock::now() + kWaitForOthers);
  } else if (playing_) {
    post_steps(schedule_.next_due(done));
  } else {
    end_run();
  }
  show();
}

Status CaseRunner::advance(std::int64_t steps, const Progress& progress) {
  document::LevelSet& level_set = case_->level_set();
  const bool alone = group_.expired();
  const bool pauses = run_ ? run_->until_rest : pause_at_convergence_ && alone;
  solver::Advance run{steps, pauses, progress};
  run.progress.report = nullptr;
  leak_watch_.forget_alarm();
  auto report = alone && !run_ ? leak_watch_.advance(level_set, run) : level_set.advance(run);
  painter_.executor_used();
  if (!report) return pass_on(report);
  ++advances_;
  const bool leaks = leak_watch_.alarm() != nullptr;
  const bool comes_to_rest = report->converged && !meter_.converged();
  meter_.computed(*report, level_set.step());
  schedule_.moved(report->surface_speed * level_set.executor().time_step());
  painter_.phi_changed();
  if (leaks || (report->converged && pauses)) playing_ = false;
  // What has become of it is known with the state that says that it rests.
  return comes_to_rest || leaks || meter_.due() ? measure(false) : Status{};
}

}  // namespace tidemark::engine
