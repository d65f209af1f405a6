#include "solver/host/tile.h"

#include <algorithm>
#include <bit>

namespace tidemark {
namespace {

constexpr int neighbour(int dx, int dy, int dz) {
  return (dx + 1) + 3 * (dy + 1) + 9 * (dz + 1);
}

constexpr int kFaceNeighbours[] = {neighbour(-1, 0, 0), neighbour(1, 0, 0),  neighbour(0, -1, 0),
                                   neighbour(0, 1, 0),  neighbour(0, 0, -1), neighbour(0, 0, 1)};

// The local coordinates that an axis of a page's apron may use: -1..8, less at the volume's border.
struct Span {
  int low;
  int high;

  Span(PhysicalPage before, PhysicalPage after, int valid)
      : low(before == kNoPage ? 0 : -1), high(after == kNoPage ? valid - 1 : kPageSide) {}

  [[nodiscard]] int clamp(int local) const { return std::clamp(local, low, high); }
};

Span y_span(const PageInfo& info) {
  return {info.neighbours[neighbour(0, -1, 0)], info.neighbours[neighbour(0, 1, 0)], info.valid[1]};
}

Span z_span(const PageInfo& info) {
  return {info.neighbours[neighbour(0, 0, -1)], info.neighbours[neighbour(0, 0, 1)], info.valid[2]};
}

// Which of the three pages along an axis a local coordinate in -1..8 is in.
int page_step(int local) {
  return local < 0 ? -1 : local >= kPageSide ? 1 : 0;
}

// Constant rows of a column of pages (dy, dz) with the voxels beside them along x.
struct ConstantRows {
  Rows inside;
  Rows outside;
};

ConstantRows constant_rows(const PagePool& pool, int buffer, const PageInfo& info, int dy, int dz) {
  const RowMasks& centre = pool.masks(buffer, info.neighbours[neighbour(0, dy, dz)]);
  ConstantRows rows{centre.inside, centre.outside};
  if (const PhysicalPage left = info.neighbours[neighbour(-1, dy, dz)]; left != kNoPage) {
    rows.inside &= pool.masks(buffer, left).inside_last;
    rows.outside &= pool.masks(buffer, left).outside_last;
  }
  if (const PhysicalPage right = info.neighbours[neighbour(1, dy, dz)]; right != kNoPage) {
    rows.inside &= pool.masks(buffer, right).inside_first;
    rows.outside &= pool.masks(buffer, right).outside_first;
  }
  return rows;
}

// The bits of a slice for y = -1..8, as bits 0..9.
unsigned apron_bits(Rows below, Rows page, Rows above, int local_z, const Span& y) {
  const auto byte = [&](Rows rows) { return static_cast<unsigned>(rows >> (8 * local_z)) & 0xffU; };
  unsigned bits = byte(page) << 1U;
  bits |= y.low < 0 ? byte(below) >> 7U : byte(page) & 1U;
  if (y.high == kPageSide) return bits | (byte(above) & 1U) << 9U;
  // Rows beyond the border repeat the last row.
  const unsigned last = 1U << static_cast<unsigned>(y.high + 1);
  const unsigned kept = (last << 1U) - 1U;
  return (bits & kept) | ((bits & last) != 0 ? ~kept & 0x3ffU : 0U);
}

// Bit y is set when bits y - 1, y and y + 1 of the page are (bits y, y + 1 and y + 2 of the apron).
unsigned all_three(unsigned apron) {
  return apron & (apron >> 1U) & (apron >> 2U);
}

}  // namespace

RowWork find_row_work(const PagePool& pool, int buffer, const PageInfo& info) {
  const Span y_range = y_span(info);
  const Span z_range = z_span(info);
  ConstantRows columns[3][3];  // [dz + 1][dy + 1]
  for (int dz = z_range.low < 0 ? -1 : 0; dz <= (z_range.high == kPageSide ? 1 : 0); ++dz) {
    for (int dy = y_range.low < 0 ? -1 : 0; dy <= (y_range.high == kPageSide ? 1 : 0); ++dy) {
      columns[dz + 1][dy + 1] = constant_rows(pool, buffer, info, dy, dz);
    }
  }
  unsigned inside[Tile::kSide];
  unsigned outside[Tile::kSide];
  for (int z = -1; z <= kPageSide; ++z) {
    const int from = z_range.clamp(z);
    const ConstantRows* column = columns[page_step(from) + 1];
    const int local = from & 7;
    inside[z + 1] =
        all_three(apron_bits(column[0].inside, column[1].inside, column[2].inside, local, y_range));
    outside[z + 1] =
        all_three(apron_bits(column[0].outside, column[1].outside, column[2].outside, local, y_range));
  }
  RowWork work;
  for (int z = 0; z < kPageSide; ++z) {
    const Rows stays_inside = inside[z] & inside[z + 1] & inside[z + 2] & 0xffU;
    const Rows stays_outside = outside[z] & outside[z + 1] & outside[z + 2] & 0xffU;
    work.inside |= stays_inside << (8 * z);
    work.outside |= stays_outside << (8 * z);
  }
  work.inside &= ~info.padding;
  work.outside &= ~info.padding;
  work.compute = ~(work.inside | work.outside | info.padding);
  return work;
}

bool at_border(const PageInfo& info) {
  return std::any_of(std::begin(kFaceNeighbours), std::end(kFaceNeighbours),
                     [&](int n) { return info.neighbours[n] == kNoPage; });
}

unsigned slices_read(Rows rows) {
  unsigned slices = 0;
  for (unsigned z = 0; z < kPageSide; ++z) {
    if ((rows >> (8 * z) & 0xffU) != 0) slices |= 7U << z;
  }
  return slices;
}

void gather_at_border(const PagePool& pool, int buffer, const PageInfo& info, unsigned slices, Tile& tile) {
  const Span y_range = y_span(info);
  const Span z_range = z_span(info);
  const int width = info.valid[0];
  for (; slices != 0; slices &= slices - 1) {
    const int z = std::countr_zero(slices) - 1;
    const int from_z = z_range.clamp(z);
    for (int y = -1; y <= kPageSide; ++y) {
      const int from_y = y_range.clamp(y);
      const PageRow from = page_row(pool, buffer, info, page_step(from_y), page_step(from_z));
      const int offset = ((from_z & 7) * kPageSide + (from_y & 7)) * kPageSide;
      float row[kPageSide + 2];  // x = -1..8
      std::copy_n(from.page + offset, width, row + 1);
      std::fill(row + 1 + width, std::end(row), row[width]);
      row[0] = from.before == nullptr ? row[1] : from.before[offset + kPageSide - 1];
      if (from.after != nullptr) row[kPageSide + 1] = from.after[offset];
      const int to = Tile::row(y, z);
      std::copy_n(row, kPageSide, tile.left + to);
      std::copy_n(row + 1, kPageSide, tile.centre + to);
      std::copy_n(row + 2, kPageSide, tile.right + to);
    }
  }
}

}  // namespace tidemark
