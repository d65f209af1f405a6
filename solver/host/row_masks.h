// The rows of a page that are clamped constants, one bit a row.
//
// A page of 8^3 voxels has 64 rows of 8; row (y, z) is bit y + 8 z. About half of the rows in resident pages
// are +W or -W throughout and so are their neighbours: they need not be computed, and with bits for rows that
// is found out for a whole page in some hundred instructions (paper section 7: a band narrower than a page).
#pragma once

#include <cstdint>

#include "solver/paging/page_neighbours.h"

namespace tidemark::solver {

inline constexpr int kPageSide = 8;
inline constexpr int kPageRows = kPageSide * kPageSide;
inline constexpr int kPageVoxels = kPageRows * kPageSide;

using Rows = std::uint64_t;
inline constexpr Rows kAllRows = ~Rows{0};

// Rows whose voxels are all W (inside) or all -W (outside); the same for the first and the last voxel of each
// row alone, which is what the pages beside it along x see. Rows and voxels that are padding count as both.
struct RowMasks {
  // In pairs, which a compiler treats as vectors of two.
  Rows inside = 0, outside = 0;
  Rows inside_first = 0, outside_first = 0;
  Rows inside_last = 0, outside_last = 0;

  static constexpr RowMasks constant(bool is_inside) {
    RowMasks masks;
    if (is_inside) {
      masks.inside = masks.inside_first = masks.inside_last = kAllRows;
    } else {
      masks.outside = masks.outside_first = masks.outside_last = kAllRows;
    }
    return masks;
  }

  constexpr void add_padding(Rows padding) {
    inside |= padding;
    inside_first |= padding;
    inside_last |= padding;
    outside |= padding;
    outside_first |= padding;
    outside_last |= padding;
  }

  [[nodiscard]] bool all_inside() const { return inside == kAllRows; }
  [[nodiscard]] bool all_outside() const { return outside == kAllRows; }
};

// The rows of a page that are beyond the volume, of which it has so many voxels along y and z.
Rows padding_rows(int valid_y, int valid_z);
// Of the values of a page.
RowMasks masks_of(const float* page, int valid_x, Rows padding, float band);

// Whether every voxel on a face is W (is_inside) or -W.
constexpr bool face_is_constant(const RowMasks& masks, int face, bool is_inside) {
  constexpr Rows kLowY = 0x0101010101010101U;
  constexpr Rows kLowZ = 0xffU;
  constexpr Rows kFaceRows[kFaces] = {kAllRows, kAllRows, kLowY, kLowY << 7U, kLowZ, kLowZ << 56U};
  const Rows constant = face == 0   ? (is_inside ? masks.inside_first : masks.outside_first)
                        : face == 1 ? (is_inside ? masks.inside_last : masks.outside_last)
                                    : (is_inside ? masks.inside : masks.outside);
  return (constant & kFaceRows[face]) == kFaceRows[face];
}

}  // namespace tidemark::solver
