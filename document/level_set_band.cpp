// Another band: the level set begins again, because phi is clamped to it from the start on.
#include <utility>

#include "document/level_set.h"

namespace tidemark::document {

// phi before the first step, made anew from the recipe with those parameters.
Result<solver::Field> LevelSet::start_with(const solver::Parameters& parameters) {
  if (recipe_.smoothed_mm != smoothed_mm()) {
    TIDEMARK_TRY(setup_.smooth_source(recipe_.smoothed_mm));
  }
  TIDEMARK_TRY(setup_.prepare(parameters));
  if (!begun()) return executor().snapshot();
  auto phi = setup_.begin(recipe_.start, {});
  if (!phi) return phi;
  for (const RecipeEvent& event : recipe_.events) {
    if (event.step > 0) break;
    if (!std::holds_alternative<PaintEvent>(event.what)) continue;
    TIDEMARK_TRY(setup_.apply(event));
  }
  return executor().snapshot();
}

Status LevelSet::begin_again_with(const solver::Parameters& parameters) {
  TIDEMARK_TRY(history_.close());
  Point before = known_;
  Point point{recipe_.up_to(0), nullptr, nullptr, {}, drive_};
  settle_start(point.recipe);
  point.recipe.parameters = parameters;
  point.recipe.drive = setup_.drive();
  auto phi = start_with(parameters);
  if (!phi) {
    TIDEMARK_TRY(go_to(before));
    return pass_on(phi);
  }
  point.phi = point.start = std::make_shared<const solver::Field>(std::move(*phi));
  TIDEMARK_TRY(go_to(std::move(point)));
  enter(ChangeKind::parameters, std::move(before));
  return {};
}

}  // namespace tidemark::document
