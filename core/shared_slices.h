// A byte for each voxel of a grid, in slices that copies share until one of them is changed.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/geometry.h"

namespace tidemark {

// A slice is all voxels of one k, i fastest. A slice that holds the value `rest` alone takes no memory.
//
// A copy costs 16 bytes a slice. What differs between two values that come from one another is known from
// where their slices lie, so nobody has to compare voxels.
class SharedSlices {
 public:
  SharedSlices() = default;  // of no voxel
  explicit SharedSlices(Index3 size, std::uint8_t rest = 0);
  // `voxels` are in voxel order, as many as the grid has.
  SharedSlices(Index3 size, std::span<const std::uint8_t> voxels, std::uint8_t rest = 0);

  [[nodiscard]] Index3 size() const { return size_; }
  // Whether no slice takes memory.
  [[nodiscard]] bool empty() const;
  [[nodiscard]] std::int64_t bytes() const;  // of all slices, as if nothing were shared

  [[nodiscard]] std::uint8_t at(Index3 voxel) const {
    const std::uint8_t* const values = slices_[static_cast<std::size_t>(voxel.z)].get();
    return values == nullptr ? rest_ : values[voxel.x + size_.x * voxel.y];
  }
  // A slice, and a row of it along i. Empty where the slice holds `rest` alone.
  [[nodiscard]] std::span<const std::uint8_t> slice(std::int64_t k) const;
  [[nodiscard]] std::span<const std::uint8_t> row(std::int64_t j, std::int64_t k) const;
  // The values of a slice, into as many.
  void read(std::int64_t k, std::span<std::uint8_t> into) const;
  [[nodiscard]] std::vector<std::uint8_t> voxels() const;  // in voxel order

  // The values of a slice, to be changed; copies keep what they were.
  [[nodiscard]] std::uint8_t* change(std::int64_t k);
  // That many voxels in voxel order from the first one on, over the ends of rows and slices.
  void fill(std::int64_t first, std::int64_t length, std::uint8_t value);
  // The slice holds `rest` alone.
  void clear(std::int64_t k) { slices_[static_cast<std::size_t>(k)].reset(); }

  // The slices k, in ascending order, that do not lie at the same place in both. All when sizes differ.
  [[nodiscard]] std::vector<std::int64_t> differing_slices(const SharedSlices& other) const;

 private:
  [[nodiscard]] std::int64_t area() const { return size_.x * size_.y; }

  Index3 size_{0};
  std::uint8_t rest_ = 0;
  std::vector<std::shared_ptr<std::uint8_t[]>> slices_;
};

}  // namespace tidemark
