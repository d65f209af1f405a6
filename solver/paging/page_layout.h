// The shape of a page and the address of a voxel: the address translation of paper section 3.2.
#pragma once

#include "core/geometry.h"

namespace tidemark::solver {

// A virtual page number, and a voxel's position inside its page (i fastest).
struct VirtualAddress {
  std::int64_t page = 0;
  std::int64_t offset = 0;
};

// Maps the voxel space V of a volume to its virtual page space V_P. Sizes need not be multiples of the page:
// the last pages of an axis then hold padding, which belongs to no voxel.
class PageLayout {
 public:
  PageLayout() = default;
  PageLayout(Index3 volume_size, Index3 page_shape);

  [[nodiscard]] Index3 volume_size() const { return volume_size_; }
  [[nodiscard]] Index3 page_shape() const { return page_shape_; }
  [[nodiscard]] Index3 pages() const { return pages_; }  // V_P's size
  [[nodiscard]] std::int64_t page_count() const { return pages_.x * pages_.y * pages_.z; }
  [[nodiscard]] std::int64_t voxels_per_page() const { return page_shape_.x * page_shape_.y * page_shape_.z; }

  [[nodiscard]] VirtualAddress translate(Index3 voxel) const;

  // A page's coordinates in V_P, its number, its first voxel, and how many of its voxels along each axis are
  // inside the volume.
  [[nodiscard]] Index3 page_coordinates(std::int64_t page) const;
  [[nodiscard]] std::int64_t page_number(Index3 coordinates) const;
  [[nodiscard]] bool contains_page(Index3 coordinates) const;
  [[nodiscard]] Index3 first_voxel(std::int64_t page) const;
  [[nodiscard]] Index3 valid_shape(std::int64_t page) const;

  bool operator==(const PageLayout&) const = default;

 private:
  Index3 volume_size_{0};
  Index3 page_shape_{1};
  Index3 pages_{0};
};

inline constexpr Index3 kDefaultPageShape{8, 8, 8};

}  // namespace tidemark::solver
