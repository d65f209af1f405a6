#include "solver/host/page_pool.h"

namespace tidemark {
namespace {

std::int64_t round_up(std::int64_t count, std::int64_t unit) {
  return (count + unit - 1) / unit * unit;
}

}  // namespace

PagePool::PagePool() {
  reserve(kFirstPage);
}

void PagePool::reserve(PhysicalPage capacity) {
  while (chunks_.size() * kPagesPerChunk < static_cast<std::size_t>(capacity)) {
    chunks_.emplace_back(new Chunk);  // values are written when a page is allocated
  }
}

std::int64_t PagePool::state_bytes(std::int64_t capacity) {
  return round_up(capacity, kPagesPerChunk) *
         static_cast<std::int64_t>(2 * (kPageVoxels * sizeof(float) + sizeof(RowMasks)) + sizeof(PageInfo));
}

std::int64_t PagePool::source_bytes(std::int64_t capacity) {
  return round_up(capacity, kPagesPerChunk) * static_cast<std::int64_t>(kPageVoxels * sizeof(float));
}

}  // namespace tidemark
