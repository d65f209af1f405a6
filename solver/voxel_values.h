// The terms of the level set at one voxel, for values under a cursor.
#pragma once

#include "solver/field.h"
#include "solver/parameters.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

struct VoxelValues {
  double intensity = 0.0;  // I, in the source's units
  double speed = 0.0;      // D
  double phi = 0.0;        // smallest voxel spacings, > 0 inside
  double gradient = 0.0;   // |grad phi| by central differences; 0 where phi is clamped
  double curvature = 0.0;  // kappa per smallest spacing, < 0 on a ball; 0 where phi is clamped
};

// `source` and `speed` are the level set's; the voxel must lie inside of it.
VoxelValues values_at(const Field& phi, const Volume& source, const SpeedFunction& speed, Index3 voxel);
// D of one voxel.
double speed_at(const SpeedFunction& speed, Index3 voxel);
// The tent of one value (eq. 7).
double data_speed(const Parameters& parameters, double intensity);

}  // namespace tidemark::solver
