#include "renderer/plane_blocks.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/index_walk.h"

namespace tidemark::renderer {

std::vector<Index3> blocks_on_plane(const PageLayout& blocks, const glm::dmat4& voxel_from_view) {
  const glm::dvec3 middle(voxel_from_view[3]);
  const glm::dvec3 right(voxel_from_view[0]);
  const glm::dvec3 up(voxel_from_view[1]);
  const glm::dvec3 normal = glm::cross(right, up);
  // What is between voxels needs those on both sides.
  const glm::dvec3 reach = glm::abs(right) + glm::abs(up) + 1.0;
  const glm::dvec3 end(blocks.domain_size() - Index3(1));
  const Index3 low(glm::clamp(glm::floor(middle - reach), glm::dvec3(0.0), end));
  const Index3 high(glm::clamp(glm::ceil(middle + reach), glm::dvec3(0.0), end));
  // To the middle of a block's outermost voxels, and the voxels before and behind it.
  const glm::dvec3 to_middle = 0.5 * glm::dvec3(blocks.page_shape() - Index3(1));
  const glm::dvec3 extent = glm::abs(normal) * (to_middle + 1.0);
  std::vector<Index3> crossed;
  for_each_page(blocks, low, high + Index3(1), [&](Index3 block) {
    const Index3 voxel = block * blocks.page_shape();
    const double distance = glm::dot(normal, glm::dvec3(voxel) + to_middle - middle);
    if (std::abs(distance) <= extent.x + extent.y + extent.z) crossed.push_back(voxel);
  });
  return crossed;
}

}  // namespace tidemark::renderer
