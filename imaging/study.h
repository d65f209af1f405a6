// The one way in: a DICOM folder, a DICOM file or a volume file, by its path.
#pragma once

#include <filesystem>
#include <string>

#include "core/progress.h"
#include "core/volume.h"
#include "imaging/series.h"

namespace tidemark {

// Lists the series under `path` (a folder is searched recursively). Fails (ErrorKind::input) when the path
// does not exist or holds nothing that looks like an image; a series that cannot be loaded is listed with
// its reason.
Result<Catalogue> find_series(const std::filesystem::path& path, const Progress& progress = {});

// Loads the series `uid` of `path`; an empty uid takes the only loadable series, or the one with the most
// voxels (said in Volume::changes). The volume is finite everywhere. Fails (ErrorKind::input) naming the
// file and the field at fault, or the UIDs to choose from when `uid` is not there.
Result<Volume> load_volume(const std::filesystem::path& path, const std::string& uid = {},
                           const Progress& progress = {});

// Loads a mask: every voxel that is not 0 is inside.
Result<Mask> load_mask(const std::filesystem::path& path, const Progress& progress = {});

}  // namespace tidemark
