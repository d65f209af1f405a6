// The eight voxels around a place between voxels, and their shares of what is there.
#pragma once

#include <glm/common.hpp>
#include <glm/vec3.hpp>

namespace tidemark::renderer {

// Beyond a volume of that size it is as at its border. Along an axis of one voxel the second corner has no
// share, and is outside.
struct Trilinear {
  glm::ivec3 low;
  glm::vec3 f;

  // Voxel coordinates, integers at voxel centres.
  Trilinear(glm::vec3 position, glm::ivec3 size) {
    const glm::vec3 p = glm::clamp(position, glm::vec3(0.0F), glm::vec3(size - 1));
    low = glm::min(glm::ivec3(p), glm::max(size - 2, glm::ivec3(0)));
    f = p - glm::vec3(low);
  }
  // Of corners 0 to 7, x fastest.
  [[nodiscard]] glm::ivec3 corner(int i) const { return low + glm::ivec3(i & 1, i >> 1 & 1, i >> 2); }
  [[nodiscard]] float share(int i) const {
    return (i & 1 ? f.x : 1.0F - f.x) * (i & 2 ? f.y : 1.0F - f.y) * (i & 4 ? f.z : 1.0F - f.z);
  }
  // Of the corners' values.
  [[nodiscard]] float mean(const float (&corner)[8]) const {
    const auto mix = [](float a, float b, float share) { return a + share * (b - a); };
    const float below = mix(mix(corner[0], corner[1], f.x), mix(corner[2], corner[3], f.x), f.y);
    const float above = mix(mix(corner[4], corner[5], f.x), mix(corner[6], corner[7], f.x), f.y);
    return mix(below, above, f.z);
  }
};

}  // namespace tidemark::renderer
