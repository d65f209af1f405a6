// The place of a page's voxels in physical memory G, one or more 2D textures: the C++ side of
// resources/shaders/solver/paging.glsl.
#pragma once

#include <glm/vec2.hpp>

#include "core/paging/page_layout.h"
#include "gpu/capabilities.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "solver/paging/page_table.h"

namespace tidemark::solver {

// The slices of a page lie side by side in a tile of texels, in rows as nearly square as can be: 32 x 16 for
// (8,8,8), 16 x 16 for (16,16,1). Tiles follow each other in rows. G grows by whole rows of tiles, and where
// a texture cannot be higher, by whole layers of an array of textures.
class PackedLayout {
 public:
  PackedLayout() = default;
  PackedLayout(const PageLayout& layout, const gpu::Capabilities& limits);

  [[nodiscard]] const PageLayout& layout() const { return layout_; }
  [[nodiscard]] glm::i64vec2 tile() const { return tile_; }                  // texels
  [[nodiscard]] std::int64_t tile_columns() const { return tile_columns_; }  // slices side by side
  [[nodiscard]] std::int64_t pages_per_row() const { return pages_per_row_; }
  [[nodiscard]] std::int64_t rows_per_layer() const { return rows_per_layer_; }  // of a full one
  // The most physical pages that the driver's textures hold.
  [[nodiscard]] std::int64_t largest_capacity() const { return pages_per_layer() * most_layers_; }

  // The row of tiles and the layer that hold a page, and its texels there.
  [[nodiscard]] std::int64_t row(PhysicalPage page) const { return page / pages_per_row_; }
  [[nodiscard]] std::int64_t layer(PhysicalPage page) const { return page / pages_per_layer(); }
  [[nodiscard]] gpu::TexelRect rect(PhysicalPage page) const;
  // `capacity` rounded up to what G grows by, and the layers that hold so many pages: width and height in
  // texels, and how many.
  [[nodiscard]] std::int64_t rounded_up(std::int64_t capacity) const;
  // Room for `needed` pages and for as many of those that may follow as have room in the same layers.
  [[nodiscard]] std::int64_t ample(std::int64_t needed, std::int64_t wanted) const;
  [[nodiscard]] Index3 texture_size(std::int64_t capacity) const;
  // At least `capacity`, so that no texture's height is a power of two before its layer is full: llvmpipe
  // compiles anew for those.
  [[nodiscard]] std::int64_t without_power_of_two(std::int64_t capacity) const;

  // Copies a page's voxels (i fastest) to its tile, whose rows are `row_length` values long, and back.
  void pack(const float* voxels, float* tile, std::int64_t row_length) const {
    pack(voxels, tile, row_length, sizeof(float));
  }
  void pack(const void* voxels, void* tile, std::int64_t row_length, std::int64_t value_bytes) const;
  void unpack(const float* tile, std::int64_t row_length, float* voxels) const;

  // The defines and the uniforms of paging.glsl.
  [[nodiscard]] gpu::Defines defines() const;
  void set_uniforms(const gpu::Program& program) const;

 private:
  [[nodiscard]] std::int64_t pages_per_layer() const { return pages_per_row_ * rows_per_layer_; }

  PageLayout layout_;
  std::int64_t tile_columns_ = 1;
  glm::i64vec2 tile_{1};
  std::int64_t pages_per_row_ = 1;
  std::int64_t rows_per_layer_ = 1;
  std::int64_t most_layers_ = 1;
};

}  // namespace tidemark::solver
