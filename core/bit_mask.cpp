#include "core/bit_mask.h"

#include <algorithm>
#include <bit>
#include <utility>

#include "core/region.h"

namespace tidemark {

BitMask::BitMask(const Mask& mask) : BitMask(mask.geometry) {
  std::int64_t offset = 0;
  for (const std::uint8_t voxel : mask.voxels) {
    if (voxel != 0) add(offset);
    ++offset;
  }
}

BitMask::BitMask(const Geometry& geometry, const Region& region) : BitMask(geometry) {
  region.for_each_run([&](Index3 voxel, std::int64_t length) { add_run(geometry.offset(voxel), length); });
}

// The bytes between the first and the last as a whole.
void BitMask::add_run(std::int64_t offset, std::int64_t length) {
  const std::int64_t end = offset + length;
  while (offset < end && offset % kBits != 0) add(offset++);
  const std::int64_t whole = (end - offset) / kBits;
  std::fill_n(bits_.begin() + offset / kBits, whole, std::byte{0xFF});
  for (offset += whole * kBits; offset < end; ++offset) add(offset);
}

BitMask::BitMask(const Geometry& geometry, std::span<const std::byte> bits) : BitMask(geometry) {
  std::copy_n(bits.begin(), bits_.size(), bits_.begin());
  if (const std::int64_t used = geometry.voxel_count() % kBits; used != 0)
    bits_.back() &= std::byte{0xFF} >> (kBits - used);
}

std::int64_t BitMask::count() const {
  std::int64_t voxels = 0;
  for (const std::byte bits : bits_) voxels += std::popcount(std::to_integer<std::uint8_t>(bits));
  return voxels;
}

Inside inside_of(const BitMask& mask) {
  return {mask.geometry(), [from = &mask](std::int64_t offset, std::span<std::uint8_t> voxels) {
            for (std::uint8_t& voxel : voxels) voxel = std::uint8_t(from->contains(offset++));
          }};
}

Inside inside_of(std::shared_ptr<const BitMask> mask) {
  Inside inside = inside_of(*mask);
  inside.read = [mask = std::move(mask), read = std::move(inside.read)](
                    std::int64_t offset, std::span<std::uint8_t> voxels) { read(offset, voxels); };
  return inside;
}

}  // namespace tidemark
