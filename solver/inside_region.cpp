#include "solver/inside_region.h"

#include <algorithm>
#include <glm/common.hpp>
#include <vector>

namespace tidemark::solver {
namespace {

bool any_inside(const Field& phi, std::int64_t page) {
  const float* const values = phi.pages.values(page);
  if (values == nullptr) return phi.pages.kind(page) == Field::Kind::inside;
  const Index3 valid = phi.layout.valid_shape(page);
  const Index3 shape = phi.layout.page_shape();
  for (std::int64_t z = 0; z < valid.z; ++z) {
    for (std::int64_t y = 0; y < valid.y; ++y) {
      const float* const row = values + (z * shape.y + y) * shape.x;
      if (std::any_of(row, row + valid.x, [](float value) { return value > 0.0F; })) return true;
    }
  }
  return false;
}

void add_page(Region& region, const Field& phi, std::int64_t page) {
  const Index3 first = phi.layout.first_voxel(page);
  const Index3 valid = phi.layout.valid_shape(page);
  const Index3 shape = phi.layout.page_shape();
  const float* const values = phi.pages.values(page);  // null: all inside
  for (std::int64_t z = 0; z < valid.z; ++z) {
    for (std::int64_t y = 0; y < valid.y; ++y) {
      if (values == nullptr) {
        region.add_run(first + Index3(0, y, z), valid.x);
        continue;
      }
      const float* const row = values + (z * shape.y + y) * shape.x;
      for (std::int64_t x = 0; x < valid.x; ++x) {
        if (row[x] > 0.0F) region.add(first + Index3(x, y, z));
      }
    }
  }
}

}  // namespace

Region inside_region(const Field& phi) {
  std::vector<std::int64_t> pages;
  VoxelRange box{phi.geometry.size, Index3(0)};
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (!any_inside(phi, page)) continue;
    pages.push_back(page);
    const Index3 first = phi.layout.first_voxel(page);
    box.low = glm::min(box.low, first);
    box.high = glm::max(box.high, first + phi.layout.valid_shape(page));
  }
  Region region(box);
  for (const std::int64_t page : pages) add_page(region, phi, page);
  return region;
}

}  // namespace tidemark::solver
