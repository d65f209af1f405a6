// The files of a folder and of those in it.
#pragma once

#include <filesystem>
#include <vector>

#include "core/progress.h"
#include "core/result.h"

namespace tidemark {

struct FileListing {
  bool recursive = true;
  bool skip_denied = false;  // folders that may not be read; else the listing fails
};

// The regular files below a folder, sorted, so that results do not depend on the file system. Of a file:
// itself. Links to folders are not followed: they could lead in circles. Unfinished files of a killed program
// (see AtomicFile) are left out. Fails (ErrorKind::input) naming the path, or (ErrorKind::cancelled).
[[nodiscard]] Result<std::vector<std::filesystem::path>> files_below(const std::filesystem::path& path,
                                                                     const Progress& progress = {},
                                                                     FileListing listing = {});

}  // namespace tidemark
