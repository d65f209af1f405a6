// The place of a page's voxels in physical memory G, a 2D texture: the C++ side of
// resources/shaders/solver/paging.glsl.
#pragma once

#include <glm/vec2.hpp>

#include "gpu/program.h"
#include "gpu/texture.h"
#include "solver/paging/page_layout.h"
#include "solver/paging/page_table.h"

namespace tidemark::solver {

// The slices of a page lie side by side in a tile of texels, in rows as nearly square as can be: 32 x 16 for
// (8,8,8), 16 x 16 for (16,16,1). Tiles follow each other in rows; G grows by whole rows of tiles.
class PackedLayout {
 public:
  PackedLayout() = default;
  // `largest_texture`: texels along an axis that the driver allows.
  PackedLayout(const PageLayout& layout, std::int64_t largest_texture);

  [[nodiscard]] const PageLayout& layout() const { return layout_; }
  [[nodiscard]] glm::i64vec2 tile() const { return tile_; }  // texels
  [[nodiscard]] std::int64_t pages_per_row() const { return pages_per_row_; }
  // The most physical pages that the driver's textures hold.
  [[nodiscard]] std::int64_t largest_capacity() const {
    return pages_per_row_ * (largest_texture_ / tile_.y);
  }

  // The texels of a page.
  [[nodiscard]] gpu::TexelRect rect(PhysicalPage page) const;
  // `capacity` rounded up to whole rows, and the texture that holds so many pages.
  [[nodiscard]] std::int64_t whole_rows(std::int64_t capacity) const;
  [[nodiscard]] glm::i64vec2 texture_size(std::int64_t capacity) const;

  // Copies a page's voxels (i fastest) to its tile, whose rows are `row_length` values long, and back.
  void pack(const float* voxels, float* tile, std::int64_t row_length) const;
  void unpack(const float* tile, std::int64_t row_length, float* voxels) const;

  // The defines and the uniforms of paging.glsl.
  [[nodiscard]] gpu::Defines defines() const;
  void set_uniforms(const gpu::Program& program) const;

 private:
  PageLayout layout_;
  std::int64_t largest_texture_ = 0;
  std::int64_t tile_columns_ = 1;  // slices side by side
  glm::i64vec2 tile_{1};
  std::int64_t pages_per_row_ = 1;
};

}  // namespace tidemark::solver
