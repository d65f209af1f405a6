// The terms of the level set at one voxel, for values under a cursor.
#pragma once

#include "solver/field.h"
#include "solver/parameters.h"

namespace tidemark::solver {

struct VoxelValues {
  double intensity = 0.0;  // I, in the source's units
  double data = 0.0;       // D(I)
  double phi = 0.0;        // smallest voxel spacings, > 0 inside
  double gradient = 0.0;   // |grad phi| by central differences; 0 where phi is clamped
  double curvature = 0.0;  // kappa per smallest spacing, < 0 on a ball; 0 where phi is clamped
};

// `source` is the level set's source; the voxel must lie inside of it.
VoxelValues values_at(const Field& phi, const Volume& source, const Parameters& parameters, Index3 voxel);
// D(I) of one value (eq. 7).
double data_speed(const Parameters& parameters, double intensity);

}  // namespace tidemark::solver
