#include "core/paging/page_layout.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace tidemark {

template <int kDimensions>
BasicPageLayout<kDimensions>::BasicPageLayout(Coordinates domain_size, Coordinates page_shape)
    : domain_size_(domain_size),
      page_shape_(page_shape),
      pages_((domain_size + page_shape - Coordinates(1)) / page_shape) {}

template <int kDimensions>
std::int64_t BasicPageLayout<kDimensions>::product(Coordinates sizes) {
  std::int64_t result = 1;
  for (int axis = 0; axis < kDimensions; ++axis) result *= sizes[axis];
  return result;
}

template <int kDimensions>
VirtualAddress BasicPageLayout<kDimensions>::translate(Coordinates voxel) const {
  const Coordinates page = voxel / page_shape_;
  return {page_number(page), number_in(page_shape_, voxel - page * page_shape_)};
}

template <int kDimensions>
Index<kDimensions> BasicPageLayout<kDimensions>::page_coordinates(std::int64_t page) const {
  Coordinates coordinates;
  for (int axis = 0; axis < kDimensions; ++axis) {
    coordinates[axis] = page % pages_[axis];
    page /= pages_[axis];
  }
  return coordinates;
}

template <int kDimensions>
std::int64_t BasicPageLayout<kDimensions>::page_number(Coordinates coordinates) const {
  return number_in(pages_, coordinates);
}

template <int kDimensions>
bool BasicPageLayout<kDimensions>::contains_page(Coordinates coordinates) const {
  return glm::all(glm::greaterThanEqual(coordinates, Coordinates(0))) &&
         glm::all(glm::lessThan(coordinates, pages_));
}

template <int kDimensions>
Index<kDimensions> BasicPageLayout<kDimensions>::first_voxel(std::int64_t page) const {
  return page_coordinates(page) * page_shape_;
}

template <int kDimensions>
Index<kDimensions> BasicPageLayout<kDimensions>::valid_shape(std::int64_t page) const {
  return glm::min(page_shape_, domain_size_ - first_voxel(page));
}

template class BasicPageLayout<2>;
template class BasicPageLayout<3>;
template class BasicPageLayout<4>;

}  // namespace tidemark
