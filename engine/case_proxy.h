// A case as widgets know it: its state after the last job, its commands, and its display. The case itself
// belongs to the engine's thread (case_runner.h).
#pragma once

#include <QObject>
#include <QString>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/bit_mask.h"
#include "core/progress.h"
#include "document/case.h"
#include "document/drive.h"
#include "document/session_contents.h"
#include "document/sweep.h"
#include "engine/case_state.h"
#include "engine/display.h"
#include "engine/engine.h"
#include "engine/state_comparison.h"
#include "engine/study_loader.h"
#include "renderer/renderer.h"
#include "solver/executor.h"
#include "solver/statistics.h"

namespace tidemark::imaging {
struct Segments;
}

namespace tidemark::engine {

class CaseBalance;
class CasePasses;
class CaseRunner;
class CaseSweep;
class LabelFinisher;
class LockStep;
class RegionMeter;
class WantedMap;
class WeakReceiver;
struct RecordedStep;

// What a session file holds of a case beside its history.
struct Attachments {
  std::vector<std::shared_ptr<const document::CaseImage>> images;
  std::shared_ptr<const BitMask> truth;  // null: the study's own
  std::vector<Measurement> measurements;

  bool operator==(const Attachments&) const = default;
};

// A case as a session file had it, or a copy of it. One in no file that the user knows counts as modified.
struct RestoredCase {
  std::shared_ptr<const document::SessionContents> contents;
  bool in_no_file = false;

  // The known answer: its own, else the study's. Null: neither has one.
  [[nodiscard]] const std::shared_ptr<const BitMask>& truth(const LoadedStudy& study) const {
    return contents && contents->truth ? contents->truth : study.truth;
  }
};

// Lives on the thread of the user interface. Commands return at once; their outcome comes with
// state_changed(), what went wrong with failed().
class CaseProxy : public QObject {
  Q_OBJECT
 public:
  CaseProxy(Engine& engine, std::shared_ptr<const LoadedStudy> study, solver::ExecutorKind executor,
            RestoredCase restored = {});
  ~CaseProxy() override;  // cancels what is running

  [[nodiscard]] const CaseState& state() const { return state_; }
  [[nodiscard]] const Volume& volume() const { return *study_->volume; }
  // What D sees: the volume, smoothed as CaseState says.
  [[nodiscard]] const std::shared_ptr<const Volume>& source() const {
    return state_.source ? state_.source : study_->volume;
  }
  [[nodiscard]] const SourceSummary& summary() const { return study_->summary; }
  [[nodiscard]] const document::StudyOrigin& origin() const { return study_->origin; }
  [[nodiscard]] const LoadedStudy& study() const { return *study_; }
  [[nodiscard]] const std::shared_ptr<const LoadedStudy>& shared_study() const { return study_; }
  [[nodiscard]] const QString& name() const { return study_->name; }
  // The known answer, on the volume's grid: a phantom's own, or another one; null: none.
  [[nodiscard]] const std::shared_ptr<const BitMask>& truth() const { return truth_; }
  // Figures are compared with it from now on. It must be on the volume's grid.
  void compare_with(std::shared_ptr<const BitMask> truth);
  [[nodiscard]] bool has_another_truth() const { return truth_ != study_->truth; }
  void compare_as_the_study() { compare_with(study_->truth); }
  // That the display asks for. Making it takes a while: CaseState has the one that is shown.
  [[nodiscard]] SurfaceMap wanted_surface_map() const;
  [[nodiscard]] Display& display() { return display_; }
  [[nodiscard]] Engine& engine() { return engine_; }
  // Why the surface moves or rests at a place that the user has chosen.
  [[nodiscard]] CaseBalance& balance() { return *balance_; }
  // What the passes of the stream executor make of a page.
  [[nodiscard]] CasePasses& passes() { return *passes_; }
  // The parameters as last set here, before the engine has taken them: what sliders show.
  [[nodiscard]] const solver::Parameters& parameters() const { return wanted_parameters_; }
  // So is what drives the surface.
  [[nodiscard]] const document::Drive& drive() const { return wanted_drive_; }

  // The evolution.
  void play();
  void pause();
  void toggle_play() { state_.playing ? pause() : play(); }
  // Plays for so many steps, alone, or until the surface rests where that comes before and is asked for. No
  // leak ends it. `ended` is called when state() is that after it, with whether it came to its end, and where
  // it cannot begin; never when the case is closed before.
  void play_for(std::int64_t steps, bool until_rest, std::function<void(bool reached)> ended);
  // `answer` is called when the figures in state() are those of the present surface.
  void measure(std::function<void()> answer);
  // `answer` is called when state() is that after all commands so far, whether or not they could be carried
  // out; never when the case is closed before.
  void after_commands(std::function<void()> answer);
  void step(std::int64_t steps = 1);
  void step_back(std::int64_t steps = 1);
  void restart();
  // Between two pictures while it plays; 0: as many as take about 16 ms.
  void set_steps_per_picture(std::int64_t steps);
  [[nodiscard]] std::int64_t steps_per_picture() const { return steps_per_picture_; }
  // At most so many steps a second, in lock-step for all; 0: as many as can be computed.
  void set_pace(double steps_per_second);
  void set_pause_at_convergence(bool pause);
  [[nodiscard]] bool pause_at_convergence() const { return pause_at_convergence_; }
  // What counts as a leak, at which it pauses; unset: it does not.
  void set_leak_rule(const std::optional<document::LeakRule>& rule);
  [[nodiscard]] const std::optional<document::LeakRule>& leak_rule() const { return leak_rule_; }

  // Edits. One gesture (a drag, a stroke) is one entry of the history; 0: an edit of its own.
  [[nodiscard]] static std::uint64_t new_gesture();
  // What changes parameters or drive is called at once for what is seen here, and once more for what the case
  // has when the command's turn comes: an undo may come between. That is on the engine's thread, so it holds
  // values.
  using ParameterChange = std::function<void(solver::Parameters&)>;
  void change_parameters(const ParameterChange& change, std::uint64_t gesture = 0);
  void set_parameters(const solver::Parameters& parameters, std::uint64_t gesture = 0);
  // The speed function that belongs to it is made in the background, and drives the surface from then on.
  // Its images are those that the display says are used, where a function uses images; else none.
  using DriveChange = std::function<void(document::Drive&)>;
  void change_drive(const DriveChange& change, std::uint64_t gesture = 0);
  void set_drive(const document::Drive& drive, std::uint64_t gesture = 0);
  // The same after a stroke of examples over `voxels`, ascending. With steps, it pauses until the function
  // has learned from it, and then moves by so many, or until it rests: a leak is seen while it is small. What
  // of a stroke inside lies outside of the surface is added to it; without a surface it begins in all strokes
  // inside. Play, pause and edits of the surface call that off. In lock-step the surface does not move by it.
  void take_stroke(const DriveChange& change, const std::vector<std::int64_t>& voxels, std::int64_t steps);
  void begin(const document::Start& start);
  void paint(const solver::Sphere& sphere, solver::Brush brush, std::uint64_t gesture);
  // The level set's source (0: the volume itself). It is smoothed in the background; undo() gives that up
  // where nothing was done since.
  void smooth_source(double sigma_mm);
  void change_executor(solver::ExecutorKind kind);
  void undo();
  void redo();
  // Another state of the history, of CaseState::history; what was done since stays in it.
  void go_to(std::uint64_t state);
  // With another one of them.
  [[nodiscard]] StateComparison& comparison() { return comparison_; }

  // Labels.
  void add_label(const QString& name);
  void set_label(const document::Label& label);
  void remove_label(std::uint8_t id);
  void import_labels(std::shared_ptr<const imaging::Segments> segments);  // as new labels
  // The one that is chosen, else the newest. Null: there is none.
  [[nodiscard]] const document::Label* chosen_label() const;
  // The surface's inside becomes the label, or a new one, as of document::Case; CaseState::acceptance has the
  // outcome.
  void accept_surface(std::uint8_t label, document::Take take = document::Take::free_voxels,
                      const QString& another = {});
  // The labels become those regions. As a tool makes them: see label_finisher().
  // With `from`: fails when the labels are others by the time that the command is carried out.
  void finish_labels(std::shared_ptr<const std::vector<document::LabelRegion>> regions, document::Take take,
                     const std::optional<document::LabelVoxels>& from = {});
  // A stroke of the brush: one entry of the history. Label 0 is the newest one by the time that the command
  // is carried out; where there is none, a stroke that adds makes one, and another does nothing.
  void brush_label(document::LabelRegion stroke, document::Labels::Stroke what, document::Take take);
  [[nodiscard]] LabelFinisher& label_finisher() { return *label_finisher_; }
  [[nodiscard]] RegionMeter& region_meter() { return *region_meter_; }
  // With `within_mm` the label is refined: the surface stays that near to it.
  void begin_from_label(std::uint8_t label, std::optional<double> within_mm = std::nullopt, int levels = 1);

  // The state comes once more, its texts in the language of now.
  void translate_state();

  // Whether somebody waits for an answer of after_commands(), pick() or take_snapshot().
  [[nodiscard]] bool is_asked() const { return askers_.use_count() > 1; }

  // The place that a pixel of a 3D view shows (from its top left, physical pixels); the answer comes later,
  // or never when the case is closed before. `labels`: those that the view shows; null: the case's.
  void pick(const renderer::VolumeView& view, renderer::PictureSize size,
            std::shared_ptr<const document::Labels> labels, glm::dvec2 pixel,
            std::function<void(std::optional<renderer::Hit>)> answer);

  // The next step of a virtual page; the answer comes as pick()'s does. Nothing is changed by it. Fails
  // (ErrorKind::cancelled) where the case could not be asked: it has said why.
  void record_step(std::int64_t page, std::function<void(const Result<RecordedStep>&)> answer);

  // The case as it is now, with the images of the display, for writing on another thread; the answer comes as
  // pick()'s does.
  struct Snapshot {
    document::SessionContents contents;
    Attachments attachments;
    std::uint64_t position = 0;  // for mark_saved()
  };
  // An open change ends as an entry of the history. While it goes on, a snapshot has no history.
  enum class OpenChange { ends, goes_on };
  // On a failure failed() says why, and `gave_up` is called instead of the answer.
  void take_snapshot(std::string view_state, std::function<void(std::shared_ptr<const Snapshot>)> answer,
                     std::function<void()> gave_up = {}, OpenChange open = OpenChange::ends);
  // A session file holds the snapshot of that position.
  void mark_saved(const Snapshot& snapshot);
  // Another file holds the surface of that position, and nothing that lies beside the history.
  void mark_surface_saved(std::uint64_t position);
  // Whether images, the truth and measurements are those of the session file.
  [[nodiscard]] bool has_saved_attachments() const;
  [[nodiscard]] Attachments attachments() const;
  // It holds what the display gets next.
  void set_saved(const DisplaySettings& settings) { saved_ = attachments_of(settings); }

  // For runs of a sweep from the case's start; the answer comes, and fails, as that of record_step() does.
  void prepare_sweep(std::function<void(const Result<document::SweepStart>&)> answer);
  // The case becomes that run, computed again by its own executor.
  void take_run(std::shared_ptr<const document::SweepStart> start, const document::SweepRun& run);
  [[nodiscard]] CaseSweep& sweep() { return *sweep_; }

  // Plays cases together, always at the same step; in no group any more when there are none.
  static void play_in_lock_step(const std::vector<CaseProxy*>& proxies);
  void leave_lock_step();
  [[nodiscard]] bool in_lock_step() const { return lock_step_ != nullptr; }

  // The case on the engine's thread, for views.
  [[nodiscard]] const std::shared_ptr<CaseRunner>& runner() const { return runner_; }

 signals:
  void state_changed();
  void failed(const QString& message);
  void given_up();  // failed() has said why: no command is carried out any more, and nothing can be saved
  // Long work (smoothing, flood fill): fraction in 0..1, 1 when it is over.
  void progressed(double fraction, const QString& what);

 private:
  using Command = std::function<Status(CaseRunner&, const Progress&)>;
  void post(Command command);
  void take(CaseState state);
  void use_images_of_display();
  void use_truth();
  void show_distances();
  void show_images_of_drive();
  // The drive that a change makes of the one that the case has; empty: here it changes nothing.
  using ChangedDrive = std::function<document::Drive(const document::Drive& present)>;
  ChangedDrive want(const DriveChange& change);
  [[nodiscard]] Attachments attachments_of(const DisplaySettings& settings) const;
  [[nodiscard]] bool modified() const;
  void follow_modified();
  void set_playing(bool playing);

  Engine& engine_;
  std::shared_ptr<const LoadedStudy> study_;
  std::shared_ptr<const BitMask> truth_;
  Display display_;
  StateComparison comparison_;
  std::shared_ptr<WeakReceiver> weak_receiver_;
  std::shared_ptr<WeakReceiver> askers_;  // each answer on its way holds it
  std::shared_ptr<CaseRunner> runner_;
  std::shared_ptr<LockStep> lock_step_;
  std::unique_ptr<CaseSweep> sweep_;
  std::unique_ptr<LabelFinisher> label_finisher_;
  std::unique_ptr<RegionMeter> region_meter_;
  CaseState state_;
  std::unique_ptr<CaseBalance> balance_;
  std::unique_ptr<WantedMap> truth_error_;
  std::unique_ptr<WantedMap> spread_;
  std::shared_ptr<const document::Agreement> spread_runs_;  // as `spread_` has them
  solver::Parameters wanted_parameters_;
  document::Drive wanted_drive_;
  std::int64_t steps_per_picture_ = 0;
  bool pause_at_convergence_ = true;
  std::optional<document::LeakRule> leak_rule_ = document::LeakRule{};
  std::uint64_t last_command_ = 0;
  bool case_modified_ = false;
  // In the session file; they are none of the case's history.
  Attachments saved_;
  std::unique_ptr<CasePasses> passes_;
};

}  // namespace tidemark::engine
