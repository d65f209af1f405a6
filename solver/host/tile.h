// A page with its apron, gathered so that every load of the stencil is one aligned vector.
#pragma once

#include "solver/host/page_pool.h"
#include "solver/host/row_masks.h"

namespace tidemark {

// phi at (x, y, z), each of y and z in -1..8, is centre[row(y, z) + x] for x in 0..7; `left` holds the value
// at x - 1 and `right` the one at x + 1. Rows follow each other, so that a vector of 16 covers two.
struct Tile {
  static constexpr int kSide = kPageSide + 2;
  static constexpr int kFloats = kSide * kSide * kPageSide;
  static constexpr int kRowStride = kPageSide;
  static constexpr int kSliceStride = kSide * kPageSide;

  static constexpr int row(int y, int z) { return (z + 1) * kSliceStride + (y + 1) * kRowStride; }

  // Gathering writes whole rows one voxel off, so that a row spills into its neighbour's place.
  static constexpr int kSpill = 16;

  alignas(64) float left[kFloats + kSpill];
  alignas(64) float centre[kFloats];
  alignas(64) float right_storage[kSpill + kFloats];
  float* const right = right_storage + kSpill;
};

// The rows of a page that may change in the next step, and what the others are.
struct RowWork {
  Rows compute = 0;
  Rows inside = 0;   // stays W
  Rows outside = 0;  // stays -W
};

// A row stays as it is when it and the eight rows around it are all W or all -W, and so are the voxels of the
// neighbouring pages that touch them.
RowWork find_row_work(const PagePool& pool, int buffer, const PageInfo& info);

// Gathers what computing `rows` of a page reads. At the volume's border the index is clamped (Neumann).
void gather(const PagePool& pool, int buffer, const PageInfo& info, Rows rows, Tile& tile);

}  // namespace tidemark
