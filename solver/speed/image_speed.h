// The contents of a map for the speed function `image`, by its values.
#pragma once

#include "core/volume.h"

namespace tidemark::solver {

// Whether the map is a speed: any value is below 0 by more than rounding. Else it is a probability.
[[nodiscard]] bool holds_speed(const Volume& map);

}  // namespace tidemark::solver
