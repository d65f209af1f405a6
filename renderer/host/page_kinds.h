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
  // Beyond these bits: how many steps long a piece may be where the source is so faint that no picture shows
  // the difference.
  static constexpr int kStrideShift = 2;
  [[nodiscard]] static float stride(std::uint8_t kind) {
    return static_cast<float>(1 << (kind >> kStrideShift));
  }

  // For a view that is resolved(), whose steps have that length; with labels where it shows some.
  PageKinds(HostScene& scene, const VolumeView& view, float step_mm);

  [[nodiscard]] std::uint8_t operator[](int page) const { return kinds_[static_cast<std::size_t>(page)]; }
  // Whether none of the pages around it, a cube of kSide pages aligned with kSide, has a kind.
  static constexpr int kSide = 4;
  [[nodiscard]] bool cube_is_empty(glm::ivec3 page) const {
    const glm::ivec3 cube = page / kSide;
    return cubes_[static_cast<std::size_t>(number_in(cube_grid_, cube))] == 0;
  }
  // The pages in which there may be something to see; with Quality::skip_empty off all of them.
  [[nodiscard]] const std::vector<glm::ivec3>& seen() const { return seen_; }

 private:
  glm::ivec3 cube_grid_{0};
  std::vector<std::uint8_t> kinds_;
  std::vector<std::uint8_t> cubes_;
  std::vector<glm::ivec3> seen_;
};

}  // namespace tidemark::renderer
