// How far the data term moves the surface in a step, voxel by voxel of a page.
#pragma once

#include "core/volume.h"
#include "solver/model.h"

namespace tidemark::solver {

// Writes the `valid` voxels from `first` on to a page of 8^3 values, and 0 to its padding.
void fill_data_motion(const Volume& source, const StepConstants<double>& constants, Index3 first,
                      Index3 valid, float* motion);

}  // namespace tidemark::solver
