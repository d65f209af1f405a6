// Margins around regions, in mm.
#pragma once

#include "core/progress.h"
#include "core/region.h"

namespace tidemark::imaging {

// The widest margin, mm.
inline constexpr double kWidestMargin = 100.0;

// The voxels whose centre is at most so far from the centre of a voxel of the region, mm >= 0, within the
// grid. Exact, whatever the spacings. Fails (ErrorKind::usage) beyond kWidestMargin, (ErrorKind::cancelled).
Result<Region> grown(const Region& region, const Geometry& grid, double mm, const Progress& progress = {});

// The voxels whose centre is farther than that from the centre of every voxel beside the region. What lies
// beyond the grid is not known, and takes nothing away. Fails as grown() does.
Result<Region> shrunk(const Region& region, const Geometry& grid, double mm, const Progress& progress = {});

}  // namespace tidemark::imaging
