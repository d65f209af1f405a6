// A page with its apron, gathered so that the stencil finds its neighbours at fixed distances.
#pragma once

#include <cstddef>

#include "solver/host/host_fields.h"
#include "solver/host/row_masks.h"

namespace tidemark::solver {

// phi at (x, y, z), x in 0..7, y and z in -1..8, is centre[row(y, z) + x]; dx holds phi(x + 1) - phi(x - 1)
// at the same place, but not at the edges of the apron, which nobody reads. `left` and `right` hold the
// values one voxel to the left and to the right of the page's own voxels, in their order. Rows follow each
// other without a gap, so that a vector may hold several of them, and every operand of the stencil is one
// load.
struct Tile {
  static constexpr int kSide = kPageSide + 2;
  static constexpr int kRowStride = kPageSide;
  static constexpr int kSliceStride = kSide * kRowStride;
  static constexpr int kFirst = 8;  // row (0, z) begins a cache line

  static constexpr int row(int y, int z) { return (z + 1) * kSliceStride + (y + 1) * kRowStride + kFirst; }
  // The same for row y + kPageSide * z of the page.
  static constexpr std::size_t row(std::size_t number) {
    return number * kRowStride + number / kPageSide * (kSliceStride - kPageSide * kRowStride) + row(0, 0);
  }

  using Values = float[kSide * kSliceStride + 2 * kFirst];
  alignas(64) Values centre;
  alignas(64) Values dx;
  alignas(64) float left[kPageVoxels];
  alignas(64) float right[kPageVoxels];
};

// The rows of a page that may change in the next step, and what the others are.
struct RowWork {
  Rows compute = 0;
  Rows inside = 0;   // stays W
  Rows outside = 0;  // stays -W
};

// A row stays as it is when it and the eight rows around it are all W or all -W, and so are the voxels of the
// neighbouring pages that touch them.
RowWork find_row_work(const HostFields& fields, int buffer, const PageInfo& info);

// Rows of three pages side by side along x.
struct PageRow {
  const float* before;
  const float* page;
  const float* after;
};

// The pages at (dy, dz) beside a page; null where the volume ends.
inline PageRow page_row(const HostFields& fields, int buffer, const PageInfo& info, int dy, int dz) {
  const PhysicalPage* pages = info.neighbours + neighbour_number(0, dy, dz);
  const auto values = [&](PhysicalPage page) { return page == kNoPage ? nullptr : fields.phi(buffer, page); };
  return {values(pages[-1]), values(pages[0]), values(pages[1])};
}

// Whether the volume ends at a face of the page.
bool at_border(const PageInfo& info);

// The slices of the tile, bit z + 1 for slice z, that computing `rows` reads.
unsigned slices_read(Rows rows);

// Gathers those slices of a page; at the volume's border the index is clamped (Neumann). The kernels gather
// pages inside the volume by themselves where a vector is as long as a row.
void gather(const HostFields& fields, int buffer, const PageInfo& info, unsigned slices, Tile& tile);

}  // namespace tidemark::solver
