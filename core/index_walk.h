// Walks over the indices of a box, be they of voxels, pages or blocks.
#pragma once

#include "core/paging/page_layout.h"

namespace tidemark {

// Calls visit(index) for the indices from `first` up to `end`, which is not among them along any axis, x
// fastest, until it returns false. Returns whether it never did.
template <class Visit>
bool all_indices(Index3 first, Index3 end, Visit visit) {
  for (std::int64_t z = first.z; z < end.z; ++z) {
    for (std::int64_t y = first.y; y < end.y; ++y) {
      for (std::int64_t x = first.x; x < end.x; ++x) {
        if (!visit(Index3(x, y, z))) return false;
      }
    }
  }
  return true;
}

// The same for all of them.
template <class Visit>
void for_each_index(Index3 first, Index3 end, Visit visit) {
  for (std::int64_t z = first.z; z < end.z; ++z) {
    for (std::int64_t y = first.y; y < end.y; ++y) {
      for (std::int64_t x = first.x; x < end.x; ++x) visit(Index3(x, y, z));
    }
  }
}

// The same for the coordinates of the pages that hold voxels of the box, which has some.
template <class Visit>
bool all_pages(const PageLayout& layout, Index3 first, Index3 end, Visit visit) {
  const Index3 shape = layout.page_shape();
  return all_indices(first / shape, (end - Index3(1)) / shape + Index3(1), visit);
}
template <class Visit>
void for_each_page(const PageLayout& layout, Index3 first, Index3 end, Visit visit) {
  const Index3 shape = layout.page_shape();
  for_each_index(first / shape, (end - Index3(1)) / shape + Index3(1), visit);
}

}  // namespace tidemark
