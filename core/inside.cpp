#include "core/inside.h"

#include <algorithm>

namespace tidemark {

Inside inside_of(const Mask& mask) {
  const std::uint8_t* const from = mask.voxels.data();
  return {mask.geometry, [from](std::int64_t offset, std::span<std::uint8_t> voxels) {
            std::transform(from + offset, from + offset + voxels.size(), voxels.begin(),
                           [](std::uint8_t voxel) { return std::uint8_t(voxel != 0); });
          }};
}

Mask mask_of(const Inside& inside) {
  Mask mask{inside.geometry,
            std::vector<std::uint8_t>(static_cast<std::size_t>(inside.geometry.voxel_count()))};
  inside.read(0, mask.voxels);
  return mask;
}

}  // namespace tidemark
