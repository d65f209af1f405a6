// The content of V_P's pages for a picture: rays cross those that show nothing in one stride.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "renderer/host/host_scene.h"

namespace tidemark::renderer {

class PageKinds {
 public:
  // Bits of a page's kind.
  static constexpr std::uint8_t kSource = 1;  // the source shows in it
  static constexpr std::uint8_t kPhi = 2;     // phi varies in it, and the view needs phi

  // For a view that is resolved().
  PageKinds(HostScene& scene, const VolumeView& view);

  [[nodiscard]] std::uint8_t operator[](int page) const { return kinds_[static_cast<std::size_t>(page)]; }
  // Whether none of the pages around it, a cube of kSide pages aligned with kSide, has a kind.
  static constexpr int kSide = 4;
  [[nodiscard]] bool cube_is_empty(glm::ivec3 page) const {
    const glm::ivec3 cube = page / kSide;
    return cubes_[static_cast<std::size_t>(cube.x + cube_grid_.x * (cube.y + cube_grid_.y * cube.z))] == 0;
  }

 private:
  glm::ivec3 cube_grid_{0};
  std::vector<std::uint8_t> kinds_;
  std::vector<std::uint8_t> cubes_;
};

}  // namespace tidemark::renderer
