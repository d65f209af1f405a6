// The voxels where a speed function lets the surface grow: D > 0.
#pragma once

#include "core/bit_mask.h"
#include "core/progress.h"
#include "core/result.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

// Of all voxels of the grid, which is the function's. No cache (CachedSpeed) is filled for it: a surface
// needs few of its pages. Fails (ErrorKind::cancelled).
Result<BitMask> growing_region(const SpeedFunction& function, const Geometry& grid, const Progress& progress);

}  // namespace tidemark::solver
