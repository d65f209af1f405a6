#include "engine/case_runner.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/without_exceptions.h"
#include "engine/change_text.h"
#include "engine/lock_step.h"
#include "engine/message_text.h"
#include "engine/start_text.h"

namespace tidemark::engine {
CaseRunner::CaseRunner(Engine& engine, std::shared_ptr<const LoadedStudy> study,
                       solver::ExecutorKind executor, Receiver receiver, RestoredCase restored)
    : engine_(engine),
      study_(std::move(study)),
      executor_kind_(executor),
      receiver_(std::move(receiver)),
      restored_(std::move(restored)),
      painter_(engine),
      history_(study_->summary.window),
      post_(receiver_.weak_receiver, receiver_.state_arrived) {
  meter_.compare_with(restored_.truth(*study_));
}

std::uint64_t CaseRunner::post(Command command) {
  engine_.interrupt(Priority::step, this);  // refinement can wait
  const std::uint64_t number = ++posted_;
  auto job = [self = shared_from_this(), number, command = std::move(command)](const std::stop_token& stop) {
    const Progress progress{self->report(), stop};
    if (auto status = self->follow_graphics(); !status) self->report_failure(status.error());
    if (auto status = command(*self, progress); !status) self->report_failure(status.error());
    self->carried_out_ = number;
    if (self->case_) self->show();
  };
  engine_.post(Priority::edit, this, std::move(job), [self = shared_from_this(), number](const Error& error) {
    self->carried_out_ = number;
    self->recover(error);
  });
  return number;
}

SpeedMaker::Report CaseRunner::report() const {
  return [weak_receiver = receiver_.weak_receiver, progressed = receiver_.progressed](double fraction,
                                                                                      std::string_view what) {
    weak_receiver->send(
        [progressed, fraction, text = message_text(std::string(what))] { progressed(fraction, text); });
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
  report_end_of_run();
}

Status CaseRunner::open() {
  painter_.use(engine_.device());
  graphics_ = engine_.contexts_made();
  auto made = restored_.contents ? document::restore_case(*restored_.contents, study_->volume, executor_kind_,
                                                          executor_options())
                                 : document::Case::create(study_->volume, study_->origin, study_->parameters,
                                                          executor_kind_, executor_options());
  if (made) {
    case_ = std::move(*made);
  } else {
    give_up(made.error());
  }
  return {};
}

void CaseRunner::mark_saved(std::uint64_t position) {
  case_->mark_saved(position);
  restored_.in_no_file = false;
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
  if (run_) ended_run_ = std::exchange(run_, std::nullopt);
  report_failure(error);
  if (obstacle_) return;
  const Status back = without_exceptions([&]() -> Status {
    if (!case_) return tl::unexpected<Error>(error);  // it was being opened
    return case_->level_set().rebuild(executor_options());
  });
  if (!back) return give_up(back.error());
  phi_changed();
  show();
}

void CaseRunner::give_up(const Error& error) {
  obstacle_ =
      Error{error.kind, fmt::format("this case cannot go on and should be closed: {}", error.message)};
  report_failure(*obstacle_);
  receiver_.weak_receiver->send(receiver_.given_up);
  close();
}

void CaseRunner::report_failure(const Error& error) {
  if (error.kind == ErrorKind::cancelled) return;
  receiver_.weak_receiver->send([failed = receiver_.failed, text = message_text(error)] { failed(text); });
}

void CaseRunner::phi_changed() {
  schedule_.restart();
  painter_.phi_changed();
  meter_.edited();
  leak_watch_.restart();
}

Status CaseRunner::report_edit(Status outcome) {
  stroke_steps_ = 0;
  if (outcome) phi_changed();
  return outcome;
}

Status CaseRunner::report_change(Status outcome) {
  schedule_.restart();
  painter_.look_changed();
  meter_.adjusted();
  return outcome;
}

void CaseRunner::compare_with(std::shared_ptr<const BitMask> truth) {
  meter_.compare_with(std::move(truth));
  case_->level_set().forget_dice();
}

Status CaseRunner::report_labels(Status outcome) {
  painter_.look_changed();
  return outcome;
}

Status CaseRunner::report_acceptance(Result<document::Acceptance> accepted) {
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
    if (playing_) {
      post_steps();
    } else if (stroke_steps_ > 0) {
      play({stroke_steps_, true, {}});
    }
  }
  show();
}

Status CaseRunner::follow_surface() {
  auto changed = shown_speed_.follow(case_->level_set().executor().speed(), !playing_,
                                     [this] { return painter_.phi(*case_); });
  if (!changed) return pass_on(changed);
  if (*changed) painter_.look_changed();
  painter_.set_speed(shown_speed_.function());
  return {};
}

Status CaseRunner::smooth_source(double sigma_mm) {
  TIDEMARK_TRY(case_->history().close());
  case_speed_.smooth(sigma_mm);
  smoothing_position_ = case_->history().position();
  return {};
}

// Whether nothing was done since.
bool CaseRunner::smoothing_is_last() const {
  return case_speed_.smoothing() && case_->history().position() == smoothing_position_;
}

Status CaseRunner::undo() {
  set_playing(false);
  if (smoothing_is_last()) {
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
  const auto more = painter_.draw(*slot, *case_, playing_, std::move(stop));
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

// It comes before better pictures, and in turn with the steps of other cases.
void CaseRunner::post_measurement() {
  if (playing_ || meter_.thorough() || std::exchange(measurement_waits_, true)) return;
  engine_.post(
      Priority::step, this,
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

std::shared_ptr<const PagedBytes> CaseRunner::label_voxels() {
  const document::Labels& labels = case_->labels();
  if (labels.voxels().empty()) return nullptr;
  if (!label_voxels_ || label_revision_ != labels.revision()) {
    label_voxels_ = std::make_shared<const PagedBytes>(labels.voxels());
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
  state.leak = leak_watch_.alarm();
  state.pace = schedule_.steps_per_second();
  state.time_step = level_set.executor().time_step();
  state.band = level_set.executor().band();
  state.smoothed_mm = case_->smoothed_mm();
  state.drive = level_set.drive();
  state.speed = shown_speed_.function();
  state.speed_waits = case_speed_.waits();
  state.lacks_speed = level_set.lacks_speed();
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
  if (smoothing_is_last()) state.undo_text = change_text({document::ChangeKind::source, 0, {}});
  if (const auto change = case_->history().redo_description()) state.redo_text = change_text(*change);
  state.history = history_.rows(*case_);
  state.history_state = case_->history().last_state();
  state.open_change = case_->history().open_state();
  state.modified = case_->changed_since_save() || restored_.in_no_file;
  // An open change is an edit already: closing it adds as much.
  state.edits = case_->history().edits() + (state.open_change ? 1 : 0);
  state.commands = carried_out_;
  state.start_text = start_text(recipe.start);
  state.limit = recipe.start.limit();
  state.surface_map = painter_.surface_map();
  meter_.follow_labels(*case_);
  meter_.report(state);
  post_.send(std::move(state));
}

}  // namespace tidemark::engine
