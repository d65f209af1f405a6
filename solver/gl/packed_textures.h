// Physical memory on the GPU: the texels of pages, packed in textures.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "gpu/texture.h"
#include "solver/gl/packed_layout.h"

namespace tidemark::solver {

// One texture or more, each of a format of its own; a page lies at the same place in all of them. Pages that
// were not written hold anything.
class PackedTextures {
 public:
  PackedTextures() = default;
  // Room for at least `capacity` physical pages. Fails (ErrorKind::capability) when the driver's textures or
  // its memory are too small.
  static Result<PackedTextures> create(gpu::Device& device, const PackedLayout& layout, std::int64_t capacity,
                                       std::vector<gpu::TexelFormat> formats, std::string label);
  // Enlarges them by copy. On failure they are as before.
  Status grow(gpu::Device& device, std::int64_t capacity);

  [[nodiscard]] const PackedLayout& layout() const { return layout_; }
  [[nodiscard]] std::int64_t capacity() const { return capacity_; }
  [[nodiscard]] std::int64_t bytes() const { return bytes_for(capacity_); }
  [[nodiscard]] std::int64_t bytes_for(std::int64_t capacity) const;
  [[nodiscard]] std::size_t count() const { return textures_.size(); }
  [[nodiscard]] const std::vector<gpu::TexelFormat>& formats() const { return formats_; }
  [[nodiscard]] const std::string& label() const { return label_; }
  [[nodiscard]] const gpu::TextureLayers& operator[](std::size_t texture) const { return textures_[texture]; }

  // Writes pages in one texture. `texels(i)` are those of the i-th page, x fastest, in the texture's format.
  using Texels = std::function<const void*(std::size_t i)>;
  void upload(std::size_t texture, std::span<const PhysicalPage> pages, const Texels& texels);
  // Writes the tile of one page.
  void upload_tile(std::size_t texture, PhysicalPage page, std::span<const std::byte> tile);

 private:
  PackedLayout layout_;
  std::vector<gpu::TexelFormat> formats_;
  std::string label_;
  std::int64_t capacity_ = 0;
  std::vector<gpu::TextureLayers> textures_;
};

}  // namespace tidemark::solver
