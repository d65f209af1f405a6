// The shadows of V_P's pages in a picture: the blocks of pixels whose rays cross a page.
#pragma once

#include <cstdint>
#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include "renderer/picture.h"

namespace tidemark::renderer {

class PageShadows {
 public:
  static constexpr std::int64_t kBlock = 8;  // pixels a side

  // In a parallel view, of pages with so many voxels around each.
  PageShadows(glm::ivec3 page_shape, float around, const glm::mat4& voxel_from_view, PictureSize size);

  // In blocks, inside of the picture, the ends not included; along the rays in voxels from where the view
  // begins.
  struct Shadow {
    std::int64_t left, right, top, bottom;
    float nearest, farthest;
  };
  [[nodiscard]] Shadow of(glm::ivec3 page) const;

  [[nodiscard]] std::int64_t columns() const { return columns_; }
  [[nodiscard]] std::int64_t rows() const { return rows_; }

 private:
  std::int64_t columns_;
  std::int64_t rows_;
  glm::vec3 shape_;
  glm::mat3 turn_{1.0F};  // from voxels to blocks from the top left, and to voxels along the rays
  glm::vec3 origin_{0.0F};
  glm::vec3 reach_{0.0F};  // of a page's shadow from its middle
};

}  // namespace tidemark::renderer
