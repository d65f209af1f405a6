// A page with its apron, gathered so that the stencil finds its neighbours at fixed distances.
#pragma once

#include "solver/host/page_pool.h"
#include "solver/host/row_masks.h"

namespace tidemark {

// phi at (x, y, z), each of x, y and z in -1..8, is values[row(y, z) + x]. A row takes one cache line, so
// that vectors of 8 that begin one voxel to the left or to the right do not cross a line.
struct Tile {
  static constexpr int kSide = kPageSide + 2;
  static constexpr int kRowStride = 16;
  static constexpr int kSliceStride = kSide * kRowStride;
  static constexpr int kFirst = 4;  // of a row's line

  static constexpr int row(int y, int z) { return (z + 1) * kSliceStride + (y + 1) * kRowStride + kFirst; }

  alignas(64) float values[kSide * kSliceStride];
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
