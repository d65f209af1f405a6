// The inside of something on a grid, asked for piece by piece: a mask of the volume's size need not be there.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "core/volume.h"

namespace tidemark {

struct Inside {
  // Of the voxels from `offset` on, in voxel order: 1 for each that is inside, 0 for the others. Several
  // threads may ask at once.
  using Read = std::function<void(std::int64_t offset, std::span<std::uint8_t> voxels)>;

  Geometry geometry;
  Read read;
};

// The voxels that are not 0. The mask must outlive the result.
[[nodiscard]] Inside inside_of(const Mask& mask);

[[nodiscard]] Mask mask_of(const Inside& inside);

}  // namespace tidemark
