// The inside of a surface by pages, a bit a voxel near the surface.
#pragma once

#include <cstdint>
#include <vector>

#include "solver/field.h"
#include "solver/speed/block.h"

namespace tidemark::solver {

class InsideMask {
 public:
  // The voxels where phi is above 0.
  explicit InsideMask(const Field& phi);

  // 1 inside and 0 outside; beyond the grid as the nearest voxel.
  [[nodiscard]] Block values_in(const VoxelBox& box) const;
  // The voxels that differ, in the page where most do; both are on the same grid. Masks on other layouts
  // differ in every voxel.
  [[nodiscard]] std::int64_t largest_change(const InsideMask& other) const;

 private:
  // The i-th 64 voxels of a page.
  [[nodiscard]] std::uint64_t word(std::int64_t page, std::int64_t i) const;

  PageLayout layout_;
  std::int64_t words_per_page_ = 0;
  std::vector<std::int32_t> table_;  // as Field::table
  std::vector<std::uint64_t> words_;
};

}  // namespace tidemark::solver
