#include "renderer/host/ray_spans.h"

#include <algorithm>
#include <limits>

namespace tidemark::renderer {

RaySpans::RaySpans(const PageKinds& kinds, glm::ivec3 page_shape, const glm::mat4& voxel_from_view,
                   PictureSize size) {
  constexpr float kFar = std::numeric_limits<float>::max();
  const PageShadows shadows(page_shape, 1.0F, voxel_from_view, size);
  columns_ = shadows.columns();
  spans_.assign(static_cast<std::size_t>(columns_ * shadows.rows()), {kFar, -kFar});
  for (const glm::ivec3& page : kinds.seen()) {
    const PageShadows::Shadow shadow = shadows.of(page);
    for (std::int64_t y = shadow.top; y < shadow.bottom; ++y) {
      for (std::int64_t x = shadow.left; x < shadow.right; ++x) {
        glm::vec2& span = spans_[static_cast<std::size_t>(x + columns_ * y)];
        span = {std::min(span.x, shadow.nearest), std::max(span.y, shadow.farthest)};
      }
    }
  }
}

}  // namespace tidemark::renderer
