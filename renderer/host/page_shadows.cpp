#include "renderer/host/page_shadows.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace tidemark::renderer {

PageShadows::PageShadows(glm::ivec3 page_shape, float around, const glm::mat4& voxel_from_view,
                         PictureSize size)
    : columns_((size.width + kBlock - 1) / kBlock),
      rows_((size.height + kBlock - 1) / kBlock),
      shape_(page_shape) {
  const glm::mat4 view_from_voxel = glm::inverse(voxel_from_view);
  // A view's x and y are in -1..1, y upwards.
  const float depth = glm::length(glm::vec3(voxel_from_view[2]));
  const glm::vec3 scale =
      glm::vec3(0.5F * static_cast<float>(size.width), -0.5F * static_cast<float>(size.height), depth) /
      glm::vec3(kBlock, kBlock, 1.0F);
  turn_ = glm::mat3(view_from_voxel);
  glm::mat3 widths;  // of a box's shadow, for each voxel of its sides
  for (int axis = 0; axis < 3; ++axis) {
    turn_[axis] *= scale;
    widths[axis] = glm::abs(turn_[axis]);
  }
  origin_ = (glm::vec3(view_from_voxel[3]) + glm::vec3(1.0F, -1.0F, 1.0F)) * scale;
  reach_ = widths * (0.5F * shape_ + around);
}

PageShadows::Shadow PageShadows::of(glm::ivec3 page) const {
  const glm::vec3 middle = origin_ + turn_ * ((glm::vec3(page) + 0.5F) * shape_ - 0.5F);
  const glm::vec3 low = middle - reach_;
  const glm::vec3 high = middle + reach_;
  const auto begin = [](float at) {
    return std::max<std::int64_t>(static_cast<std::int64_t>(std::floor(at)), 0);
  };
  const auto end = [](float at, std::int64_t count) {
    return std::min(static_cast<std::int64_t>(std::floor(at)) + 1, count);
  };
  return {begin(low.x), end(high.x, columns_), begin(low.y), end(high.y, rows_), low.z, high.z};
}

}  // namespace tidemark::renderer
