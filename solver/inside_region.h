// The inside of a surface as a region.
#pragma once

#include "core/region.h"
#include "solver/field.h"

namespace tidemark::solver {

// The voxels with phi > 0, with room for the pages that have any.
[[nodiscard]] Region inside_region(const Field& phi);

}  // namespace tidemark::solver
