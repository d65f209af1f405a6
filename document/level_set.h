// The level set of a case while it is steered: an executor, its recipe, and the way back.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "document/curve.h"
#include "document/drive.h"
#include "document/executor_setup.h"
#include "document/history.h"
#include "document/recipe.h"
#include "document/start.h"
#include "document/sweep.h"
#include "solver/executor.h"

namespace tidemark::document {

struct SavedHistory;

// Used on one thread at a time: that of the executor's graphics context, where it has one.
//
// phi is read back only where its value must be known: at the end of an entry of the history, for a
// checkpoint (measuring and saving ask for one, while it plays too), and before the first step after paint.
// Between these, `dirty_` means that phi has changed since known_.
class LevelSet final : private OpenChange {
 public:
  // Everywhere outside at first, on the unsmoothed volume. Fails as make_executor() does. `history` must
  // outlive it.
  static Result<std::unique_ptr<LevelSet>> create(std::shared_ptr<const Volume> volume,
                                                  const solver::Parameters& parameters,
                                                  solver::ExecutorKind kind,
                                                  const solver::ExecutorOptions& options, History& history);

  [[nodiscard]] const solver::Executor& executor() const { return setup_.executor(); }
  [[nodiscard]] solver::Executor& executor() { return setup_.executor(); }
  [[nodiscard]] const solver::Parameters& parameters() const { return executor().parameters(); }
  [[nodiscard]] const std::shared_ptr<const Volume>& source() const { return setup_.source(); }
  [[nodiscard]] double smoothed_mm() const { return setup_.smoothed_mm(); }
  [[nodiscard]] const Drive& drive() const { return *drive_; }
  [[nodiscard]] std::int64_t step() const { return recipe_.steps; }  // since the start
  [[nodiscard]] bool begun() const { return recipe_.begun(); }       // there is a surface to steer
  // phi before the first step; null: a session was opened that goes on from later.
  [[nodiscard]] const std::shared_ptr<const solver::Field>& start() const { return start_; }
  // Everything since the start, but for the source's series, which the case adds.
  [[nodiscard]] const Recipe& recipe() const { return recipe_; }

  // Each of these is an entry of the history. Edits with the same `gesture` (not 0: one drag of a slider, one
  // stroke of a brush) and the steps between them are one entry. The steps after the last of them, up to
  // the next checkpoint, belong to it too.
  Status begin(const Start& start, const Progress& progress = {});
  Status paint(const solver::Sphere& sphere, solver::Brush brush, std::uint64_t gesture = 0);
  // Another band W cannot be had in mid-run: the level set begins again, at its start.
  Status set_parameters(const solver::Parameters& parameters, std::uint64_t gesture = 0);
  // Walls and anchors hold the surface at once. The speed function is the tent, if it is to be; else what
  // set_speed() gives is the one that belongs to it.
  Status set_drive(const Drive& drive, std::uint64_t gesture = 0);
  // The level set's source becomes the volume, smoothed by that many mm (0: not at all).
  Status smooth_source(double sigma_mm);
  // The same with the source that smoothed_source() has made, and the function that belongs to it and to
  // drive(); null: the tent, or one that is made when it is needed.
  Status set_source(std::shared_ptr<const Volume> source, double sigma_mm,
                    std::shared_ptr<const solver::SpeedFunction> speed);
  // Steps, one after the other, are one entry until another edit or end_run(). When a memory budget ends the
  // run, the steps up to there count.
  Result<solver::AdvanceReport> advance(const solver::Advance& run);
  Status end_run();

  // Back to where the level set was `steps` steps ago, by computing again from where phi was last put in
  // place: the same voxels, by the executors that have made them. Where the first of these cannot be had,
  // the present one computes all. At most to the start. An entry of its own.
  Status step_back(std::int64_t steps, const Progress& progress = {});
  // Back to the start as it was before the first step, with the present parameters, walls and anchors. Those
  // that are gone by then have not moved it. An entry of its own.
  Status restart();

  // For runs from where restart() leads, with the present parameters, drive and source.
  // Fails (ErrorKind::usage) when there is no surface.
  Result<SweepStart> sweep_start();
  // Becomes that run of a sweep, computed again by the case's own executor. An entry of its own. Fails
  // (ErrorKind::usage) when the start or the source is another one by now; nothing is changed then.
  Status take_run(const SweepStart& start, const SweepRun& run, const Progress& progress = {});

  // Whether undo or a session has led to a drive whose function must be made first. The next step makes it,
  // unless set_speed() or set_source() has given it by then.
  [[nodiscard]] bool lacks_speed() const { return setup_.lacks_speed(); }
  // The function that was made from drive(): from here on the recipe has it. Not an entry of the history.
  Status set_speed(std::shared_ptr<const solver::SpeedFunction> speed);

  // Goes on with another executor from the same phi; where steps were computed, the recipe says so. Where phi
  // was lost with its context, as rebuild() does.
  Status change_executor(solver::ExecutorKind kind, const solver::ExecutorOptions& options);
  // After the graphics context was lost: a new executor on options.device, from the last checkpoint, with the
  // present parameters; of another kind, where none of the same can be had.
  Status rebuild(const solver::ExecutorOptions& options,
                 std::optional<solver::ExecutorKind> kind = std::nullopt);

  // phi for saving and measuring. Counts as a checkpoint for rebuild().
  Result<std::shared_ptr<const solver::Field>> checkpoint();

  // phi in another state of the history, with nothing done to this one.
  [[nodiscard]] const solver::Field& phi_at(std::uint64_t state) const {
    return *history_.steering(state).phi;
  }
  // Whether steps without an edit among them are the open change.
  [[nodiscard]] bool in_run() const { return open_ && open_->gesture == 0; }

  // drive(), unless the recipe ends with it: it waits for its function, or has what another function needs.
  // Null: the recipe ends with it.
  [[nodiscard]] std::shared_ptr<const Drive> wanted_drive() const { return unless_last(recipe_, drive_); }
  // Goes on from a saved recipe, the phi that it had led to, and wanted_drive(). Not an entry of the history.
  Status resume_from(const Recipe& recipe, std::shared_ptr<const solver::Field> phi, const Curve& curve = {},
                     const std::shared_ptr<const Drive>& wanted_drive = nullptr);

  // The states of the history. Empty while a change is open.
  [[nodiscard]] SavedHistory saved_history() const;
  // The history that led to that point, and went on from it: the present state of `history` is where
  // resume_from() has gone. In place of the present history.
  void restore_history(const SavedHistory& history);

  // The development of the surface since the start; the caller adds points, undo and redo bring them back.
  [[nodiscard]] const Curve& curve() const { return curve_; }
  // Another answer is compared with from now on: no state's curve says anything of the former one any more.
  void forget_dice() { curve_.compare_with(++answer_); }
  void note(const CurvePoint& point);

 private:
  friend class LevelSetChange;

  // phi, the recipe that led to it, phi before the first step (null: to be made from the recipe), and the
  // measured curve.
  struct Point {
    Recipe recipe;
    std::shared_ptr<const solver::Field> phi;
    std::shared_ptr<const solver::Field> start;
    Curve curve{};
    std::shared_ptr<const Drive> drive = std::make_shared<const Drive>();

    [[nodiscard]] bool same_as(const Point& other) const {
      return phi == other.phi && *drive == *other.drive && recipe.steps == other.recipe.steps &&
             recipe.events == other.recipe.events && recipe.parameters == other.recipe.parameters;
    }
  };
  // An open entry.
  struct Open {
    ChangeKind kind = ChangeKind::evolution;
    std::uint64_t gesture = 0;
    Point before;
    std::optional<Point>
        last_edit;  // a checkpoint after the last edit of the gesture: there it can be divided
  };

  [[nodiscard]] static Steering steering_of(const Recipe& recipe, const Drive& drive,
                                            std::shared_ptr<const solver::Field> phi);
  [[nodiscard]] static Steering steering_of(const Point& point) {
    return steering_of(point.recipe, *point.drive, point.phi);
  }
  [[nodiscard]] static std::shared_ptr<const Drive> unless_last(const Recipe& recipe,
                                                                const std::shared_ptr<const Drive>& drive);
  [[nodiscard]] static std::shared_ptr<const Drive> drive_of(
      const Recipe& recipe, const std::shared_ptr<const Drive>& wanted_drive);
  [[nodiscard]] Point point_of(const SavedHistory& history, std::size_t state) const;

  LevelSet(ExecutorSetup setup, const solver::Parameters& parameters, History& history);

  ChangeDescription description() const override;
  Steering steering() const override { return steering_of(recipe_, *drive_, nullptr); }
  std::int64_t bytes() const override;
  Status close() override;

  Status end_other_change(std::uint64_t gesture);
  void begin_change(ChangeKind kind, std::uint64_t gesture, Point before);
  void record(RecipeEvent event);
  [[nodiscard]] Drive drive_in_use() const;
  enum class Entry { next, none };  // of the history, for what is done
  Status use(const Drive& drive, std::shared_ptr<const solver::SpeedFunction> speed, Entry entry);
  void append(RecipeEvent event);
  void append_resumption();
  void settle_executor(Recipe& recipe) const;
  void add_entry(ChangeKind kind, const Point& before, const Point& after);
  void enter(ChangeKind kind, Point before);
  Status read_back_phi();
  void put_in_place(Point point);
  void pass(Point point);
  Status arrive();
  Status hand_over(const Point& point);
  Status go_to(Point point);
  Status play_start(const Recipe& recipe);
  Status prepare_start();
  Result<std::shared_ptr<const solver::Field>> played_start(const Recipe& recipe);
  Result<std::shared_ptr<const solver::Field>> start_made_anew(const Recipe& recipe);
  Result<Point> start_point(const solver::Parameters& parameters, const std::shared_ptr<const Drive>& drive);
  void settle_start(Recipe& start) const;
  Status begin_again_with(const solver::Parameters& parameters);
  void take_drive_of_recipe();
  Status compute_again(std::int64_t target, const Progress& progress);
  Status keep(Status computed, Recipe recipe, ChangeKind kind, Point before);

  ExecutorSetup setup_;
  History& history_;
  Recipe recipe_;
  std::shared_ptr<const solver::Field> start_;  // phi before the first step
  Curve curve_;
  std::uint64_t answer_ = 0;  // with which surfaces are compared: grows with each choice
  std::shared_ptr<const Drive> drive_ = std::make_shared<const Drive>();
  // How many of the recipe's events every way through the history to the last entry has: set_speed() adds
  // some between two entries.
  std::size_t settled_events_ = 0;
  Point known_;              // the last phi that was read back
  bool dirty_ = false;       // phi has changed since
  Point in_place_;           // where phi was last put in place; the executor has run on since
  bool resumed_ = false;     // it was, and the recipe does not say so yet
  bool on_its_way_ = false;  // to known_, which the executor has not got yet
  std::optional<Open> open_;
};

}  // namespace tidemark::document
