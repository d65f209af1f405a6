// The inside of a surface by pages of 8^3 voxels, a bit a voxel near the surface.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "solver/field.h"
#include "solver/speed/block.h"

namespace tidemark::solver {

// The same for the same surface, whatever the shape of phi's pages.
class InsideMask {
 public:
  // The voxels where phi is above 0.
  explicit InsideMask(const Field& phi);

  // 1 inside and 0 outside; beyond the grid as the nearest voxel.
  [[nodiscard]] Block values_in(const VoxelBox& box) const;
  // Whether each page differs from that of a mask on the same grid.
  [[nodiscard]] std::vector<bool> changes_from(const InsideMask& other) const;
  [[nodiscard]] const PageLayout& layout() const { return layout_; }

 private:
  // Bit x + 8 y of each slice. Padding is 0.
  using Bits = std::array<std::uint64_t, 8>;
  static Bits inside_of(const Field& phi, const VoxelBox& box);
  PageLayout layout_;
  static constexpr std::int32_t kAllOutside = -1;
  static constexpr std::int32_t kAllInside = -2;
  std::vector<std::int32_t> table_;  // a page's index in pages_, or one of these
  std::vector<Bits> pages_;
};

}  // namespace tidemark::solver
