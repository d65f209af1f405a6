// A film of an evolution: a view of it, from the start to the present step.
#pragma once

#include <filesystem>
#include <memory>

#include "core/progress.h"
#include "document/recipe.h"
#include "engine/picture_feed.h"
#include "renderer/picture.h"

namespace tidemark::engine {

// Computes the recipe again on the host executor, draws about sixty pictures by the processor on the way, and
// writes them as a GIF file that plays for ever. Labels are left out. Fails
// (ErrorKind::usage) where the recipe has no step, (ErrorKind::write), (ErrorKind::cancelled), or as
// document::evolve() does.
Status write_film(const document::Recipe& recipe, const std::shared_ptr<const Volume>& volume,
                  const AnyView& view, renderer::PictureSize size, const std::filesystem::path& file,
                  const Progress& progress);

}  // namespace tidemark::engine
