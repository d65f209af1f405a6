// Walls and anchors as JSON: the voxels that differ from those of the drive before, so that a stroke costs
// what it marks and not all that was marked before it.
#pragma once

#include <memory>

#include "core/json/json.h"
#include "core/json/json_field.h"
#include "solver/speed/constraints.h"

namespace tidemark::document {

// Adds the walls and anchors to a drive's JSON; null: there are none. `before`: those of the drive before it
// in the recipe, on the same grid. Where too many differ for a list, all are written, a bit for each voxel of
// the grid.
void add_constraints(Json& drive, const solver::Constraints* constraints, const solver::Constraints* before);

// Those of a drive's JSON; null: it has none. `before` as it was for writing; what is as before is shared
// with it. Errors are noted in the field's document. Memory is taken only for as many voxels as the file
// holds.
std::shared_ptr<const solver::Constraints> read_constraints(
    const JsonField& drive, Index3 grid_size, const std::shared_ptr<const solver::Constraints>& before);

}  // namespace tidemark::document
