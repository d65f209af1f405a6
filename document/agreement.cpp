#include "document/agreement.h"

#include <bit>
#include <glm/common.hpp>

namespace tidemark::document {
namespace {

constexpr std::int64_t kBitsAtOnce = 8;  // a byte of InsideBits

}  // namespace

Agreement::Agreement(const std::vector<const InsideBits*>& surfaces, Index3 grid_size)
    : surfaces_(static_cast<int>(surfaces.size())) {
  Index3 low = grid_size;
  Index3 high(0);
  for (const InsideBits* inside : surfaces) {
    if (inside->count() == 0) continue;
    ++not_empty_;
    low = glm::min(low, inside->first());
    high = glm::max(high, inside->first() + inside->size());
  }
  high = glm::min(high, grid_size);
  if (low.x >= high.x) return;
  first_ = low;
  size_ = high - low;
  counts_.assign(static_cast<std::size_t>(size_.x * size_.y * size_.z), 0);
  for (const InsideBits* inside : surfaces) {
    for (std::int64_t k = 0; k < inside->size().z; ++k) {
      for (std::int64_t j = 0; j < inside->size().y; ++j) {
        const Index3 at = inside->first() + Index3(0, j, k) - first_;
        std::uint8_t* counts = counts_.data() + (at.z * size_.y + at.y) * size_.x + at.x;
        for (const std::uint8_t byte : inside->row(inside->first().y + j, inside->first().z + k)) {
          for (unsigned bits = byte; bits != 0; bits &= bits - 1) ++counts[std::countr_zero(bits)];
          counts += kBitsAtOnce;
        }
      }
    }
  }
}

int Agreement::count(Index3 voxel) const {
  const Index3 at = voxel - first_;
  if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= size_.x || at.y >= size_.y || at.z >= size_.z) return 0;
  return counts_[static_cast<std::size_t>((at.z * size_.y + at.y) * size_.x + at.x)];
}

}  // namespace tidemark::document
