// phi as surfaces are made of it: of every voxel, or in the pages near the surface alone. Private to this
// folder.
#pragma once

#include <cstdint>
#include <span>

#include "core/geometry.h"
#include "imaging/surface/surface.h"

namespace tidemark::imaging {

// Whatever it is made of must outlive it.
class PhiValues {
 public:
  PhiValues(const Geometry& geometry, const float* dense) : geometry_(geometry), dense_(dense) {}
  explicit PhiValues(const PhiPages& pages)
      : geometry_(pages.geometry), paged_(pages), pages_(page_of(pages.geometry.size + (kSide - 1))) {}

  [[nodiscard]] const Geometry& geometry() const { return geometry_; }

  // Of a voxel of the grid.
  [[nodiscard]] float at(Index3 v) const {
    if (dense_ != nullptr) return dense_[geometry_.offset(v)];
    const std::int32_t entry = paged_.table[static_cast<std::size_t>(page_number(page_of(v)))];
    return entry < 0 ? paged_.constant(entry) : page(entry)[index_in_page(v)];
  }

  // Whether phi > 0 in each voxel of a row along i.
  void signs(std::int64_t j, std::int64_t k, std::uint8_t* row) const;

 private:
  static constexpr std::int64_t kSide = PhiPages::kSide;

  static Index3 page_of(Index3 v) { return {v.x / kSide, v.y / kSide, v.z / kSide}; }
  static std::int64_t index_in_page(Index3 v) {
    return v.x % kSide + kSide * (v.y % kSide + kSide * (v.z % kSide));
  }
  [[nodiscard]] std::int64_t page_number(Index3 page) const {
    return page.x + pages_.x * (page.y + pages_.y * page.z);
  }
  [[nodiscard]] const float* page(std::int32_t entry) const {
    return paged_.pages.data() + entry * kSide * kSide * kSide;
  }

  const Geometry& geometry_;
  const float* dense_ = nullptr;  // null: in pages
  PhiPages paged_{geometry_, {}, {}, 0.0F};
  Index3 pages_{0};
};

}  // namespace tidemark::imaging
