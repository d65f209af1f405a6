// A region: some voxels of a grid, one bit each, of a box around them alone.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "core/volume.h"

namespace tidemark {

class BitMask;
class PagedBytes;

// A box of voxels: from `low` up to, and without, `high`.
struct VoxelRange {
  Index3 low{0};
  Index3 high{0};

  [[nodiscard]] bool empty() const { return low.x >= high.x || low.y >= high.y || low.z >= high.z; }
  // Widened by so many voxels on each side, within a grid.
  [[nodiscard]] VoxelRange widened(Index3 voxels, Index3 grid_size) const;
  // Whether it reaches either end of a grid along an axis.
  [[nodiscard]] bool touches_end(int axis, Index3 grid_size) const {
    return low[axis] <= 0 || high[axis] >= grid_size[axis];
  }
  bool operator==(const VoxelRange&) const = default;
};

class Region {
 public:
  static constexpr std::int64_t kBits = 64;  // a word

  Region() = default;  // no voxel, and room for none
  // No voxel, and room for those of the box.
  explicit Region(const VoxelRange& box);
  // The voxels that are not 0, or in the mask. The third form: those of that value, which is not what pages
  // without memory hold.
  explicit Region(const Mask& mask);
  explicit Region(const BitMask& mask);
  Region(const PagedBytes& values, std::uint8_t value);

  // Of any voxel, in the box or not.
  [[nodiscard]] bool contains(Index3 voxel) const;
  [[nodiscard]] std::int64_t count() const;  // voxels, in time linear in the box
  [[nodiscard]] bool empty() const;
  [[nodiscard]] std::int64_t bytes() const {
    return static_cast<std::int64_t>(words_.size() * sizeof(words_[0]));
  }
  // The smallest box around all voxels.
  [[nodiscard]] VoxelRange bounds() const;

  // The box that there is room for. Along i it begins and ends at multiples of 64, and may reach beyond the
  // grid; no voxel there is in the region.
  [[nodiscard]] Index3 first() const { return first_; }
  [[nodiscard]] Index3 size() const { return size_; }
  // The voxels (first().x, j, k) and those that follow, the first in the lowest bit of the first word. (j, k)
  // is in the box.
  [[nodiscard]] std::span<const std::uint64_t> row(std::int64_t j, std::int64_t k) const {
    return {words_.data() + row_offset(j, k), words_a_row()};
  }
  [[nodiscard]] std::span<std::uint64_t> row(std::int64_t j, std::int64_t k) {
    return {words_.data() + row_offset(j, k), words_a_row()};
  }
  [[nodiscard]] bool has_row(std::int64_t j, std::int64_t k) const {
    return j >= first_.y && k >= first_.z && j < first_.y + size_.y && k < first_.z + size_.z;
  }

  // Voxels of the box.
  void add(Index3 voxel) { add_run(voxel, 1); }
  void add_run(Index3 voxel, std::int64_t length);  // along i

  // Calls visit(voxel, length) for each run along i, in voxel order.
  template <class Visit>
  void for_each_run(const Visit& visit) const;

  // The same voxels, whatever the boxes.
  bool operator==(const Region& other) const;

 private:
  [[nodiscard]] std::size_t words_a_row() const { return static_cast<std::size_t>(size_.x / kBits); }
  [[nodiscard]] std::size_t row_offset(std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>((k - first_.z) * size_.y + j - first_.y) * words_a_row();
  }

  Index3 first_{0};
  Index3 size_{0};
  std::vector<std::uint64_t> words_;
};

// The voxels of both, of either, and of the first but not of the second.
[[nodiscard]] Region intersection(const Region& a, const Region& b);
[[nodiscard]] Region united(const Region& a, const Region& b);
[[nodiscard]] Region difference(const Region& a, const Region& b);

// All voxels of a box.
[[nodiscard]] Region whole(const VoxelRange& box);
// The voxels of a box that are not in the region.
[[nodiscard]] Region complement(const Region& region, const VoxelRange& box);

[[nodiscard]] std::int64_t common_count(const Region& a, const Region& b);
// 2 |A and B| / (|A| + |B|) on one grid; 1 when both are empty.
[[nodiscard]] double dice(const Region& a, const Region& b);

[[nodiscard]] Mask mask_of(const Region& region, const Geometry& grid);

// The most bytes that a region of such a grid takes.
[[nodiscard]] std::int64_t most_region_bytes(Index3 grid_size);

template <class Visit>
void Region::for_each_run(const Visit& visit) const {
  for (std::int64_t k = first_.z; k < first_.z + size_.z; ++k) {
    for (std::int64_t j = first_.y; j < first_.y + size_.y; ++j) {
      const auto words = row(j, k);
      std::int64_t begin = -1;  // of the run that is open
      for (std::size_t w = 0; w < words.size(); ++w) {
        const auto base = static_cast<std::int64_t>(w) * kBits;
        std::uint64_t left = begin < 0 ? words[w] : ~words[w];  // whose lowest bit is the next change
        for (std::int64_t at = 0; left != 0;) {
          at = std::countr_zero(left);
          if (begin < 0) {
            begin = base + at;
          } else {
            visit(Index3(first_.x + begin, j, k), base + at - begin);
            begin = -1;
          }
          const std::uint64_t beyond = ~(left ^ (left - 1));
          left = (begin < 0 ? words[w] : ~words[w]) & beyond;
        }
      }
      if (begin >= 0) visit(Index3(first_.x + begin, j, k), size_.x - begin);
    }
  }
}

}  // namespace tidemark
