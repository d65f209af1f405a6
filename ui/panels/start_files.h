// Starts that lie in files.
#pragma once

#include <filesystem>

#include "core/progress.h"
#include "document/start.h"

namespace tidemark::ui {

enum class StartFile { mask, level_set };

// A mask (voxels other than 0 are inside), or a saved phi, on the grid of the study; the file's axes may be
// in another order or run the other way. Fails (ErrorKind::input) when the file cannot be read or has other
// voxels. `band`: W of the level set that is to begin.
Result<document::Start> load_start(StartFile kind, const std::filesystem::path& path, const Geometry& grid,
                                   double band, const Progress& progress = {});

}  // namespace tidemark::ui
