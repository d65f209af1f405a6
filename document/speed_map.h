// Maps for the speed function `image`, read from files.
#pragma once

#include <filesystem>
#include <memory>

#include "core/progress.h"
#include "document/drive.h"

namespace tidemark::document {

// A map on the voxels of `grid`; the file's axes may be in another order or run the other way. Fails
// (ErrorKind::input) naming the file when it cannot be read or has other voxels.
Result<std::shared_ptr<const SpeedMap>> load_speed_map(const std::filesystem::path& file,
                                                       const Geometry& grid, const Progress& progress = {});

}  // namespace tidemark::document
