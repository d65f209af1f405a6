#include "solver/host/tile.h"

#include <algorithm>
#include <bit>

namespace tidemark::solver {
namespace {

// The local coordinates that an axis of a page's apron may use: -1..8, less at the volume's border.
struct Span {
  int low;
  int high;

  Span(PhysicalPage before, PhysicalPage after, int valid)
      : low(before == kNoPage ? 0 : -1), high(after == kNoPage ? valid - 1 : kPageSide) {}

  [[nodiscard]] int clamp(int local) const { return std::clamp(local, low, high); }
};

Span y_span(const PageInfo& info) {
  return {info.neighbours[neighbour_number(0, -1, 0)], info.neighbours[neighbour_number(0, 1, 0)],
          info.valid[1]};
}

Span z_span(const PageInfo& info) {
  return {info.neighbours[neighbour_number(0, 0, -1)], info.neighbours[neighbour_number(0, 0, 1)],
          info.valid[2]};
}

// Which of the three pages along an axis a local coordinate in -1..8 is in.
int page_step(int local) {
  return local < 0 ? -1 : local >= kPageSide ? 1 : 0;
}

// Rows of the pages at (dy, dz) that are constant together with the voxels beside them along x.
struct ConstantRows {
  Rows inside;
  Rows outside;
};

ConstantRows constant_rows(const HostFields& fields, int buffer, const PhysicalPage* pages) {
  const RowMasks& centre = fields.masks(buffer, pages[0]);
  ConstantRows rows{centre.inside, centre.outside};
  if (pages[-1] != kNoPage) {
    rows.inside &= fields.masks(buffer, pages[-1]).inside_last;
    rows.outside &= fields.masks(buffer, pages[-1]).outside_last;
  }
  if (pages[1] != kNoPage) {
    rows.inside &= fields.masks(buffer, pages[1]).inside_first;
    rows.outside &= fields.masks(buffer, pages[1]).outside_first;
  }
  return rows;
}

// Row y is kept where the rows y - 1, y and y + 1 are set; `below` and `above` are the pages at y - 1 and y
// + 1.
Rows three_along_y(Rows below, Rows page, Rows above) {
  constexpr Rows kLowY = 0x0101010101010101U;
  const Rows before = (page & ~(kLowY << 7U)) << 1U | (below >> 7U & kLowY);
  const Rows after = (page >> 1U & ~(kLowY << 7U)) | (above & kLowY) << 7U;
  return page & before & after;
}

Rows three_along_z(Rows below, Rows page, Rows above) {
  return page & (page << 8U | below >> 56U) & (page >> 8U | above << 56U);
}

// The constant rows of the three columns at dz whose neighbours along y are constant, too.
ConstantRows constant_slices(const HostFields& fields, int buffer, const PhysicalPage* pages) {
  const ConstantRows page = constant_rows(fields, buffer, pages);
  // The volume's last row stands for the one beyond it.
  ConstantRows below{page.inside << 7U, page.outside << 7U};
  ConstantRows above{page.inside >> 7U, page.outside >> 7U};
  if (pages[-3] != kNoPage) below = constant_rows(fields, buffer, pages - 3);
  if (pages[3] != kNoPage) above = constant_rows(fields, buffer, pages + 3);
  return {three_along_y(below.inside, page.inside, above.inside),
          three_along_y(below.outside, page.outside, above.outside)};
}

// Whether a row is one of the page's own.
bool is_own(int y, int z) {
  return y >= 0 && y < kPageSide && z >= 0 && z < kPageSide;
}

// Copies the row (y, z), at `offset` in its page, and what is to its left and right into the tile. What was
// just written is not read again: the processor cannot forward parts of several stores to one load.
void gather_row(const PageRow& from, int offset, Tile& tile, int y, int z) {
  constexpr int kLast = kPageSide - 1;
  const float* row = from.page + offset;
  // NOLINTNEXTLINE(clang-analyzer-core.NullDereference): a page that is read is there
  const float before = from.before != nullptr ? from.before[offset + kLast] : row[0];
  const float after = from.after != nullptr ? from.after[offset] : row[kLast];
  const int to = Tile::row(y, z);
  std::copy_n(row, kPageSide, tile.centre + to);
  tile.dx[to] = row[1] - before;
  for (int x = 1; x < kLast; ++x) tile.dx[to + x] = row[x + 1] - row[x - 1];
  tile.dx[to + kLast] = after - row[kLast - 1];
  if (!is_own(y, z)) return;
  const int own = (y + kPageSide * z) * kPageSide;
  tile.left[own] = before;
  std::copy_n(row, kLast, tile.left + own + 1);
  std::copy_n(row + 1, kLast, tile.right + own);
  tile.right[own + kLast] = after;
}

// The same for a row of which the volume has only `width` voxels.
void gather_short_row(const PageRow& from, int offset, int width, Tile& tile, int y, int z) {
  float row[kPageSide + 2];  // x = -1..8
  std::copy_n(from.page + offset, width, row + 1);
  std::fill(row + 1 + width, std::end(row), row[width]);
  row[0] = from.before == nullptr ? row[1] : from.before[offset + kPageSide - 1];
  const int to = Tile::row(y, z);
  std::copy_n(row + 1, kPageSide, tile.centre + to);
  for (int x = 0; x < kPageSide; ++x) tile.dx[to + x] = row[x + 2] - row[x];
  if (!is_own(y, z)) return;
  const int own = (y + kPageSide * z) * kPageSide;
  std::copy_n(row, kPageSide, tile.left + own);
  std::copy_n(row + 2, kPageSide, tile.right + own);
}

}  // namespace

RowWork find_row_work(const HostFields& fields, int buffer, const PageInfo& info) {
  const PhysicalPage* pages = info.neighbours + kItself;
  const ConstantRows page = constant_slices(fields, buffer, pages);
  ConstantRows below{page.inside << 56U, page.outside << 56U};
  ConstantRows above{page.inside >> 56U, page.outside >> 56U};
  if (pages[-9] != kNoPage) below = constant_slices(fields, buffer, pages - 9);
  if (pages[9] != kNoPage) above = constant_slices(fields, buffer, pages + 9);
  RowWork work;
  work.inside = three_along_z(below.inside, page.inside, above.inside) & ~info.padding;
  work.outside = three_along_z(below.outside, page.outside, above.outside) & ~info.padding;
  work.compute = ~(work.inside | work.outside | info.padding);
  return work;
}

bool at_border(const PageInfo& info) {
  for (int face = 0; face < kFaces; ++face) {
    if (info.neighbours[face_neighbour(face)] == kNoPage) return true;
  }
  return false;
}

unsigned slices_read(Rows rows) {
  unsigned slices = 0;
  for (unsigned z = 0; z < kPageSide; ++z) {
    if ((rows >> (8 * z) & 0xffU) != 0) slices |= 7U << z;
  }
  return slices;
}

void gather(const HostFields& fields, int buffer, const PageInfo& info, unsigned slices, Tile& tile) {
  const Span y_range = y_span(info);
  const Span z_range = z_span(info);
  const int width = info.valid[0];
  for (; slices != 0; slices &= slices - 1) {
    const int z = std::countr_zero(slices) - 1;
    const int from_z = z_range.clamp(z);
    for (int y = -1; y <= kPageSide; ++y) {
      const int from_y = y_range.clamp(y);
      const PageRow from = page_row(fields, buffer, info, page_step(from_y), page_step(from_z));
      const int offset = ((from_z & 7) * kPageSide + (from_y & 7)) * kPageSide;
      if (width == kPageSide) {
        gather_row(from, offset, tile, y, z);
      } else {
        gather_short_row(from, offset, width, tile, y, z);
      }
    }
  }
}

}  // namespace tidemark::solver
