// An executor with all that it was made from, for making it anew and for driving it by a recipe.
#pragma once

#include <memory>

#include "core/progress.h"
#include "document/coarse_levels.h"
#include "document/recipe.h"
#include "solver/executor.h"

namespace tidemark::document {

// The volume as a level set sees it: smoothed by that many mm (0: itself). Fails (ErrorKind::usage) where
// that is no length, (ErrorKind::cancelled).
Result<std::shared_ptr<const Volume>> smoothed_source(const std::shared_ptr<const Volume>& volume,
                                                      double sigma_mm, const Progress& progress = {});

class ExecutorSetup {
 public:
  // phi is outside everywhere. Fails as make_executor() and smoothed_source() do.
  static Result<ExecutorSetup> create(std::shared_ptr<const Volume> volume, double smoothed_mm,
                                      const solver::Parameters& parameters, solver::ExecutorKind kind,
                                      const solver::ExecutorOptions& options);

  [[nodiscard]] solver::Executor& executor() { return *executor_; }
  [[nodiscard]] const solver::Executor& executor() const { return *executor_; }
  [[nodiscard]] const std::shared_ptr<const Volume>& volume() const { return volume_; }  // as loaded
  [[nodiscard]] const std::shared_ptr<const Volume>& source() const { return source_; }  // perhaps smoothed
  [[nodiscard]] double smoothed_mm() const { return smoothed_mm_; }
  [[nodiscard]] solver::ExecutorKind kind() const { return kind_; }  // as it was asked for
  [[nodiscard]] const solver::ExecutorOptions& options() const { return options_; }
  [[nodiscard]] RecipeExecutor description() const;

  // What drives and holds the surface (null: as without): another executor gets it, too. Fails as
  // make_speed() and the executor do; the former drive then goes on.
  Status set_drive(std::shared_ptr<const Drive> drive, const Progress& progress = {});
  // The same with the function that was made from it for the present source; its tents are made anew for the
  // present parameters. Null, of another setting than the tent: it lacks its function then.
  Status set_drive(std::shared_ptr<const Drive> drive, std::shared_ptr<const solver::SpeedFunction> speed);
  Status set_parameters(const solver::Parameters& parameters);
  // The parameters of another start: with another band, phi is outside everywhere until it is restored.
  Status prepare(const solver::Parameters& parameters);
  [[nodiscard]] bool has_band_of(const solver::Parameters& parameters) const;
  [[nodiscard]] const std::shared_ptr<const Drive>& drive() const { return drive_; }
  // Whether the drive's function is missing: the tent is in its place, and no step may be computed before
  // make_missing_speed(), which fails as set_drive() does, or another set_drive().
  [[nodiscard]] bool lacks_speed() const;
  Status make_missing_speed(const Progress& progress);

  // All conditions of a recipe's start or end, smoothed by that many mm. A function that is not that of the
  // present drive is missing then. Nothing is made anew for what is in place.
  Status set_conditions(double smoothed_mm, const solver::Parameters& parameters,
                        const std::shared_ptr<const Drive>& drive);

  // Each makes another executor, or fails and changes nothing. They go on from the same phi.
  Status smooth_source(double sigma_mm, const Progress& progress = {});
  // With the volume, smoothed by that much, and the function for it, as set_drive() takes it.
  Status set_source(std::shared_ptr<const Volume> source, double smoothed_mm,
                    std::shared_ptr<const solver::SpeedFunction> speed);
  Status change_executor(solver::ExecutorKind kind, const solver::ExecutorOptions& options,
                         const solver::Field& phi);
  // The one of a recipe. Where it is that one already, as resume().
  Status use(const RecipeExecutor& executor);

  // A start with the present parameters and source, and with its limit; an empty one is outside everywhere.
  // Returns phi at the start.
  Result<solver::Field> begin(const Start& start, const Progress& progress);
  // On coarser grids, of the last begin(); empty: it had one level, or the coarse ones did not hold it.
  [[nodiscard]] const std::vector<CoarseRun>& coarse_runs() const { return coarse_runs_; }
  // What a start that was refined lays down for the surface, beside walls and anchors; null: nothing.
  Status set_limit(std::shared_ptr<const solver::MotionLimit> limit);
  // Puts back the executor's own phi: see ResumeEvent.
  Status resume();

  // Carries out the recipe from its `first_event` on until `last_step` steps have been computed, with the
  // edits after the last of them. `step` steps have been computed before. The cost is added to `total`.
  // `until_converged`: the steps after the last event end when the surface has stopped moving.
  Status play(const Recipe& recipe, std::size_t first_event, std::int64_t step, std::int64_t last_step,
              const Progress& progress, solver::AdvanceReport* total = nullptr, bool until_converged = false);
  // Carries out one event.
  Status apply(const RecipeEvent& event, const Progress& progress = {});

 private:
  ExecutorSetup() = default;
  Status apply(const DriveEvent& event, const Progress& progress);
  Result<solver::Field> begin_present(const Start& start, const Progress& progress);
  Status hold(std::shared_ptr<const solver::Constraints> marks,
              std::shared_ptr<const solver::MotionLimit> limit);
  Status remake(std::shared_ptr<const Volume> source, const solver::Parameters& parameters,
                solver::ExecutorKind kind, const solver::ExecutorOptions& options, const solver::Field& phi,
                std::shared_ptr<const solver::SpeedFunction> speed);

  std::shared_ptr<const Volume> volume_;
  std::shared_ptr<const Volume> source_;
  double smoothed_mm_ = 0.0;
  std::shared_ptr<const Drive> drive_;                // null: the tent, and nothing that holds the surface
  std::shared_ptr<const solver::MotionLimit> limit_;  // null: none
  solver::ExecutorKind kind_ = solver::ExecutorKind::automatic;
  solver::ExecutorOptions options_;
  std::unique_ptr<solver::Executor> executor_;
  std::vector<CoarseRun> coarse_runs_;
};

}  // namespace tidemark::document
