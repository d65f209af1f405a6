#include "solver/paging/page_layout.h"

#include <glm/common.hpp>

namespace tidemark::solver {

PageLayout::PageLayout(Index3 volume_size, Index3 page_shape)
    : volume_size_(volume_size),
      page_shape_(page_shape),
      pages_((volume_size + page_shape - Index3(1)) / page_shape) {}

VirtualAddress PageLayout::translate(Index3 voxel) const {
  const Index3 page = voxel / page_shape_;
  const Index3 inside = voxel - page * page_shape_;
  return {page_number(page), inside.x + page_shape_.x * (inside.y + page_shape_.y * inside.z)};
}

Index3 PageLayout::page_coordinates(std::int64_t page) const {
  return {page % pages_.x, page / pages_.x % pages_.y, page / (pages_.x * pages_.y)};
}

std::int64_t PageLayout::page_number(Index3 coordinates) const {
  return coordinates.x + pages_.x * (coordinates.y + pages_.y * coordinates.z);
}

bool PageLayout::contains_page(Index3 coordinates) const {
  return coordinates.x >= 0 && coordinates.y >= 0 && coordinates.z >= 0 && coordinates.x < pages_.x &&
         coordinates.y < pages_.y && coordinates.z < pages_.z;
}

Index3 PageLayout::first_voxel(std::int64_t page) const {
  return page_coordinates(page) * page_shape_;
}

Index3 PageLayout::valid_shape(std::int64_t page) const {
  return glm::min(page_shape_, volume_size_ - first_voxel(page));
}

}  // namespace tidemark::solver
