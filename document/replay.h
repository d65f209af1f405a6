// Does again what a recipe says.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "document/recipe.h"

namespace tidemark {

struct ReplayOptions {
  std::optional<ExecutorKind> executor;  // unset: the one that the recipe names
  ExecutorOptions options;               // the pages' shape is the recipe's where the executor is
};

struct Replay {
  Field phi;
  Field start;  // before the first edit and step
  RecipeExecutor executor;
  AdvanceReport advance;
  MemoryReport memory;
  double band = 0.0;
  double time_step = 0.0;
  std::shared_ptr<const Volume> source;  // as the level set saw it at the end
};

// What about the volume is not as it was when the recipe was made, one sentence each: a level set comes out
// differently where the spacing is another (its smoothing is per voxel) or the voxels are.
std::vector<std::string> differences(const Recipe& recipe, const Volume& volume);

// On the volume that it was made on, with the executor that it names: the same voxels as were seen.
Result<Replay> replay(const Recipe& recipe, std::shared_ptr<const Volume> volume,
                      const ReplayOptions& options, const Progress& progress = {});

}  // namespace tidemark
