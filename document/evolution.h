// The evolution of a level set by a recipe, from its start to its end.
//
// The command line computes by nothing else: `replay` carries out a recipe that was recorded, `segment` one
// without events, until the surface rests. The desktop's LevelSet drives the same ExecutorSetup, edit by
// edit.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "document/coarse_levels.h"
#include "document/outcome.h"
#include "document/recipe.h"
#include "solver/statistics.h"

namespace tidemark::document {

struct EvolutionOptions {
  std::optional<solver::ExecutorKind> executor;  // for all of it; unset: those that the recipe names
  solver::ExecutorOptions options;               // the pages' shape is the recipe's where the executor is
  bool until_converged =
      false;  // after the last event: ends before the recipe's steps when the surface rests
  // Called before the first step, after every so many, and at the end, with how many steps have been
  // computed.
  std::int64_t watch_every = 0;  // 0: never
  std::function<Status(solver::Executor&, std::int64_t step)> watch = {};
};

// EvolutionOptions::watch_every for about so many calls, two or more, over that many steps.
[[nodiscard]] std::int64_t watch_every_for(std::int64_t calls, std::int64_t steps);

// A level set at the end of its evolution.
struct Evolution {
  solver::Field phi;
  solver::Field start;                 // before the first edit and step
  RecipeExecutor executor;             // of the first step
  std::vector<CoarseRun> coarse_runs;  // before that; empty: none
  solver::AdvanceReport advance;
  std::optional<glm::dvec3> moves_at;  // a place on the surface that still moved at the end, in voxels
  solver::MemoryReport memory;
  double band = 0.0;
  double time_step = 0.0;
  std::shared_ptr<const solver::SpeedFunction> speed;  // at the end; null: the tent
  std::shared_ptr<const Volume> source;                // as the level set saw it at the end
  solver::SurfaceStatistics surface;
  Outcome outcome = Outcome::unfinished;
  std::optional<double> wider_range;  // see outcome.h
};

// The differences between the volume and the recipe's, one sentence each: another spacing (smoothing is per
// voxel) or other voxels lead to another level set.
std::vector<std::string> differences(const Recipe& recipe, const Volume& volume);
// The first of them alone, for a recipe that was made for that spacing; empty: it is the same.
std::string spacing_difference(const glm::dvec3& then, const Volume& volume);

// On the recipe's own volume, with the executor that it names, the result is the same to the last bit.
Result<Evolution> evolve(const Recipe& recipe, std::shared_ptr<const Volume> volume,
                         const EvolutionOptions& options, const Progress& progress = {});

}  // namespace tidemark::document
