// The level set of a case while it is steered: an executor, everything that was done to it, and the way back.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "solver/executor.h"
#include "study/history.h"
#include "study/recipe.h"
#include "study/start.h"

namespace tidemark {

// Used on one thread at a time: that of the executor's graphics context, where it has one.
class LevelSet {
 public:
  // Everywhere outside at first. Fails as make_executor() does.
  static Result<std::unique_ptr<LevelSet>> create(std::shared_ptr<const Volume> source,
                                                  const Parameters& parameters, ExecutorKind kind,
                                                  const ExecutorOptions& options, History& history);

  [[nodiscard]] const Executor& executor() const { return *executor_; }
  [[nodiscard]] Executor& executor() { return *executor_; }
  [[nodiscard]] const Parameters& parameters() const { return executor_->parameters(); }
  [[nodiscard]] const std::shared_ptr<const Volume>& source() const { return source_; }
  [[nodiscard]] std::int64_t step() const { return step_; }  // since the start
  [[nodiscard]] bool begun() const;                          // there is a surface to steer
  // Everything since the start, for export and replay.
  [[nodiscard]] const Recipe& recipe() const { return recipe_; }

  // Each of these is an entry of the history that undo takes back. Edits with the same `gesture` (not 0: one
  // drag of a slider, one stroke of a brush), with whatever was computed between them, are one entry.
  Status begin(const Start& start, const Progress& progress = {});
  Status paint(const Sphere& sphere, Brush brush, std::uint64_t gesture = 0);
  Status set_parameters(const Parameters& parameters, std::uint64_t gesture = 0);
  // Steps, one after the other, are one entry until another edit or end_run().
  Result<AdvanceReport> advance(const Advance& run);
  void end_run();

  // Back to where the level set was `steps` steps ago, from the nearest checkpoint, by computing again:
  // the same voxels. At most to the start. An entry of its own.
  Status step_back(std::int64_t steps, const Progress& progress = {});
  // Back to the start as it was before the first step, with the present parameters. An entry of its own.
  Status restart();

  // Goes on with another executor, or with another source on the same grid (a smoothed one), from the same
  // phi.
  Status change_executor(ExecutorKind kind, const ExecutorOptions& options);
  Status change_source(std::shared_ptr<const Volume> source);
  // After the graphics context was lost: a new executor on options.device, from the last checkpoint.
  Status rebuild(const ExecutorOptions& options);

  // phi for whoever saves or measures. Counts as a checkpoint (rebuild(), step_back()).
  Result<std::shared_ptr<const Field>> checkpoint();
};

}  // namespace tidemark
