#include "solver/gl/packed_layout.h"

#include <algorithm>
#include <bit>

namespace tidemark::solver {

PackedLayout::PackedLayout(const PageLayout& layout, const gpu::Capabilities& limits) : layout_(layout) {
  const Index3 shape = layout.page_shape();
  std::int64_t least = -1;
  for (std::int64_t columns = 1; columns <= shape.z; ++columns) {
    if (shape.z % columns != 0) continue;
    const std::int64_t difference = std::abs(shape.x * columns - shape.y * (shape.z / columns));
    if (least >= 0 && difference > least) continue;
    least = difference;
    tile_columns_ = columns;
  }
  tile_ = {shape.x * tile_columns_, shape.y * (shape.z / tile_columns_)};
  // As few pages a row as the height allows: G then grows in small steps.
  constexpr std::int64_t kLeastPagesPerRow = 16;
  const std::int64_t most_per_row = std::max<std::int64_t>(1, limits.largest_texture / tile_.x);
  rows_per_layer_ = std::max<std::int64_t>(1, limits.largest_texture / tile_.y);
  const std::int64_t pages = layout.page_count() + kFirstPage;
  pages_per_row_ = std::clamp((pages + rows_per_layer_ - 1) / rows_per_layer_,
                              std::min(kLeastPagesPerRow, most_per_row), most_per_row);
  // A texture with a texel for each page has all rows one below the other.
  most_layers_ = std::clamp<std::int64_t>(limits.largest_texture / rows_per_layer_, 1,
                                          std::max<std::int64_t>(1, limits.largest_layers));
}

gpu::TexelRect PackedLayout::rect(PhysicalPage page) const {
  return {page % pages_per_row_ * tile_.x, row(page) % rows_per_layer_ * tile_.y, tile_.x, tile_.y};
}

std::int64_t PackedLayout::rounded_up(std::int64_t capacity) const {
  const std::int64_t unit = capacity <= pages_per_layer() ? pages_per_row_ : pages_per_layer();
  return (capacity + unit - 1) / unit * unit;
}

std::int64_t PackedLayout::ample(std::int64_t needed, std::int64_t wanted) const {
  const std::int64_t layers = (needed + pages_per_layer() - 1) / pages_per_layer();
  return rounded_up(std::clamp(wanted, needed, std::max(needed, layers * pages_per_layer())));
}

Index3 PackedLayout::texture_size(std::int64_t capacity) const {
  const std::int64_t rows = rounded_up(capacity) / pages_per_row_;
  const std::int64_t layers = (rows + rows_per_layer_ - 1) / rows_per_layer_;
  return {pages_per_row_ * tile_.x, std::min(rows, rows_per_layer_) * tile_.y, layers};
}

std::int64_t PackedLayout::without_power_of_two(std::int64_t capacity) const {
  while (std::has_single_bit(static_cast<std::uint64_t>(texture_size(capacity).y)) &&
         texture_size(capacity + pages_per_row_).z == 1) {
    capacity += pages_per_row_;
  }
  return std::min(capacity, largest_capacity());
}

void PackedLayout::pack(const void* voxels, void* tile, std::int64_t row_length,
                        std::int64_t value_bytes) const {
  const Index3 shape = layout_.page_shape();
  const auto* from = static_cast<const std::byte*>(voxels);
  for (std::int64_t z = 0; z < shape.z; ++z) {
    const std::int64_t slice = z % tile_columns_ * shape.x + z / tile_columns_ * shape.y * row_length;
    auto* to = static_cast<std::byte*>(tile) + slice * value_bytes;
    for (std::int64_t y = 0; y < shape.y; ++y) {
      to = std::copy_n(from, shape.x * value_bytes, to) + (row_length - shape.x) * value_bytes;
      from += shape.x * value_bytes;
    }
  }
}

void PackedLayout::unpack(const float* tile, std::int64_t row_length, float* voxels) const {
  const Index3 shape = layout_.page_shape();
  for (std::int64_t z = 0; z < shape.z; ++z) {
    const float* slice = tile + z % tile_columns_ * shape.x + z / tile_columns_ * shape.y * row_length;
    for (std::int64_t y = 0; y < shape.y; ++y) {
      std::copy_n(slice + y * row_length, shape.x, voxels + (y + shape.y * z) * shape.x);
    }
  }
}

gpu::Defines PackedLayout::defines() const {
  const Index3 shape = layout_.page_shape();
  return {{"PAGE_X", fmt::to_string(shape.x)},
          {"PAGE_Y", fmt::to_string(shape.y)},
          {"PAGE_Z", fmt::to_string(shape.z)},
          {"TILE_COLUMNS", fmt::to_string(tile_columns_)},
          {"PAGES_PER_ROW", fmt::to_string(pages_per_row_)},
          {"ROWS_PER_LAYER", fmt::to_string(rows_per_layer_)}};
}

void PackedLayout::set_uniforms(const gpu::Program& program) const {
  program.set("volume_size", glm::ivec3(layout_.domain_size()));
  program.set("page_grid", glm::ivec3(layout_.pages()));
}

}  // namespace tidemark::solver
