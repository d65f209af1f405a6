#include "solver/inside_region.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <iterator>
#include <span>

namespace tidemark::solver {
namespace {

bool is_within(const VoxelRange& part, const VoxelRange& whole) {
  return glm::all(glm::greaterThanEqual(part.low, whole.low)) &&
         glm::all(glm::lessThanEqual(part.high, whole.high));
}

void include(VoxelRange& box, const VoxelRange& other) {
  box.low = glm::min(box.low, other.low);
  box.high = glm::max(box.high, other.high);
}

// Widens the box to a stored page's voxels inside.
void include_page(VoxelRange& box, const Field& phi, std::int64_t page) {
  const Index3 first = phi.layout.first_voxel(page);
  const Index3 valid = phi.layout.valid_shape(page);
  const Index3 shape = phi.layout.page_shape();
  const float* const values = phi.pages.values(page);
  const auto is_inside = [](float value) { return value > 0.0F; };
  for (std::int64_t z = 0; z < valid.z; ++z) {
    for (std::int64_t y = 0; y < valid.y; ++y) {
      const std::span row(values + (z * shape.y + y) * shape.x, static_cast<std::size_t>(valid.x));
      const auto begin = std::find_if(row.begin(), row.end(), is_inside);
      if (begin == row.end()) continue;
      const auto end = std::find_if(row.rbegin(), row.rend(), is_inside).base();
      const Index3 at = first + Index3(0, y, z);
      include(box, {at + Index3(begin - row.begin(), 0, 0), at + Index3(end - row.begin(), 1, 1)});
    }
  }
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

VoxelRange inside_bounds(const Field& phi) {
  VoxelRange box{phi.geometry.size, Index3(0)};
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (phi.pages.kind(page) == Field::Kind::outside) continue;
    const Index3 first = phi.layout.first_voxel(page);
    const VoxelRange whole{first, first + phi.layout.valid_shape(page)};
    if (is_within(whole, box)) continue;
    if (phi.pages.is_stored(page)) {
      include_page(box, phi, page);
    } else {
      include(box, whole);
    }
  }
  return box.empty() ? VoxelRange() : box;
}

Region inside_region(const Field& phi) {
  Region region(inside_bounds(phi));
  for (std::int64_t page = 0; page < phi.layout.page_count(); ++page) {
    if (phi.pages.kind(page) != Field::Kind::outside) add_page(region, phi, page);
  }
  return region;
}

}  // namespace tidemark::solver
