#include "core/bit_mask.h"

#include <bit>
#include <utility>

namespace tidemark {

std::int64_t BitMask::count() const {
  std::int64_t voxels = 0;
  for (const std::uint64_t word : words_) voxels += std::popcount(word);
  return voxels;
}

Inside inside_of(std::shared_ptr<const BitMask> mask) {
  const Geometry geometry = mask->geometry();
  return {geometry, [mask = std::move(mask)](std::int64_t offset, std::span<std::uint8_t> voxels) {
            for (std::uint8_t& voxel : voxels) voxel = std::uint8_t(mask->contains(offset++));
          }};
}

}  // namespace tidemark
