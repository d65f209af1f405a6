// The agreement of several surfaces: how many of them have a voxel inside.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/region.h"

namespace tidemark::document {

class Agreement {
 public:
  Agreement() = default;
  // Of surfaces on one grid. It takes a byte a voxel of the box around all of them. At most 255 surfaces.
  Agreement(const std::vector<const Region*>& surfaces, Index3 grid_size);

  [[nodiscard]] int surfaces() const { return surfaces_; }
  [[nodiscard]] int not_empty() const { return not_empty_; }  // that have a voxel inside
  // The box: its first voxel and its size; outside of it no surface has a voxel inside.
  [[nodiscard]] Index3 first() const { return first_; }
  [[nodiscard]] Index3 size() const { return size_; }

  // Of the box's voxels, the first axis fastest.
  [[nodiscard]] std::span<const std::uint8_t> counts() const { return counts_; }
  // How many surfaces have that voxel inside, of any voxel of the grid.
  [[nodiscard]] int count(Index3 voxel) const;
  // The same as a share, 0 to 1.
  [[nodiscard]] double share(Index3 voxel) const {
    return surfaces_ == 0 ? 0.0 : static_cast<double>(count(voxel)) / surfaces_;
  }

 private:
  int surfaces_ = 0;
  int not_empty_ = 0;
  Index3 first_{0};
  Index3 size_{0};
  std::vector<std::uint8_t> counts_;
};

}  // namespace tidemark::document
