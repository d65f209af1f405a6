// phi as surfaces are made of it: of every voxel, or in the pages near the surface alone. Private to this
// folder.
#pragma once

#include <cstdint>

#include "core/geometry.h"
#include "imaging/surface/surface.h"

namespace tidemark::imaging {

// Whatever it is made of must outlive it.
class PhiValues {
 public:
  PhiValues(const Geometry& geometry, const float* dense) : geometry_(geometry), dense_(dense) {}
  explicit PhiValues(const PhiPages& phi)
      : geometry_(phi.geometry),
        pages_(phi.pages.data()),
        page_grid_(page_of(phi.geometry.size + (kSide - 1))) {}

  [[nodiscard]] const Geometry& geometry() const { return geometry_; }

  // Of a voxel of the grid.
  [[nodiscard]] float at(Index3 v) const {
    if (dense_ != nullptr) return dense_[geometry_.offset(v)];
    const PhiPages::Page& there = page(v);
    return there.values == nullptr ? there.constant : there.values[index_in_page(v)];
  }

  // Whether phi > 0 in each voxel of a row along i.
  void signs(std::int64_t j, std::int64_t k, std::uint8_t* row) const;

 private:
  static constexpr std::int64_t kSide = PhiPages::kSide;

  static Index3 page_of(Index3 v) { return {v.x / kSide, v.y / kSide, v.z / kSide}; }
  static std::int64_t index_in_page(Index3 v) { return number_in(Index3(kSide), v % kSide); }
  // That a voxel lies in.
  [[nodiscard]] const PhiPages::Page& page(Index3 v) const {
    const Index3 at = page_of(v);
    return pages_[number_in(page_grid_, at)];
  }

  const Geometry& geometry_;
  const float* dense_ = nullptr;  // null: in pages
  const PhiPages::Page* pages_ = nullptr;
  Index3 page_grid_{0};
};

}  // namespace tidemark::imaging
