// The shape of a page and the address of a voxel: the address translation of paper section 3.2, for a domain
// of 2, 3 or 4 dimensions (section 7).
#pragma once

#include "core/geometry.h"

namespace tidemark {

// A voxel's coordinates in a domain of so many dimensions, or as many sizes along its axes.
template <int kDimensions>
using Index = glm::vec<kDimensions, std::int64_t>;

// A virtual page number, and a voxel's position inside its page (the first axis fastest).
struct VirtualAddress {
  std::int64_t page = 0;
  std::int64_t offset = 0;
};

// Maps the voxel space V of a domain to its virtual page space V_P. Sizes need not be multiples of the page:
// the last pages of an axis then hold padding, which belongs to no voxel.
template <int kDimensions>
class BasicPageLayout {
 public:
  using Coordinates = Index<kDimensions>;

  BasicPageLayout() = default;
  BasicPageLayout(Coordinates domain_size, Coordinates page_shape);

  [[nodiscard]] Coordinates domain_size() const { return domain_size_; }
  [[nodiscard]] Coordinates page_shape() const { return page_shape_; }
  [[nodiscard]] Coordinates pages() const { return pages_; }  // V_P's size
  [[nodiscard]] std::int64_t page_count() const { return product(pages_); }
  [[nodiscard]] std::int64_t voxels_per_page() const { return product(page_shape_); }

  [[nodiscard]] VirtualAddress translate(Coordinates voxel) const;

  // A page's coordinates in V_P, its number, its first voxel, and how many of its voxels along each axis are
  // inside the domain.
  [[nodiscard]] Coordinates page_coordinates(std::int64_t page) const;
  [[nodiscard]] std::int64_t page_number(Coordinates coordinates) const;
  [[nodiscard]] bool contains_page(Coordinates coordinates) const;
  [[nodiscard]] Coordinates first_voxel(std::int64_t page) const;
  [[nodiscard]] Coordinates valid_shape(std::int64_t page) const;

  bool operator==(const BasicPageLayout&) const = default;

 private:
  static std::int64_t product(Coordinates sizes);

  Coordinates domain_size_{0};
  Coordinates page_shape_{1};
  Coordinates pages_{0};
};

extern template class BasicPageLayout<2>;
extern template class BasicPageLayout<3>;
extern template class BasicPageLayout<4>;

// Of a volume.
using PageLayout = BasicPageLayout<3>;
inline constexpr Index3 kDefaultPageShape{8, 8, 8};

}  // namespace tidemark
