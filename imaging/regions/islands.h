// The islands of a region: its parts that do not touch.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "core/region.h"

namespace tidemark::imaging {

// Voxels touch across their faces: those of the volume, or those of a slice alone (along i and j).
enum class Touching { in_volume, in_slices };

class Islands {
 public:
  explicit Islands(const Region& region, Touching touching = Touching::in_volume);

  // In the order of their first voxels.
  [[nodiscard]] const std::vector<std::int64_t>& voxels() const { return voxels_; }
  [[nodiscard]] std::size_t count() const { return voxels_.size(); }
  // The island of a voxel; none: it is not in the region.
  [[nodiscard]] std::optional<std::size_t> at(Index3 voxel) const;
  [[nodiscard]] std::size_t largest() const;  // the first of equals; there must be one
  // Those of them that touch a side of that box.
  [[nodiscard]] std::vector<bool> touching_sides(const VoxelRange& box) const;

  [[nodiscard]] Region region_of(const std::function<bool(std::size_t island)>& wanted) const;

 private:
  struct Run {
    Index3 first{0};
    std::int64_t length = 0;
    std::size_t island = 0;
  };
  void join(std::size_t row, std::size_t other_row, std::vector<std::size_t>& parents) const;
  [[nodiscard]] std::size_t row_of(std::int64_t j, std::int64_t k) const {
    return static_cast<std::size_t>((k - box_.low.z) * (box_.high.y - box_.low.y) + j - box_.low.y);
  }

  VoxelRange box_;
  Touching touching_;
  std::vector<Run> runs_;              // in voxel order
  std::vector<std::size_t> row_ends_;  // of runs_, for each row of the box
  std::vector<std::int64_t> voxels_;
};

// The region with its holes: what lies around it but does not reach a side of its box. In slices a hole is
// one of its slice, and a tunnel through the volume is one, too.
[[nodiscard]] Region without_holes(const Region& region, Index3 grid_size, Touching touching);

}  // namespace tidemark::imaging
