// Blocks of values around a box of voxels, and weighted sums along their axes: what a speed function that
// looks around its voxels computes from.
#pragma once

#include <array>
#include <vector>

#include "core/volume.h"
#include "solver/speed/speed_function.h"

namespace tidemark::solver {

struct Block {
  VoxelBox box;               // may reach beyond the grid
  std::vector<float> values;  // x fastest
};

// A box with `by` more voxels on either side of each axis.
[[nodiscard]] inline VoxelBox grown(const VoxelBox& box, Index3 by) {
  return {box.first - by, box.size + by + by};
}

// The volume's values; beyond the grid that of the nearest voxel.
[[nodiscard]] Block values_in(const Volume& volume, const VoxelBox& box);

// weights[axis][d] belongs to the voxels at distance d on both sides.
using AxisWeights = std::array<std::vector<float>, 3>;
// The voxels that sums read on either side.
[[nodiscard]] Index3 reach_of(const AxisWeights& weights);
// The sums along all axes, for what is left of the block without the reach. Their order is the same wherever
// a voxel lies in the block, so that they have the same bits.
void sum_along_axes(Block& block, const AxisWeights& weights);

// The sums of all voxels up to the reach on either side, for what is left of the block without it.
void sum_boxes(Block& block, Index3 reach);

// Of a sampled, normalised Gaussian, cut at 3 sigma.
[[nodiscard]] AxisWeights gaussian_weights(const Geometry& geometry, double sigma_mm);

}  // namespace tidemark::solver
