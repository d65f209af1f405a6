// Masks and fields that come from files, brought onto the grid of the volume that is segmented.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/geometry.h"
#include "core/result.h"
#include "core/volume.h"

namespace tidemark::cli {

// For each voxel of `to`, the offset of the voxel of `from` at the same place in the patient. The grids must
// have the same voxels; their axes may be permuted or run the other way, as they often do between programs.
// Fails (ErrorKind::input) naming `what` and both grids when the voxels are not the same ones.
Result<std::vector<std::int64_t>> matching_voxels(const Geometry& from, const Geometry& to,
                                                  const std::string& what);

// The mask, or phi's values, in the voxel order of `grid`; `what` names the file in errors.
Result<Mask> onto_grid(Mask mask, const Geometry& grid, const std::string& what);
Result<std::vector<float>> onto_grid(const Volume& volume, const Geometry& grid, const std::string& what);

}  // namespace tidemark::cli
