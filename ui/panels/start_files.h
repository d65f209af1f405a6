// Starts that lie in files.
#pragma once

#include <filesystem>

#include "core/progress.h"
#include "study/start.h"

namespace tidemark {

enum class StartFile { mask, level_set };

// A mask (what is not 0 is inside), or a phi that was saved, on the grid of the study. Fails
// (ErrorKind::input) when the file cannot be read or has another grid. `band`: W of the level set that is to
// begin.
Result<Start> load_start(StartFile kind, const std::filesystem::path& path, const Geometry& grid, double band,
                         const Progress& progress = {});

}  // namespace tidemark
