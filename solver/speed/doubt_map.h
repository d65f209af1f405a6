// The doubt of a speed function as a map of its own, for views.
#pragma once

#include <memory>

#include "solver/speed/speed_function.h"

namespace tidemark::solver {

// In bits: 0 where the probability p is 0 or 1, 1 where it is a half.
[[nodiscard]] double entropy(double p);

// Its "speed" is the doubt. Null where the function has none.
[[nodiscard]] std::shared_ptr<const SpeedFunction> doubt_map(std::shared_ptr<const SpeedFunction> function);

}  // namespace tidemark::solver
