// Masks and fields that come from files, brought onto the grid of the volume that is segmented.
#pragma once

#include <string>
#include <vector>

#include "core/geometry.h"
#include "core/result.h"
#include "core/volume.h"

namespace tidemark::imaging {

// The mask, or a volume's values, in the voxel order of `grid`. Both grids must have the same voxels; their
// axes may be permuted or run the other way, as they often do between programs. Fails (ErrorKind::input)
// naming `what` (the file) and both grids when the voxels are not the same ones.
Result<Mask> onto_grid(Mask mask, const Geometry& grid, const std::string& what);
Result<std::vector<float>> onto_grid(const Volume& volume, const Geometry& grid, const std::string& what);

// For messages: "512 x 512 x 60 voxels of 0.7 x 0.7 x 3 mm".
[[nodiscard]] std::string describe(const Geometry& grid);

}  // namespace tidemark::imaging
