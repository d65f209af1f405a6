#include "solver/host/page_constraints.h"

#include <algorithm>
#include <cmath>

namespace tidemark::solver {

bool constrain(const Constraint* constraints, float* phi) {
  bool changed = false;
  for (int i = 0; i < kPageVoxels; ++i) {
    const float held = limited(constraints[i], phi[i]);
    changed = changed || held != phi[i];
    phi[i] = held;
  }
  return changed;
}

void measure_again(const PageInfo& info, const float* before, const float* phi, float near,
                   PageResult& result) {
  result.largest_change = result.content = 0.0F;
  result.near_voxels = 0;
  for (int i = 0; i < kPageVoxels; ++i) {
    const bool padding = (info.padding >> (i / kPageSide) & 1U) != 0 || i % kPageSide >= info.valid[0];
    if (padding) continue;
    result.content += std::clamp(phi[i], -near, near) + near;
    if (std::abs(phi[i]) > near) continue;
    const float change = std::abs(phi[i] - before[i]);
    result.largest_change = std::max(result.largest_change, change);
    ++result.near_voxels;
  }
}

}  // namespace tidemark::solver
