// A recipe carried out on its study, as a case to go on with.
#pragma once

#include <memory>

#include "core/progress.h"
#include "document/recipe.h"
#include "document/session_contents.h"

namespace tidemark::document {

// The contents of a case at the end of the recipe, whose images and maps have their voxels. The surface is
// that of the recipe to the last bit where differences() finds none. Fails as evolve() does.
Result<SessionContents> replay(Recipe recipe, const std::shared_ptr<const Volume>& volume, StudyOrigin origin,
                               const Progress& progress = {});

}  // namespace tidemark::document
