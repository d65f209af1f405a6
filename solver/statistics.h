// The measurements on a level set.
#pragma once

#include "solver/field.h"

namespace tidemark::solver {

struct SurfaceStatistics {
  std::int64_t voxels_inside = 0;  // phi > 0
  double volume_ml = 0.0;          // inside phi = 0, at sub-voxel precision
  double surface_mm2 = 0.0;        // area of phi = 0 at sub-voxel precision, without the volume's own border
};

SurfaceStatistics measure(const Field& phi);

}  // namespace tidemark::solver
