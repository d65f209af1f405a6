// phi around one voxel, for values under a cursor.
#pragma once

#include "solver/field.h"
#include "solver/parameters.h"

namespace tidemark::solver {

struct VoxelValues {
  double phi = 0.0;        // smallest voxel spacings, > 0 inside
  double gradient = 0.0;   // |grad phi| by central differences; 0 where phi is clamped
  double curvature = 0.0;  // kappa per smallest spacing, < 0 on a ball; 0 where phi is clamped
};

// The voxel must lie inside of phi's grid.
VoxelValues values_at(const Field& phi, Index3 voxel);
// D(I) of one value: the tent of the parameters (eq. 7).
double data_speed(const Parameters& parameters, double intensity);

}  // namespace tidemark::solver
