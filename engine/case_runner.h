// A case on the engine's thread: commands, steps, pictures and figures.
#pragma once

#include <functional>
#include <memory>

#include "core/bit_mask.h"
#include "engine/case_history.h"
#include "engine/case_meter.h"
#include "engine/case_painter.h"
#include "engine/case_proxy.h"
#include "engine/case_speed.h"
#include "engine/leak_watch.h"
#include "engine/shown_speed.h"
#include "engine/state_post.h"
#include "engine/step_schedule.h"
#include "engine/weak_receiver.h"

namespace tidemark::engine {

class LockStep;

// Everything but post(), add_view() and view_changed() belongs to the engine's thread.
class CaseRunner : public std::enable_shared_from_this<CaseRunner> {
 public:
  // The proxy's callbacks, called on its thread through the weak_receiver.
  struct Receiver {
    std::shared_ptr<WeakReceiver> weak_receiver;
    std::function<void(CaseState)> state_arrived;
    std::function<void(QString)> failed;
    std::function<void(double, QString)> progressed;
    std::function<void()> given_up;  // the case cannot go on
  };
  // An operation on the case. The user sees the error that it returns.
  using Command = std::function<Status(CaseRunner&, const Progress&)>;

  CaseRunner(Engine& engine, std::shared_ptr<const LoadedStudy> study, solver::ExecutorKind executor,
             Receiver receiver, RestoredCase restored = {});

  // The proxy's thread. The command comes before all other jobs of the case; pictures, figures and state are
  // brought up to date after it. Returns its number, from 1: CaseState::commands has it once it is carried
  // out.
  std::uint64_t post(Command command);
  void add_view(const std::shared_ptr<ViewSlot>& slot) { painter_.add(slot); }
  void view_changed(const std::shared_ptr<ViewSlot>& slot);

  // The first command: makes the document.
  Status open();
  // The last one: destroys everything that lives on the engine's thread.
  void close();

  [[nodiscard]] bool opened() const { return case_ != nullptr; }
  // Why the case cannot go on; null: it can.
  [[nodiscard]] const Error* obstacle() const { return obstacle_ ? &*obstacle_ : nullptr; }
  [[nodiscard]] document::Case& document() { return *case_; }
  [[nodiscard]] CasePainter& painter() { return painter_; }
  // See CaseProxy.
  Status take_stroke(const document::Drive& drive, const std::vector<std::int64_t>& voxels,
                     std::int64_t steps, std::uint64_t gesture, const Progress& progress);
  // After a command that has changed phi, its other conditions, or labels: publishes the outcome.
  Status report_edit(Status outcome);
  Status report_change(Status outcome);
  Status report_labels(Status outcome);
  void compare_with(std::shared_ptr<const BitMask> truth);  // null: with nothing
  Status smooth_source(double sigma_mm);                    // in the background
  Status undo();
  Status go_to(std::uint64_t state);
  Status report_acceptance(Result<document::Acceptance> accepted);
  Status take_run(const document::SweepStart& start, const document::SweepRun& run, const Progress& progress);

  [[nodiscard]] bool playing() const { return playing_; }
  // Plays for so many steps, or until the surface rests where that comes before and is asked for. A leak does
  // not end it. `ended` is called on the proxy's thread once the state that it leads to is known there: with
  // whether it came to its end. It may be empty.
  struct Run {
    std::int64_t steps = 0;
    bool until_rest = false;
    std::function<void(bool reached)> ended;
  };
  void play(Run run);
  // Brings the figures of the surface up to date.
  Status measure_now() { return measure(true); }
  // For all cases in lock-step with this one: playing, and single steps with a pause after them.
  void set_playing(bool playing);
  Status step(std::int64_t steps, const Progress& progress);
  void play_alone(bool playing);
  void set_steps_per_picture(std::int64_t steps) { schedule_.set_steps_per_picture(steps); }
  void set_pause_at_convergence(bool pause) { pause_at_convergence_ = pause; }
  // Unset: a leak does not make it pause. In lock-step none does.
  void set_leak_rule(const std::optional<document::LeakRule>& rule) { leak_watch_.set_rule(rule); }
  // At most so many steps a second while it plays; 0: as many as can be computed. For all cases in lock-step.
  void set_pace(double steps_per_second);
  void set_pace_alone(double steps_per_second);
  [[nodiscard]] double pace() const { return schedule_.steps_per_second(); }
  [[nodiscard]] std::int64_t steps_to_next_picture() const {
    return schedule_.steps_to_next_picture(meter_.seconds_per_step());
  }
  // Computes steps and records their outcome. A level set that has converged stops playing; in lock-step all
  // go on until all have converged.
  Status advance(std::int64_t steps, const Progress& progress);
  [[nodiscard]] bool may_rest() const { return pause_at_convergence_ && meter_.converged(); }
  Status change_executor(solver::ExecutorKind kind);
  // Leaves the group that it is in; none: it plays alone.
  void join(std::weak_ptr<LockStep> group);

  // A file holds the case at that position of its history.
  void mark_saved(std::uint64_t position);

  // Whether it waits for the speed function that is to drive it.
  [[nodiscard]] bool holds_steps() const { return case_speed_.holds_steps(*case_); }

  // Brings pictures, figures and state up to date.
  void show();
  void report_failure(const Error& error);

 private:
  void publish();
  void show_pictures();  // posts those that are out of date
  void phi_changed();
  void recover(const Error& error);
  void give_up(const Error& error);
  void post_steps(Engine::Clock::time_point due = {});
  void run_steps(std::uint64_t turn, std::stop_token stop);
  void post_picture(const std::shared_ptr<ViewSlot>& slot, Priority priority);
  void draw_in_turn(const std::shared_ptr<ViewSlot>& slot, Priority priority, std::stop_token stop);
  void draw(const std::shared_ptr<ViewSlot>& slot, std::stop_token stop);
  Status measure(bool thoroughly);
  Status add_missed(const std::vector<std::int64_t>& inside, std::uint64_t gesture);
  void follow_drive();
  [[nodiscard]] bool smoothing_is_last() const;
  void take_speed(const SpeedOrigin& origin, const SpeedMaker::Made& made);
  [[nodiscard]] SpeedMaker::Report report() const;  // of long work, to the proxy
  Status follow_surface();
  void post_measurement();
  void post_history();
  void end_run();
  void report_end_of_run();
  std::shared_ptr<const PagedBytes> label_voxels();
  Status follow_graphics();
  [[nodiscard]] solver::ExecutorOptions executor_options() const;

  Engine& engine_;
  std::shared_ptr<const LoadedStudy> study_;
  solver::ExecutorKind executor_kind_;
  Receiver receiver_;
  RestoredCase restored_;

  std::unique_ptr<document::Case> case_;
  std::optional<Error> obstacle_;
  CasePainter painter_;
  CaseMeter meter_;
  CaseHistory history_;
  int graphics_ = 0;  // Engine::contexts_made() when the executor was made
  std::weak_ptr<LockStep> group_;

  LeakWatch leak_watch_;
  StepSchedule schedule_;
  CaseSpeed case_speed_;
  ShownSpeed shown_speed_;

  bool playing_ = false;
  bool pause_at_convergence_ = true;
  bool measurement_waits_ = false;
  bool history_waits_ = false;
  std::uint64_t posted_ = 0;       // commands; the proxy's thread
  std::uint64_t carried_out_ = 0;  // the last of them
  std::uint64_t turn_ = 0;         // of the steps that wait: those of earlier ones are not wanted any more
  std::int64_t advances_ = 0;      // how often steps were computed
  std::int64_t stroke_steps_ = 0;  // by the function that learns from a stroke; 0: none
  std::optional<Run> run_;         // that is under way; `steps` are left of it
  std::optional<Run> ended_run_;   // to be reported; `steps` were not computed

  std::shared_ptr<const PagedBytes> label_voxels_;  // as of label_revision_
  std::uint64_t label_revision_ = 0;
  std::optional<document::Acceptance> acceptance_;
  std::uint64_t acceptance_position_ = 0;  // in the history, right after it
  std::uint64_t smoothing_position_ = 0;   // in the history, when the smoothing on its way was asked for

  StatePost post_;
};

}  // namespace tidemark::engine
