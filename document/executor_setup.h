// An executor with all that it was made from, for making it anew and for driving it by a recipe.
#pragma once

#include <memory>

#include "core/progress.h"
#include "document/recipe.h"
#include "solver/executor.h"

namespace tidemark::document {

class ExecutorSetup {
 public:
  // phi is outside everywhere. Fails as make_executor() and smooth() do.
  static Result<ExecutorSetup> create(std::shared_ptr<const Volume> volume, double smoothed_mm,
                                      const solver::Parameters& parameters, solver::ExecutorKind kind,
                                      const solver::ExecutorOptions& options);

  [[nodiscard]] solver::Executor& executor() { return *executor_; }
  [[nodiscard]] const solver::Executor& executor() const { return *executor_; }
  [[nodiscard]] const std::shared_ptr<const Volume>& volume() const { return volume_; }  // as loaded
  [[nodiscard]] const std::shared_ptr<const Volume>& source() const { return source_; }  // perhaps smoothed
  [[nodiscard]] double smoothed_mm() const { return smoothed_mm_; }
  [[nodiscard]] solver::ExecutorKind kind() const { return kind_; }  // as it was asked for
  [[nodiscard]] RecipeExecutor description() const;

  // What drives and holds the surface (null: as without): another executor gets it, too. Fails as
  // make_speed() and the executor do; the former drive then goes on.
  Status set_drive(std::shared_ptr<const Drive> drive, const Progress& progress = {});
  // The same with the function that was made from it for the present source and parameters.
  Status set_drive(std::shared_ptr<const Drive> drive, std::shared_ptr<const solver::SpeedFunction> speed);
  Status set_parameters(const solver::Parameters& parameters);
  [[nodiscard]] const std::shared_ptr<const Drive>& drive() const { return drive_; }

  // Each makes another executor, or fails and changes nothing. The first goes on from the same phi.
  Status smooth_source(double sigma_mm);
  Status change_executor(solver::ExecutorKind kind, const solver::ExecutorOptions& options,
                         const solver::Field& phi);

  // A start with the present parameters and source, and with its limit; an empty one is outside everywhere.
  // Returns phi at the start.
  Result<solver::Field> begin(const Start& start, const Progress& progress);
  // What a start that was refined lays down for the surface, beside walls and anchors; null: nothing.
  Status set_limit(std::shared_ptr<const solver::MotionLimit> limit);
  // Puts back the executor's own phi: see ResumeEvent.
  Status resume();

  // Carries out the recipe from its `first_event` on until `last_step` steps have been computed, with the
  // edits after the last of them. `step` steps have been computed before. The cost is added to `total`.
  Status play(const Recipe& recipe, std::size_t first_event, std::int64_t step, std::int64_t last_step,
              const Progress& progress, solver::AdvanceReport* total = nullptr);
  // Carries out one event.
  Status apply(const RecipeEvent& event);

 private:
  ExecutorSetup() = default;
  Status hold(std::shared_ptr<const solver::Constraints> marks,
              std::shared_ptr<const solver::MotionLimit> limit);
  Status remake(std::shared_ptr<const Volume> source, solver::ExecutorKind kind,
                const solver::ExecutorOptions& options, const solver::Field& phi,
                std::shared_ptr<const solver::SpeedFunction> speed);

  std::shared_ptr<const Volume> volume_;
  std::shared_ptr<const Volume> source_;
  double smoothed_mm_ = 0.0;
  std::shared_ptr<const Drive> drive_;                // null: the tent, and nothing that holds the surface
  std::shared_ptr<const solver::MotionLimit> limit_;  // null: none
  solver::ExecutorKind kind_ = solver::ExecutorKind::automatic;
  solver::ExecutorOptions options_;
  std::unique_ptr<solver::Executor> executor_;
};

}  // namespace tidemark::document
