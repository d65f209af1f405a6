// Walls and anchors in the pages of the host executor.
#pragma once

#include "solver/host/page_kernel.h"

namespace tidemark::solver {

// Takes a page's values to their limits. Returns whether a value changed.
bool constrain(const Constraint* constraints, float* phi);

// The same measures of a page whose values were limited after its kernel had taken them: over all its voxels.
// `before` is phi two steps ago.
void measure_again(const PageInfo& info, const float* before, const float* phi, float near,
                   PageResult& result);

}  // namespace tidemark::solver
