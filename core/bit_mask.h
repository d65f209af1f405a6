// A mask of one bit a voxel: what masks become that are kept.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/geometry.h"
#include "core/inside.h"

namespace tidemark {

class Region;

class BitMask {
 public:
  // That a mask of the grid takes.
  [[nodiscard]] static std::size_t bytes_of(const Geometry& geometry) {
    return static_cast<std::size_t>((geometry.voxel_count() + kBits - 1) / kBits);
  }

  // Nothing is inside.
  explicit BitMask(const Geometry& geometry) : geometry_(geometry), bits_(bytes_of(geometry)) {}
  // The voxels that are not 0.
  explicit BitMask(const Mask& mask);
  // The region's voxels, all of which are in the grid.
  BitMask(const Geometry& geometry, const Region& region);
  // As bits() gives them, and as many; what follows the last voxel is left out.
  BitMask(const Geometry& geometry, std::span<const std::byte> bits);

  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] bool contains(std::int64_t offset) const {
    return (bits_[static_cast<std::size_t>(offset / kBits)] >> (offset % kBits) & std::byte{1}) !=
           std::byte{0};
  }
  void add(std::int64_t offset) {
    bits_[static_cast<std::size_t>(offset / kBits)] |= std::byte{1} << (offset % kBits);
  }
  [[nodiscard]] std::int64_t count() const;  // voxels inside
  // Eight voxels a byte in voxel order, the first in the lowest bit.
  [[nodiscard]] std::span<const std::byte> bits() const { return bits_; }

 private:
  static constexpr std::int64_t kBits = 8;

  void add_run(std::int64_t offset, std::int64_t length);

  Geometry geometry_;
  std::vector<std::byte> bits_;
};

// In the first form the mask must outlive the result.
[[nodiscard]] Inside inside_of(const BitMask& mask);
[[nodiscard]] Inside inside_of(std::shared_ptr<const BitMask> mask);

}  // namespace tidemark
