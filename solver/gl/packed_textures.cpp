#include "solver/gl/packed_textures.h"

#include <utility>

#include "gpu/framebuffer.h"

namespace tidemark::solver {

Result<PackedTextures> PackedTextures::create(gpu::Device& device, const PackedLayout& layout,
                                              std::int64_t capacity, std::vector<gpu::TexelFormat> formats,
                                              std::string label) {
  if (capacity > layout.largest_capacity()) {
    return fail(ErrorKind::capability, "the surface needs {} pages; this driver's textures hold {}", capacity,
                layout.largest_capacity());
  }
  PackedTextures packed;
  packed.layout_ = layout;
  packed.formats_ = std::move(formats);
  packed.label_ = std::move(label);
  packed.capacity_ = layout.rounded_up(capacity);
  const Index3 size = layout.texture_size(capacity);
  for (const gpu::TexelFormat format : packed.formats_) {
    auto made = gpu::TextureLayers::create(device, format, size.x, size.y, size.z, packed.label_);
    if (!made) return pass_on(made);
    packed.textures_.push_back(std::move(*made));
  }
  return packed;
}

std::int64_t PackedTextures::bytes_for(std::int64_t capacity) const {
  const Index3 size = layout_.texture_size(capacity);
  std::int64_t bytes = 0;
  for (const gpu::TexelFormat format : formats_)
    bytes += size.x * size.y * size.z * gpu::bytes_per_texel(format);
  return bytes;
}

Status PackedTextures::grow(gpu::Device& device, std::int64_t capacity) {
  auto larger = create(device, layout_, capacity, formats_, label_);
  if (!larger) return pass_on(larger);
  for (std::size_t texture = 0; texture < textures_.size(); ++texture) {
    const gpu::TextureLayers& old = textures_[texture];
    for (std::int64_t layer = 0; layer < old.layers(); ++layer) {
      auto source = gpu::Framebuffer::create_on_layer(device, layer, {&old}, "growing");
      if (!source) return pass_on(source);
      source->copy_to({0, 0, old.width(), old.height()}, larger->textures_[texture], layer);
    }
  }
  TIDEMARK_TRY(device.check("growing physical memory"));
  *this = std::move(*larger);
  return {};
}

// Pages that follow each other lie side by side, and are written together.
void PackedTextures::upload(std::size_t texture, std::span<const PhysicalPage> pages, const Texels& texels) {
  const std::int64_t texel_bytes = gpu::bytes_per_texel(formats_[texture]);
  const glm::i64vec2 tile = layout_.tile();
  std::vector<std::byte> tiles;
  for (std::size_t first = 0; first < pages.size();) {
    std::size_t end = first + 1;
    while (end < pages.size() && pages[end] == pages[end - 1] + 1 &&
           layout_.row(pages[end]) == layout_.row(pages[first]))
      ++end;
    const std::int64_t row_length = tile.x * static_cast<std::int64_t>(end - first);
    tiles.resize(static_cast<std::size_t>(row_length * tile.y * texel_bytes));
    std::byte* to = tiles.data();
    for (std::size_t i = first; i < end; ++i, to += tile.x * texel_bytes)
      layout_.pack(texels(i), to, row_length, texel_bytes);
    gpu::TexelRect rect = layout_.rect(pages[first]);
    rect.width = row_length;
    textures_[texture].upload(layout_.layer(pages[first]), rect, tiles);
    first = end;
  }
}

void PackedTextures::upload_tile(std::size_t texture, PhysicalPage page, std::span<const std::byte> tile) {
  textures_[texture].upload(layout_.layer(page), layout_.rect(page), tile);
}

}  // namespace tidemark::solver
