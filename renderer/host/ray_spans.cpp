#include "renderer/host/ray_spans.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>

namespace tidemark::renderer {

RaySpans::RaySpans(const PageKinds& kinds, glm::ivec3 page_shape, const glm::mat4& voxel_from_view,
                   PictureSize size)
    : columns_((size.width + kBlock - 1) / kBlock) {
  constexpr float kFar = std::numeric_limits<float>::max();
  const std::int64_t rows = (size.height + kBlock - 1) / kBlock;
  spans_.assign(static_cast<std::size_t>(columns_ * rows), {kFar, -kFar});
  // To blocks from the top left, and to voxels along the rays. A view's x and y are in -1..1, y upwards.
  const float depth = glm::length(glm::vec3(voxel_from_view[2]));
  const glm::vec3 scale =
      glm::vec3(0.5F * static_cast<float>(size.width), -0.5F * static_cast<float>(size.height), depth) /
      glm::vec3(kBlock, kBlock, 1.0F);
  const glm::mat4 view_from_voxel = glm::inverse(voxel_from_view);
  glm::mat3 turn(view_from_voxel);
  glm::mat3 widths;  // of a box's shadow, for each voxel of its sides
  for (int axis = 0; axis < 3; ++axis) {
    turn[axis] *= scale;
    widths[axis] = glm::abs(turn[axis]);
  }
  const glm::vec3 shape(page_shape);
  const glm::vec3 origin = (glm::vec3(view_from_voxel[3]) + glm::vec3(1.0F, -1.0F, 1.0F)) * scale;
  const glm::vec3 reach = widths * (0.5F * shape + 1.0F);
  for (const glm::ivec3& page : kinds.seen()) {
    const glm::vec3 middle = origin + turn * ((glm::vec3(page) + 0.5F) * shape - 0.5F);
    const glm::vec3 low = middle - reach;
    const glm::vec3 high = middle + reach;
    const auto begin = [](float at) {
      return std::max<std::int64_t>(static_cast<std::int64_t>(std::floor(at)), 0);
    };
    const auto end = [](float at, std::int64_t count) {
      return std::min(static_cast<std::int64_t>(std::floor(at)) + 1, count);
    };
    for (std::int64_t y = begin(low.y); y < end(high.y, rows); ++y) {
      for (std::int64_t x = begin(low.x); x < end(high.x, columns_); ++x) {
        glm::vec2& span = spans_[static_cast<std::size_t>(x + columns_ * y)];
        span = {std::min(span.x, low.z), std::max(span.y, high.z)};
      }
    }
  }
}

}  // namespace tidemark::renderer
