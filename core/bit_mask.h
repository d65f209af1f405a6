// A mask of one bit a voxel.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/geometry.h"
#include "core/inside.h"

namespace tidemark {

class BitMask {
 public:
  // Nothing is inside.
  explicit BitMask(const Geometry& geometry)
      : geometry_(geometry), words_(static_cast<std::size_t>((geometry.voxel_count() + kBits - 1) / kBits)) {}

  [[nodiscard]] const Geometry& geometry() const { return geometry_; }
  [[nodiscard]] bool contains(std::int64_t offset) const {
    return (words_[static_cast<std::size_t>(offset / kBits)] >> (offset % kBits) & 1U) != 0;
  }
  void add(std::int64_t offset) {
    words_[static_cast<std::size_t>(offset / kBits)] |= std::uint64_t{1} << (offset % kBits);
  }
  [[nodiscard]] std::int64_t count() const;  // voxels inside

 private:
  static constexpr std::int64_t kBits = 64;

  Geometry geometry_;
  std::vector<std::uint64_t> words_;
};

[[nodiscard]] Inside inside_of(std::shared_ptr<const BitMask> mask);

}  // namespace tidemark
