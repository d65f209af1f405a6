#include "engine/case_runner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/without_exceptions.h"
#include "engine/change_text.h"
#include "engine/lock_step.h"

namespace tidemark::engine {
namespace {

constexpr double kChunkSeconds = 0.016;  // of steps between two pictures
constexpr std::int64_t kMostSteps = 50;  // between two pictures: it should be seen how the surface moves

}  // namespace

CaseRunner::CaseRunner(Engine& engine, std::shared_ptr<const LoadedStudy> study,
                       solver::ExecutorKind executor, Receiver receiver, RestoredCase restored)
    : engine_(engine),
      study_(std::move(study)),
      executor_kind_(executor),
      receiver_(std::move(receiver)),
      restored_(std::move(restored)),
      painter_(engine),
      history_(study_->summary.window) {
  meter_.compare_with(study_->truth);
}

void CaseRunner::post(Command command) {
  engine_.interrupt(Priority::step, this);  // refinement can wait
  auto job = [self = shared_from_this(), command = std::move(command)](const std::stop_token& stop) {
    const Progress progress{self->report(), stop};
    if (auto status = self->follow_graphics(); !status) self->report_failure(status.error());
    if (auto status = command(*self, progress); !status) self->report_failure(status.error());
    if (self->case_) self->show();
  };
  engine_.post(Priority::edit, this, std::move(job),
               [self = shared_from_this()](const Error& error) { self->recover(error); });
}

SpeedMaker::Report CaseRunner::report() const {
  return [weak_receiver = receiver_.weak_receiver, progressed = receiver_.progressed](double fraction,
                                                                                      std::string_view what) {
    weak_receiver->send(
        [progressed, fraction, text = QString::fromUtf8(what.data(), static_cast<qsizetype>(what.size()))] {
          progressed(fraction, text);
        });
  };
}

void CaseRunner::show() {
  painter_.executor_used();
  follow_drive();
  if (auto status = follow_surface(); !status) report_failure(status.error());
  show_pictures();
  post_measurement();
  post_history();
  publish();
}

Status CaseRunner::open() {
  painter_.use(engine_.device());
  graphics_ = engine_.contexts_made();
  auto made = restored_.contents ? document::restore_case(*restored_.contents, study_->volume, executor_kind_,
                                                          executor_options())
                                 : document::Case::create(study_->volume, study_->origin, study_->parameters,
                                                          executor_kind_, executor_options());
  if (!made) return pass_on(made);
  case_ = std::move(*made);
  return {};
}

void CaseRunner::mark_saved(std::uint64_t position) {
  case_->mark_saved(position);
  restored_.rescued = false;
}

void CaseRunner::close() {
  case_speed_.give_up();
  playing_ = false;
  painter_.forget();
  painter_.use(nullptr);
  case_.reset();
}

solver::ExecutorOptions CaseRunner::executor_options() const {
  solver::ExecutorOptions options;
  options.device = engine_.device();
  return options;
}

// After a lost context: the executor goes on from its last checkpoint on the new one.
Status CaseRunner::follow_graphics() {
  const auto& device = engine_.device();
  if (device && device->lost()) {
    if (auto status = engine_.renew_graphics(); !status) {
      painter_.forget();
      painter_.use(nullptr);
      return status;
    }
  }
  if (!case_ || graphics_ == engine_.contexts_made()) return {};
  graphics_ = engine_.contexts_made();
  painter_.forget();
  painter_.use(engine_.device());
  auto status = case_->level_set().rebuild(executor_options());
  phi_changed();
  return status;
}

// What was computed or edited has been cut off in the middle, for lack of memory most likely: what the
// executor holds now is not to be trusted.
void CaseRunner::recover(const Error& error) {
  playing_ = false;
  report_failure(error);
  if (!case_) return;
  const Status back = without_exceptions([this] { return case_->level_set().rebuild(executor_options()); });
  if (!back) {
    obstacle_ = Error{back.error().kind,
                      fmt::format("this case cannot go on and should be closed: {}", back.error().message)};
    report_failure(*obstacle_);
    return close();
  }
  phi_changed();
  show();
}

void CaseRunner::report_failure(const Error& error) {
  if (error.kind == ErrorKind::cancelled) return;
  receiver_.weak_receiver->send(
      [failed = receiver_.failed, text = QString::fromStdString(error.message)] { failed(text); });
}

void CaseRunner::phi_changed() {
  painter_.phi_changed();
  meter_.edited();
  leak_watch_.restart();
  leak_ = nullptr;
}

Status CaseRunner::report_edit(Status outcome) {
  if (outcome) phi_changed();
  return outcome;
}

Status CaseRunner::report_change(Status outcome) {
  painter_.look_changed();
  meter_.adjusted();
  return outcome;
}

Status CaseRunner::report_labels(Status outcome) {
  painter_.look_changed();
  meter_.labels_changed();
  return outcome;
}

Status CaseRunner::accept_surface(std::uint8_t label, document::Take take) {
  auto accepted = case_->accept_surface(label, take);
  if (!accepted) return report_labels(pass_on(accepted));
  acceptance_ = std::move(*accepted);
  acceptance_position_ = case_->history().position();
  return report_labels({});
}

// It rests where the run did: what has become of it is known at once.
Status CaseRunner::take_run(const document::SweepStart& start, const document::SweepRun& run,
                            const Progress& progress) {
  set_playing(false);
  Status taken = report_edit(case_->level_set().take_run(start, run, progress));
  if (taken) meter_.set_converged(run.converged);
  return taken;
}

// What drives the surface.

void CaseRunner::follow_drive() {
  case_speed_.follow(
      *case_, report(), [weak = weak_from_this()](const SpeedOrigin& origin, SpeedMaker::Made made) {
        auto self = weak.lock();
        if (!self) return;
        Engine& engine = self->engine_;
        const void* owner = self.get();
        // The job has the last hold of it: the runner must not die on the maker's thread.
        engine.post(Priority::edit, owner,
                    [self = std::move(self), origin, made = std::move(made)](const std::stop_token&) {
                      self->take_speed(origin, made);
                    });
      });
}

void CaseRunner::take_speed(const SpeedOrigin& origin, const SpeedMaker::Made& made) {
  if (!case_) return;
  const auto taken = case_speed_.take(*case_, origin, made);
  if (!taken) {
    report_failure(taken.error());
    set_playing(false);
  } else if (*taken) {
    report_change({});
    if (playing_) post_steps();
  }
  show();
}

// An executor asks for the function of its phi only when it steps; at rest D is to be seen as well.
Status CaseRunner::follow_surface() {
  const auto& driving = case_->level_set().executor().speed();
  if (playing_ || driving == nullptr || !driving->follows_surface()) {
    shown_speed_ = {driving, nullptr, driving};
  } else {
    const auto phi = painter_.phi(*case_);
    if (!phi) return tl::unexpected<Error>(phi.error());
    if (shown_speed_.driving == driving && shown_speed_.phi == *phi) return {};
    auto following = driving->following(**phi);
    shown_speed_ = {driving, *phi, following != nullptr ? std::move(following) : driving};
    painter_.look_changed();
  }
  painter_.set_speed(shown_speed_.function);
  return {};
}

Status CaseRunner::smooth_source(double sigma_mm) {
  case_speed_.smooth(sigma_mm);
  return {};
}

// What is still on its way was done last.
Status CaseRunner::undo() {
  set_playing(false);
  if (case_speed_.smoothing()) {
    case_speed_.give_up_smoothing();
    return {};
  }
  return report_edit(case_->undo());
}

Status CaseRunner::go_to(std::uint64_t state) {
  set_playing(false);
  case_speed_.give_up_smoothing();
  return report_edit(case_->history().go_to(state));
}

// Playing.

void CaseRunner::set_playing(bool playing) {
  if (const auto group = group_.lock()) return group->set_playing(playing);
  play_alone(playing);
}

void CaseRunner::play_alone(bool playing) {
  const bool begins = playing && !playing_;
  if (begins) case_speed_.try_again();
  if (begins) leak_ = nullptr;
  playing_ = playing && case_->level_set().begun();
  if (begins && playing_) post_steps();
  if (!playing_) end_run();
}

Status CaseRunner::step(std::int64_t steps, const Progress& progress) {
  if (!case_->level_set().begun() || case_speed_.holds_steps(*case_)) return {};
  if (const auto group = group_.lock()) return group->step(steps, progress);
  // Steps by hand are one entry while nothing else is done.
  if (playing_ || !case_->level_set().in_run()) play_alone(false);
  return advance(steps, progress);
}

void CaseRunner::end_run() {
  if (auto status = case_->level_set().end_run(); !status) report_failure(status.error());
}

std::int64_t CaseRunner::steps_to_next_picture() const {
  if (steps_per_picture_ > 0) return steps_per_picture_;
  if (pace_ > 0.0) return std::max(std::llround(kChunkSeconds * pace_), 1LL);
  const double seconds = meter_.seconds_per_step();
  if (seconds <= 0.0) return 1;
  return std::clamp(std::llround(kChunkSeconds / seconds), 1LL, static_cast<long long>(kMostSteps));
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
  pace_ = steps_per_second;
  paced_ = Engine::Clock::now();
  if (playing_) post_steps();
}

// When the steps after so many may begin: what was late is not made up for. One that waits for others in
// lock-step looks again soon.
Engine::Clock::time_point CaseRunner::next_due(std::int64_t steps) {
  if (pace_ <= 0.0) return {};
  const auto now = Engine::Clock::now();
  if (steps == 0) return now + std::chrono::milliseconds(1);
  const std::chrono::duration<double> time(static_cast<double>(steps) / pace_);
  paced_ = std::max(paced_ + std::chrono::duration_cast<Engine::Clock::duration>(time), now);
  return paced_;
}

void CaseRunner::run_steps(std::uint64_t turn, std::stop_token stop) {
  if (turn != turn_ || !playing_ || !case_ || case_speed_.holds_steps(*case_)) return;
  Status status = follow_graphics();
  const auto group = group_.lock();
  const std::int64_t before = case_->level_set().step();
  const Progress progress{nullptr, std::move(stop)};
  if (status) status = group ? group->advance(*this, progress) : advance(steps_to_next_picture(), progress);
  if (!status && status.error().kind != ErrorKind::cancelled &&
      !(engine_.device() && engine_.device()->lost())) {
    set_playing(false);
    report_failure(status.error());
  }
  if (playing_) {
    post_steps(next_due(case_->level_set().step() - before));
  } else {
    end_run();
  }
  show();
}

Status CaseRunner::advance(std::int64_t steps, const Progress& progress) {
  document::LevelSet& level_set = case_->level_set();
  const bool alone = group_.expired();
  const bool pauses = pause_at_convergence_ && alone;
  solver::Advance run{steps, pauses, progress};
  run.progress.report = nullptr;
  leak_ = nullptr;
  const auto report = alone ? advance_watching(run) : level_set.advance(run);
  painter_.executor_used();
  if (!report) return tl::unexpected<Error>(report.error());
  ++advances_;
  const bool comes_to_rest = report->converged && !meter_.converged();
  meter_.computed(*report, level_set.step());
  painter_.phi_changed();
  if (leak_ || (report->converged && pauses)) playing_ = false;
  // What has become of it is known with the state that says that it rests.
  return comes_to_rest || leak_ || meter_.due() ? measure(false) : Status{};
}

// In parts with looks between them, until there is a leak.
Result<solver::AdvanceReport> CaseRunner::advance_watching(const solver::Advance& run) {
  document::LevelSet& level_set = case_->level_set();
  solver::AdvanceReport all;
  while (all.steps < run.steps && !leak_) {
    auto steps = leak_watch_.begin(level_set, run.steps - all.steps);
    if (!steps) return pass_on(steps);
    const auto part = level_set.advance({*steps, run.until_converged, run.progress});
    if (!part) return part;
    all.steps += part->steps;
    all.seconds += part->seconds;
    all.paging_seconds += part->paging_seconds;
    all.voxel_updates += part->voxel_updates;
    all.surface_speed = part->surface_speed;
    // No window of its measure may have ended in this part.
    all.converged = (all.converged || part->converged) && part->surface_speed < solver::kConvergedSpeed;
    if (part->steps < *steps || (part->converged && run.until_converged)) break;
    auto alarm = leak_watch_.look(level_set);
    if (!alarm) return pass_on(alarm);
    if (*alarm) leak_ = std::make_shared<const LeakAlarm>(std::move(**alarm));
  }
  return all;
}

Status CaseRunner::measure(bool thoroughly) {
  return meter_.measure([this] { return painter_.phi(*case_); }, *case_, thoroughly);
}

Status CaseRunner::change_executor(solver::ExecutorKind kind) {
  executor_kind_ = kind;
  painter_.forget();
  auto status = case_->level_set().change_executor(kind, executor_options());
  phi_changed();
  return status;
}

// Pictures.

void CaseRunner::view_changed(const std::shared_ptr<ViewSlot>& slot) {
  engine_.interrupt(Priority::step, this);
  post_picture(slot, Priority::picture);
}

void CaseRunner::show_pictures() {
  for (const auto& slot : painter_.views()) {
    if (painter_.out_of_date(*slot)) post_picture(slot, Priority::picture);
  }
}

void CaseRunner::post_picture(const std::shared_ptr<ViewSlot>& slot, Priority priority) {
  // A view waits once; a better picture of what has changed meanwhile is not wanted.
  auto& waiting = priority == Priority::refine ? slot->refining : slot->waiting;
  if (waiting.exchange(true)) return;
  engine_.post(
      priority, this,
      [self = shared_from_this(), slot, &waiting, priority](std::stop_token stop) {
        waiting = false;
        self->draw_in_turn(slot, priority, std::move(stop));
      },
      [self = shared_from_this()](const Error& error) { self->report_failure(error); });
}

// A user who turns the camera or paints asks for the next picture before this one is there. The surface must
// move on all the same: while it plays, a view is drawn once between steps and then waits behind the next
// ones.
void CaseRunner::draw_in_turn(const std::shared_ptr<ViewSlot>& slot, Priority priority,
                              std::stop_token stop) {
  if (priority == Priority::picture && playing_ && slot->drawn_advance == advances_) {
    post_picture(slot, Priority::step);
  } else {
    draw(slot, std::move(stop));
  }
}

void CaseRunner::draw(const std::shared_ptr<ViewSlot>& slot, std::stop_token stop) {
  if (!case_) return;
  if (auto status = follow_graphics(); !status) return report_failure(status.error());
  slot->drawn_advance = advances_;
  const auto more = painter_.draw(*slot, *case_, std::move(stop));
  if (more) {
    if (*more) post_picture(slot, Priority::refine);
  } else if (more.error().kind == ErrorKind::cancelled) {
    post_picture(slot, Priority::refine);
  } else if (engine_.device() && engine_.device()->lost()) {
    post_picture(slot, Priority::picture);  // on the next context
  } else {
    report_failure(more.error());
  }
}

// Figures.

void CaseRunner::post_measurement() {
  if (playing_ || meter_.thorough() || std::exchange(measurement_waits_, true)) return;
  engine_.post(
      Priority::background, this,
      [self = shared_from_this()](const std::stop_token&) {
        self->measurement_waits_ = false;
        if (!self->case_ || self->playing_) return;
        if (auto status = self->measure(true); !status) return self->report_failure(status.error());
        self->publish();
      },
      [self = shared_from_this()](const Error& error) { self->report_failure(error); });
}

// One state at a time: whatever else is asked for comes between.
void CaseRunner::post_history() {
  if (playing_ || std::exchange(history_waits_, true)) return;
  engine_.post(
      Priority::background, this,
      [self = shared_from_this()](const std::stop_token&) {
        self->history_waits_ = false;
        if (!self->case_ || self->playing_ || !self->history_.measure_next(*self->case_)) return;
        self->publish();
        self->post_history();
      },
      [self = shared_from_this()](const Error& error) { self->report_failure(error); });
}

std::shared_ptr<const std::vector<std::uint8_t>> CaseRunner::label_voxels() {
  const document::Labels& labels = case_->labels();
  if (labels.voxels().empty()) return nullptr;
  if (!label_voxels_ || label_revision_ != labels.revision()) {
    label_voxels_ =
        std::make_shared<const std::vector<std::uint8_t>>(labels.voxels().begin(), labels.voxels().end());
    label_revision_ = labels.revision();
  }
  return label_voxels_;
}

void CaseRunner::publish() {
  if (!case_) return;
  document::LevelSet& level_set = case_->level_set();
  CaseState state;
  state.parameters = level_set.parameters();
  state.step = level_set.step();
  state.begun = level_set.begun();
  const document::Recipe& recipe = level_set.recipe();
  state.steered = recipe.events.size();
  state.steered_at = recipe.events.empty() ? 0 : recipe.events.back().step;
  state.playing = playing_;
  state.leak = leak_;
  state.pace = pace_;
  state.time_step = level_set.executor().time_step();
  state.band = level_set.executor().band();
  state.smoothed_mm = case_->smoothed_mm();
  state.drive = level_set.drive();
  state.speed = shown_speed_.function;
  state.speed_waits = case_speed_.waits();
  state.constraints = level_set.executor().constraints();
  state.smoothing = case_speed_.smoothing();
  state.source = level_set.source();
  state.executor = QString::fromUtf8(level_set.executor().name().data(),
                                     static_cast<qsizetype>(level_set.executor().name().size()));
  state.memory = level_set.executor().memory();
  state.curve = level_set.curve();
  state.labels = case_->labels().list();
  state.label_voxels = label_voxels();
  if (case_->history().position() == acceptance_position_) state.acceptance = acceptance_;
  if (const auto change = case_->history().undo_description()) state.undo_text = change_text(*change);
  if (case_speed_.smoothing()) state.undo_text = change_text({document::ChangeKind::source, 0, {}});
  if (const auto change = case_->history().redo_description()) state.redo_text = change_text(*change);
  state.history = history_.rows(*case_);
  state.history_state = case_->history().last_state();
  state.open_change = case_->history().open_state();
  state.modified = case_->changed_since_save() || restored_.rescued;
  state.edits = case_->history().edits();
  state.start_text = QString::fromStdString(recipe.start.describe());
  state.limit = recipe.start.limit();
  meter_.report(state);
  {
    const std::lock_guard lock(post_->mutex);
    post_->state = std::move(state);
    if (std::exchange(post_->announced, true)) return;
  }
  receiver_.weak_receiver->send([arrived = receiver_.state_arrived, post = post_] {
    CaseState newest;
    {
      const std::lock_guard lock(post->mutex);
      post->announced = false;
      newest = std::move(post->state);
    }
    arrived(std::move(newest));
  });
}

}  // namespace tidemark::engine
