#include "document/evolution.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "document/checksum.h"
#include "document/executor_setup.h"
#include "solver/surface_places.h"

namespace tidemark::document {

std::int64_t watch_every_for(std::int64_t calls, std::int64_t steps) {
  const std::int64_t intervals = calls - 1;
  return std::max<std::int64_t>((steps + intervals / 2) / intervals, 1);
}

std::string spacing_difference(const glm::dvec3& then, const Volume& volume) {
  const glm::dvec3 now = volume.geometry.spacing_mm;
  bool same_spacing = true;
  for (int axis = 0; axis < 3; ++axis) {
    same_spacing = same_spacing && std::abs(then[axis] - now[axis]) <= 1e-3 * then[axis];
  }
  if (same_spacing) return {};
  return fmt::format(
      "the recipe was made for a spacing of {:.4g} x {:.4g} x {:.4g} mm, the volume "
      "has {:.4g} x {:.4g} x {:.4g}: the same alpha smooths differently",
      then.x, then.y, then.z, now.x, now.y, now.z);
}

std::vector<std::string> differences(const Recipe& recipe, const Volume& volume) {
  std::vector<std::string> found;
  std::string spacing = spacing_difference(recipe.source.spacing_mm, volume);
  if (!spacing.empty()) found.push_back(std::move(spacing));
  if (recipe.source.size != volume.geometry.size) {
    const Index3 size = recipe.source.size;
    found.push_back(
        fmt::format("the recipe was made on a volume of {} x {} x {} voxels", size.x, size.y, size.z));
  } else if (!recipe.source.checksum.empty() && recipe.source.checksum != checksum_of(volume)) {
    found.emplace_back("the recipe was made on a volume with other voxels");
  }
  return found;
}

namespace {

Status play(ExecutorSetup& setup, const Recipe& recipe, const EvolutionOptions& options,
            const Progress& progress, solver::AdvanceReport& total) {
  if (options.watch_every <= 0) {
    return setup.play(recipe, 0, 0, recipe.steps, progress, &total, options.until_converged);
  }
  TIDEMARK_TRY(options.watch(setup.executor(), 0));
  std::size_t event = 0;
  for (std::int64_t step = 0; step < recipe.steps;) {
    const std::int64_t target = std::min(step + options.watch_every, recipe.steps);
    TIDEMARK_TRY(
        setup.play(recipe, event, step, target, {nullptr, progress.stop}, &total, options.until_converged));
    while (event < recipe.events.size() && recipe.events[event].step <= target) ++event;
    const bool rests = total.steps < target;
    step = rests ? recipe.steps : target;
    TIDEMARK_TRY(options.watch(setup.executor(), total.steps));
    progress(static_cast<double>(step) / static_cast<double>(recipe.steps), "computing steps");
  }
  return {};
}

}  // namespace

Result<Evolution> evolve(const Recipe& recipe, std::shared_ptr<const Volume> volume,
                         const EvolutionOptions& options, const Progress& progress) {
  const solver::ExecutorKind recorded =
      solver::executor_named(recipe.executor.name).value_or(solver::ExecutorKind::host);
  const solver::ExecutorKind kind = options.executor.value_or(recorded);
  solver::ExecutorOptions executor_options = options.options;
  executor_options.skip_quiet_pages = executor_options.skip_quiet_pages && recipe.executor.skip_quiet_pages;
  if (kind == recorded) executor_options.page_shape = recipe.executor.page_shape;
  auto setup =
      ExecutorSetup::create(std::move(volume), recipe.smoothed_mm, recipe.parameters, kind, executor_options);
  if (!setup) return pass_on(setup);
  if (recipe.drive != nullptr) {
    TIDEMARK_TRY(setup->set_drive(recipe.drive, progress));
  }
  auto start = setup->begin(recipe.start, progress);
  if (!start) return pass_on(start);
  Evolution result;
  result.start = std::move(*start);
  result.coarse_runs = setup->coarse_runs();
  result.executor = setup->description();
  Recipe played = recipe;
  if (options.executor) played.set_executor(result.executor);
  TIDEMARK_TRY(play(*setup, played, options, progress, result.advance));
  auto phi = setup->executor().snapshot();
  if (!phi) return pass_on(phi);
  result.phi = std::move(*phi);
  auto moving = setup->executor().moving_pages();
  if (!moving) return pass_on(moving);
  constexpr double kFarApartMm = 1e6;  // one place will do
  const auto places = solver::surface_places_in(result.phi, *moving, kFarApartMm);
  if (!places.empty()) result.moves_at = places.front();
  result.memory = setup->executor().memory();
  result.band = setup->executor().band();
  result.time_step = setup->executor().time_step();
  result.source = setup->source();
  result.speed = setup->executor().speed();
  result.surface = solver::measure(result.phi);
  const EvolvedSurface evolved{result.phi,
                               result.surface.voxels_inside,
                               result.advance.steps,
                               result.advance.converged,
                               recipe.start.empty() ? nullptr : &result.start,  // else it was painted
                               *result.source,
                               recipe.final_parameters(),
                               result.speed.get(),
                               setup->executor().constraints().get()};
  result.outcome = outcome_of(evolved);
  result.wider_range = wider_range(evolved);
  return result;
}

}  // namespace tidemark::document
