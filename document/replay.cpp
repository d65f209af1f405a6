#include "document/replay.h"

#include <utility>

#include "document/evolution.h"

namespace tidemark::document {

Result<SessionContents> replay(Recipe recipe, const std::shared_ptr<const Volume>& volume, StudyOrigin origin,
                               const Progress& progress) {
  auto evolution = evolve(recipe, volume, {}, progress);
  if (!evolution) return pass_on(evolution);
  SessionContents contents;
  contents.origin = std::move(origin);
  contents.geometry = volume->geometry;
  contents.recipe = std::move(recipe);
  contents.phi = std::make_shared<const solver::Field>(std::move(evolution->phi));
  return contents;
}

}  // namespace tidemark::document
