#include "solver/host/page_prefetch.h"

namespace tidemark::solver {

void PagePrefetch::add_values(const HostFields& fields, PhysicalPage page) {
  const float* values = fields.all_values(page);
  for (int four = 0; four < kFoursOfValues; ++four) add(values + four * 4 * kFloatsPerLine, kFloatsPerLine);
}

// Without a look at which neighbours may be in the cache: branches on that would be mispredicted.
void PagePrefetch::add_neighbours(const HostFields& fields, int buffer, PhysicalPage page) {
  constexpr int kSlice = kPageVoxels / kPageSide;
  const PhysicalPage* beside = fields.info(page).neighbours + 13;
  const auto phi = [&](PhysicalPage neighbour) {
    return fields.phi(buffer, neighbour == kNoPage ? kOutsidePage : neighbour);
  };
  for (int dx = -1; dx <= 1; ++dx) {
    // Along z a slice, along y a row of each slice.
    add(phi(beside[dx - 9]) + kPageVoxels - kSlice, kFloatsPerLine);
    add(phi(beside[dx + 9]), kFloatsPerLine);
    for (const int half : {0, kPageVoxels / 2}) {
      add(phi(beside[dx - 3]) + half + kSlice - kPageSide, kSlice);
      add(phi(beside[dx + 3]) + half, kSlice);
    }
  }
}

}  // namespace tidemark::solver
