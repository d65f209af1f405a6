// The inside of a surface as one bit a voxel, of the box around it alone.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/volume.h"
#include "solver/field.h"

namespace tidemark::document {

class InsideBits {
 public:
  InsideBits() = default;  // nothing is inside
  explicit InsideBits(const solver::Field& phi);
  explicit InsideBits(const Mask& mask);

  // Of any voxel of the grid.
  [[nodiscard]] bool contains(Index3 voxel) const;
  [[nodiscard]] std::int64_t count() const { return count_; }  // voxels inside
  [[nodiscard]] std::int64_t bytes() const { return static_cast<std::int64_t>(bits_.size()); }

  // The box: its first voxel and its size. Along i it begins at a multiple of 8, and may end up to 7 voxels
  // beyond the grid.
  [[nodiscard]] Index3 first() const { return first_; }
  [[nodiscard]] Index3 size() const { return size_; }
  // The voxels (first().x, j, k) and those that follow: eight a byte, the first in the lowest bit. (j, k) is
  // in the box.
  [[nodiscard]] std::span<const std::uint8_t> row(std::int64_t j, std::int64_t k) const;

  bool operator==(const InsideBits&) const = default;

 private:
  void make_room(Index3 low, Index3 high);  // for the voxels from `low` up to, and without, `high`
  std::uint8_t* row_at(std::int64_t j, std::int64_t k);
  void add_page(const solver::Field& phi, std::int64_t page);
  void count_bits();

  Index3 first_{0};
  Index3 size_{0};
  std::vector<std::uint8_t> bits_;
  std::int64_t count_ = 0;
};

// The most bytes that the bits of a surface on such a grid take.
[[nodiscard]] std::int64_t most_inside_bytes(Index3 grid_size);

// 2 |A and B| / (|A| + |B|) on one grid; 1 when both are empty.
[[nodiscard]] double dice(const InsideBits& a, const InsideBits& b);

}  // namespace tidemark::document
