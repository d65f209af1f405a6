// The agreement of two level sets of one grid.
#pragma once

#include <optional>

#include "core/progress.h"
#include "solver/field.h"

namespace tidemark::solver {

// Between two surfaces, both ways: from each crossing of a grid line with one of them to the nearest crossing
// with the other.
struct SurfaceDistance {
  double mean_mm = 0.0;
  double largest_mm = 0.0;  // the Hausdorff distance
};

struct SurfaceAgreement {
  double dice = 1.0;                        // 2 |A and B| / (|A| + |B|) of voxels inside; 1: both are empty
  std::optional<SurfaceDistance> distance;  // unset: one of them has no surface
};

// Their pages may differ in shape. Fails (ErrorKind::usage) when the grids differ, (ErrorKind::cancelled).
Result<SurfaceAgreement> agreement(const Field& a, const Field& b, const Progress& progress = {});

}  // namespace tidemark::solver
