#include "document/agreement.h"

#include <glm/common.hpp>

namespace tidemark::document {

Agreement::Agreement(const std::vector<const Region*>& surfaces, Index3 grid_size)
    : surfaces_(static_cast<int>(surfaces.size())) {
  VoxelRange all{grid_size, Index3(0)};
  for (const Region* inside : surfaces) {
    const VoxelRange box = inside->bounds();
    if (box.empty()) continue;
    ++not_empty_;
    all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
  }
  if (all.empty()) return;
  first_ = all.low;
  size_ = all.high - all.low;
  counts_.assign(static_cast<std::size_t>(size_.x * size_.y * size_.z), 0);
  for (const Region* inside : surfaces) {
    inside->for_each_run([&](Index3 voxel, std::int64_t length) {
      const Index3 at = voxel - first_;
      std::uint8_t* const counts = counts_.data() + (at.z * size_.y + at.y) * size_.x + at.x;
      for (std::int64_t i = 0; i < length; ++i) ++counts[i];
    });
  }
}

int Agreement::count(Index3 voxel) const {
  const Index3 at = voxel - first_;
  if (at.x < 0 || at.y < 0 || at.z < 0 || at.x >= size_.x || at.y >= size_.y || at.z >= size_.z) return 0;
  return counts_[static_cast<std::size_t>((at.z * size_.y + at.y) * size_.x + at.x)];
}

}  // namespace tidemark::document
