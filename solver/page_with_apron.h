// A page of phi with its neighbours' nearest values, for differences and cells.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "solver/field.h"

namespace tidemark::solver {

// The values of phi at the corners of a cell: corner (x, y, z) is element x + 2 y + 4 z.
using Cell = std::array<float, 8>;

// The values of a page and of one voxel around it. Beyond the volume they are those of its last voxels.
class PageWithApron {
 public:
  explicit PageWithApron(const Field& phi)
      : phi_(phi),
        shape_(phi.layout.page_shape()),
        stride_y_(shape_.x + 2),
        stride_z_(stride_y_ * (shape_.y + 2)),
        values_(static_cast<std::size_t>(stride_z_ * (shape_.z + 2))) {}

  // The neighbours are looked up once: translating an address for each value would take longer than what is
  // computed from them.
  void gather(std::int64_t page) {
    coordinates_ = phi_.layout.page_coordinates(page);
    valid_ = phi_.layout.valid_shape(page);
    look_up_neighbours();
    const Place before = place(0, -1);
    const Place behind = place(0, valid_.x);
    for (std::int64_t z = -1; z <= valid_.z; ++z) {
      for (std::int64_t y = -1; y <= valid_.y; ++y) {
        const Place at_y = place(1, y);
        const Place at_z = place(2, z);
        float* const row = values_.data() + index({0, y, z});
        row[-1] = value(before, at_y, at_z);
        row[valid_.x] = value(behind, at_y, at_z);
        if (const float* const stored = first_of_row({0, 0}, at_y, at_z)) {
          std::copy_n(stored, valid_.x, row);
        } else {
          std::fill_n(row, valid_.x, value({0, 0}, at_y, at_z));
        }
      }
    }
  }

  // `local`: from the page's first voxel, -1 to its size.
  [[nodiscard]] double at(Index3 local) const { return values_[static_cast<std::size_t>(index(local))]; }
  // Of the eight voxels of which this is the first.
  [[nodiscard]] Cell cell(Index3 local) const {
    const float* v = values_.data() + index(local);
    const float* above = v + stride_z_;
    return {v[0],     v[1],     v[stride_y_],     v[stride_y_ + 1],
            above[0], above[1], above[stride_y_], above[stride_y_ + 1]};
  }

 private:
  // Along one axis: in this page (0), the one before (-1) or behind it (1), and at which voxel of that.
  struct Place {
    int page;
    std::int64_t voxel;
  };

  [[nodiscard]] Place place(int axis, std::int64_t local) const {
    const int page = local < 0 ? -1 : local < valid_[axis] ? 0 : 1;
    const std::int64_t coordinate = coordinates_[axis] + page;
    if (page == 0 || coordinate < 0 || coordinate >= phi_.layout.pages()[axis]) {
      return {0, std::clamp<std::int64_t>(local, 0, valid_[axis] - 1)};
    }
    return {page, page < 0 ? shape_[axis] - 1 : 0};
  }

  void look_up_neighbours() {
    for (int z = -1; z <= 1; ++z) {
      for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
          const Index3 at = coordinates_ + Index3(x, y, z);
          if (!phi_.layout.contains_page(at)) continue;  // place() leads to none of these
          const std::int64_t page = phi_.layout.page_number(at);
          const std::size_t entry = entry_index(x, y, z);
          stored_[entry] = phi_.pages.values(page);
          if (stored_[entry] == nullptr) constants_[entry] = phi_.constant(page);
        }
      }
    }
  }

  static std::size_t entry_index(int x, int y, int z) {
    return static_cast<std::size_t>((z + 1) * 9 + (y + 1) * 3 + x + 1);
  }

  // Null in a page that is not stored.
  [[nodiscard]] const float* first_of_row(Place x, Place y, Place z) const {
    const float* const page = stored_[entry_index(x.page, y.page, z.page)];
    return page == nullptr ? nullptr : page + (z.voxel * shape_.y + y.voxel) * shape_.x;
  }

  [[nodiscard]] float value(Place x, Place y, Place z) const {
    if (const float* const row = first_of_row(x, y, z)) return row[x.voxel];
    return constants_[entry_index(x.page, y.page, z.page)];
  }

  [[nodiscard]] std::int64_t index(Index3 local) const {
    return local.x + 1 + stride_y_ * (local.y + 1) + stride_z_ * (local.z + 1);
  }

  const Field& phi_;
  Index3 shape_;
  std::int64_t stride_y_;
  std::int64_t stride_z_;
  std::vector<float> values_;
  Index3 coordinates_{0};
  Index3 valid_{0};
  std::array<const float*, 27> stored_{};  // null: constants_ has the page's value
  std::array<float, 27> constants_{};
};

}  // namespace tidemark::solver
