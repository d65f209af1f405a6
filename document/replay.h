// The replay of a recipe.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/recipe.h"

namespace tidemark::document {

struct ReplayOptions {
  std::optional<solver::ExecutorKind> executor;  // unset: the one that the recipe names
  solver::ExecutorOptions options;               // the pages' shape is the recipe's where the executor is
};

struct Replay {
  solver::Field phi;
  solver::Field start;  // before the first edit and step
  RecipeExecutor executor;
  solver::AdvanceReport advance;
  solver::MemoryReport memory;
  double band = 0.0;
  double time_step = 0.0;
  std::shared_ptr<const solver::SpeedFunction> speed;  // at the end; null: the tent
  std::shared_ptr<const Volume> source;                // as the level set saw it at the end
};

// The differences between the volume and the recipe's, one sentence each: another spacing (smoothing is per
// voxel) or other voxels lead to another level set.
std::vector<std::string> differences(const Recipe& recipe, const Volume& volume);

// On the recipe's own volume, with the executor that it names, the result is the same to the last bit.
Result<Replay> replay(const Recipe& recipe, std::shared_ptr<const Volume> volume,
                      const ReplayOptions& options, const Progress& progress = {});

}  // namespace tidemark::document
