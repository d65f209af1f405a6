// A page with its apron, gathered so that the stencil finds its neighbours at fixed distances.
#pragma once

#include <cstring>

#include "solver/host/page_pool.h"
#include "solver/host/row_masks.h"

namespace tidemark {

// phi at (x, y, z), x in 0..7, y and z in -1..8, is centre[row(y, z) + x]; `left` and `right` hold the values
// one voxel to the left and to the right at the same place. Rows follow each other without a gap, so that a
// vector may hold several of them, and every operand of the stencil is one load.
struct Tile {
  static constexpr int kSide = kPageSide + 2;
  static constexpr int kRowStride = kPageSide;
  static constexpr int kSliceStride = kSide * kRowStride;
  static constexpr int kFirst = 8;  // row (0, z) begins a cache line

  static constexpr int row(int y, int z) { return (z + 1) * kSliceStride + (y + 1) * kRowStride + kFirst; }

  using Values = float[kSide * kSliceStride + 2 * kFirst];
  alignas(64) Values left;
  alignas(64) Values centre;
  alignas(64) Values right;
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

// Rows of three pages side by side along x.
struct PageRow {
  const float* before;
  const float* page;
  const float* after;
};

// Copies a row, at `offset` in its page, and what is to its left and right into the tile.
inline void gather_row(const PageRow& from, int offset, Tile& tile, int to) {
  constexpr int kLast = kPageSide - 1;
  const float* row = from.page + offset;
  std::memcpy(tile.centre + to, row, sizeof(float) * kPageSide);
  std::memcpy(tile.left + to + 1, row, sizeof(float) * kLast);
  tile.left[to] = from.before != nullptr ? from.before[offset + kLast] : row[0];
  std::memcpy(tile.right + to, row + 1, sizeof(float) * kLast);
  tile.right[to + kLast] = from.after != nullptr ? from.after[offset] : row[kLast];
}

// The pages at (dy, dz) beside a page; null where the volume ends.
inline PageRow page_row(const PagePool& pool, int buffer, const PageInfo& info, int dy, int dz) {
  const PhysicalPage* pages = info.neighbours + 13 + 3 * dy + 9 * dz;
  const auto values = [&](PhysicalPage page) { return page == kNoPage ? nullptr : pool.phi(buffer, page); };
  return {values(pages[-1]), values(pages[0]), values(pages[1])};
}

// Whether the volume ends at a face of the page.
bool at_border(const PageInfo& info);

// The slices of the tile, bit z + 1 for slice z, that computing `rows` reads.
unsigned slices_read(Rows rows);

// Gathers those slices of a page at the volume's border; the index is clamped there (Neumann). The kernels
// gather the other pages by themselves.
void gather_at_border(const PagePool& pool, int buffer, const PageInfo& info, unsigned slices, Tile& tile);

}  // namespace tidemark
