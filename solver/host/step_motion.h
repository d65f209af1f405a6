// The way that the speed moves the surface in a step, voxel by voxel of a page.
#pragma once

#include "solver/model.h"

namespace tidemark::solver {

// Writes dt alpha D of the `valid` voxels from `first` on to a page of 8^3 values, and 0 to its padding.
void fill_data_motion(const SpeedFunction& speed, const StepConstants<double>& constants, Index3 first,
                      Index3 valid, float* motion);
// The same of dt v / h, axis by axis: three pages one after the other.
void fill_advection(const SpeedFunction& speed, const StepConstants<double>& constants, Index3 first,
                    Index3 valid, float* motion);

}  // namespace tidemark::solver
