// The inside of a surface as a region.
#pragma once

#include "core/region.h"
#include "solver/field.h"

namespace tidemark::solver {

// The voxels with phi > 0, with room for the box around them.
[[nodiscard]] Region inside_region(const Field& phi);

// The smallest box around the voxels with phi > 0; empty where there are none. Of the pages it looks into
// those that reach beyond what it has found: quick enough for every picture.
[[nodiscard]] VoxelRange inside_bounds(const Field& phi);

}  // namespace tidemark::solver
