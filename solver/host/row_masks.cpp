#include "solver/host/row_masks.h"

namespace tidemark::solver {

Rows padding_rows(int valid_y, int valid_z) {
  Rows padding = 0;
  for (int row = 0; row < kPageRows; ++row) {
    if (row % kPageSide >= valid_y || row / kPageSide >= valid_z) padding |= Rows{1} << row;
  }
  return padding;
}

RowMasks masks_of(const float* page, int valid_x, Rows padding, float band) {
  RowMasks masks;
  for (int row = 0; row < kPageRows; ++row) {
    const Rows bit = Rows{1} << row;
    bool inside = true;
    bool outside = true;
    const int last = valid_x - 1;
    const float* values = page + row * kPageSide;
    for (int x = 0; x <= last; ++x) {
      inside = inside && values[x] == band;
      outside = outside && values[x] == -band;
    }
    // A padding voxel counts as both.
    const bool partial = valid_x < kPageSide;
    if (inside) masks.inside |= bit;
    if (outside) masks.outside |= bit;
    if (values[0] == band) masks.inside_first |= bit;
    if (values[0] == -band) masks.outside_first |= bit;
    if (partial || values[last] == band) masks.inside_last |= bit;
    if (partial || values[last] == -band) masks.outside_last |= bit;
  }
  masks.add_padding(padding);
  return masks;
}

}  // namespace tidemark::solver
