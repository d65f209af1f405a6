// The rows of voxels that a page holds.
#pragma once

#include "core/geometry.h"
#include "core/paging/page_layout.h"

namespace tidemark {

// Calls visit(voxel offset of the row, row length, index of its first value in the page) for each row.
template <class Visit>
void for_each_row(const Geometry& geometry, const PageLayout& layout, std::int64_t page, Visit visit) {
  const Index3 first = layout.first_voxel(page);
  const Index3 valid = layout.valid_shape(page);
  const Index3 shape = layout.page_shape();
  for (std::int64_t z = 0; z < valid.z; ++z) {
    for (std::int64_t y = 0; y < valid.y; ++y) {
      visit(geometry.offset(first + Index3(0, y, z)), valid.x, number_in(shape, Index3(0, y, z)));
    }
  }
}

}  // namespace tidemark
