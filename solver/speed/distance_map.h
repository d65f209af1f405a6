// The signed distance to a mask's surface as a map for views.
#pragma once

#include <memory>

#include "solver/field.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

// Its "speed" is how far outside of the mask's surface a voxel lies, over `within`, from -1 to 1. `distance`
// is of distance_transform(); `within`, > 0 and at most its band, is in units of the smallest spacing.
[[nodiscard]] std::shared_ptr<const SpeedFunction> distance_map(Field distance, double within);

}  // namespace tidemark::solver
