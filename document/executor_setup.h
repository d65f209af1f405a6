// An executor with all that it was made from, so that it can be made anew and driven by a recipe.
#pragma once

#include <memory>

#include "core/progress.h"
#include "document/recipe.h"
#include "solver/executor.h"

namespace tidemark {

class ExecutorSetup {
 public:
  // phi is outside everywhere. Fails as make_executor() and smooth() do.
  static Result<ExecutorSetup> create(std::shared_ptr<const Volume> volume, double smoothed_mm,
                                      const Parameters& parameters, ExecutorKind kind,
                                      const ExecutorOptions& options);

  [[nodiscard]] Executor& executor() { return *executor_; }
  [[nodiscard]] const Executor& executor() const { return *executor_; }
  [[nodiscard]] const std::shared_ptr<const Volume>& volume() const { return volume_; }  // as loaded
  [[nodiscard]] const std::shared_ptr<const Volume>& source() const { return source_; }  // as it is seen
  [[nodiscard]] double smoothed_mm() const { return smoothed_mm_; }
  [[nodiscard]] ExecutorKind kind() const { return kind_; }  // as it was asked for
  [[nodiscard]] RecipeExecutor description() const;

  // Each makes another executor; when it fails, everything is as it was. The first goes on from the same phi.
  Status smooth_source(double sigma_mm);
  Status change_executor(ExecutorKind kind, const ExecutorOptions& options, const Field& phi);

  // Begins as the recipe does, with the present parameters and source; an empty start: outside everywhere.
  // phi as it then is.
  Result<Field> begin(const Recipe& recipe, const Progress& progress);
  // phi is put back as it is: see ResumeEvent.
  Status resume();

  // Does what the recipe says from its `first_event` on until `last_step` steps have been computed, and the
  // edits after the last of them. `step` have been computed. What it cost is added up in `total`.
  Status play(const Recipe& recipe, std::size_t first_event, std::int64_t step, std::int64_t last_step,
              const Progress& progress, AdvanceReport* total = nullptr);
  // Does what one event says.
  Status apply(const RecipeEvent& event);

 private:
  ExecutorSetup() = default;
  Status remake(std::shared_ptr<const Volume> source, ExecutorKind kind, const ExecutorOptions& options,
                const Field& phi);

  std::shared_ptr<const Volume> volume_;
  std::shared_ptr<const Volume> source_;
  double smoothed_mm_ = 0.0;
  ExecutorKind kind_ = ExecutorKind::automatic;
  ExecutorOptions options_;
  std::unique_ptr<Executor> executor_;
};

}  // namespace tidemark
