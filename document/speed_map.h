// Maps for the speed function `image`, read from files.
#pragma once

#include <filesystem>
#include <memory>

#include "core/progress.h"
#include "document/drive.h"

namespace tidemark::document {

// A map on the voxels of `grid`, with the file's frame of reference. A volume file has the same voxels; its
// axes may be in another order or run the other way. A DICOM parametric map or segmentation (as fractions) is
// placed by its geometry. Voxels that it does not cover have -1 where its values are a speed, else 0. Fails
// (ErrorKind::input) naming the file when it cannot be read, or does not fit.
Result<std::shared_ptr<const SpeedMap>> load_speed_map(const std::filesystem::path& file,
                                                       const Geometry& grid, const Progress& progress = {});

}  // namespace tidemark::document
