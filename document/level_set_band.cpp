// Another band: the level set begins again, because phi is clamped to it from the start on.
#include <utility>

#include "document/level_set.h"

namespace tidemark::document {

Status LevelSet::begin_again_with(const solver::Parameters& parameters) {
  TIDEMARK_TRY(history_.close());
  Point before = known_;
  Point point{recipe_.up_to(0), nullptr, nullptr, {}, drive_};
  settle_start(point.recipe);
  point.recipe.parameters = parameters;
  point.recipe.drive = setup_.drive();
  auto phi = played_start(point.recipe);
  if (!phi) {
    TIDEMARK_TRY(go_to(before));
    return pass_on(phi);
  }
  point.phi = point.start = std::move(*phi);
  TIDEMARK_TRY(go_to(std::move(point)));
  enter(ChangeKind::parameters, std::move(before));
  return {};
}

}  // namespace tidemark::document
