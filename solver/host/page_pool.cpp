#include "solver/host/page_pool.h"

namespace tidemark::solver {

PagePool::PagePool(PhysicalPage capacity)
    : capacity_(capacity),
      values_(index(capacity) * kFloatsPerPage),
      masks_{ReservedArray<RowMasks>(index(capacity)), ReservedArray<RowMasks>(index(capacity))},
      infos_(index(capacity)) {}

void PagePool::keep_advection(bool wanted) {
  if (wanted == (advection_.data() != nullptr)) return;
  advection_ = wanted ? ReservedArray<float>(index(capacity_) * 3 * kPageVoxels) : ReservedArray<float>();
}

std::int64_t PagePool::advection_bytes(std::int64_t pages) const {
  return advection_.data() == nullptr ? 0 : 3 * data_bytes(pages);
}

std::int64_t PagePool::state_bytes(std::int64_t pages) {
  return pages *
         static_cast<std::int64_t>(2 * (kPageVoxels * sizeof(float) + sizeof(RowMasks)) + sizeof(PageInfo));
}

std::int64_t PagePool::data_bytes(std::int64_t pages) {
  return pages * static_cast<std::int64_t>(kPageVoxels * sizeof(float));
}

}  // namespace tidemark::solver
