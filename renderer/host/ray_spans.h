// The stretch of its rays in which a block of a picture's pixels may show anything: rays begin there, and a
// block that no page is in front of needs none.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "renderer/host/page_kinds.h"
#include "renderer/host/page_shadows.h"
#include "renderer/picture.h"

namespace tidemark::renderer {

class RaySpans {
 public:
  // From the corners of the pages that a parallel view shows (PageKinds::seen()), each with a voxel around
  // it: between pages phi belongs to both. Positions along a ray are in voxels from where the view begins.
  RaySpans(const PageKinds& kinds, glm::ivec3 page_shape, const glm::mat4& voxel_from_view, PictureSize size);

  // Nearest and farthest, of the block with that pixel; the nearest is behind the farthest where nothing is.
  [[nodiscard]] glm::vec2 at(std::int64_t x, std::int64_t y) const {
    return spans_[static_cast<std::size_t>(x / PageShadows::kBlock + columns_ * (y / PageShadows::kBlock))];
  }

 private:
  std::int64_t columns_ = 0;
  std::vector<glm::vec2> spans_;
};

}  // namespace tidemark::renderer
