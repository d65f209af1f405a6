// Textures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/geometry.h"
#include "gpu/buffer.h"
#include "gpu/handles.h"

namespace tidemark::gpu {

enum class TexelFormat {
  r32f,
  rgba32f,
  r16f,
  rgba16f,
  r8,
  rgba8,
  r16i,
  r16ui,
  r8ui,
  r32i,
  rg32f,
  r16_snorm,
  r16_unorm
};
enum class Filter { nearest, linear };

std::int64_t bytes_per_texel(TexelFormat format);

// A rectangle of texels.
struct TexelRect {
  std::int64_t x = 0, y = 0, width = 0, height = 0;
};

// A 2D texture. Rows lie at increasing y; data is packed without gaps.
class Texture2D {
 public:
  Texture2D() = default;
  // Fails (ErrorKind::capability) when memory is short or the size is beyond the driver's limit. With
  // `mipmaps`, a full chain of levels is kept.
  static Result<Texture2D> create(Device& device, TexelFormat format, std::int64_t width, std::int64_t height,
                                  std::string_view label, bool mipmaps = false);

  [[nodiscard]] unsigned id() const { return handle_.id(); }
  [[nodiscard]] std::int64_t width() const { return width_; }
  [[nodiscard]] std::int64_t height() const { return height_; }
  [[nodiscard]] TexelFormat format() const { return format_; }
  [[nodiscard]] std::int64_t bytes() const { return width_ * height_ * bytes_per_texel(format_); }

  // `data` has the format's own component type, as many components as it has channels.
  void upload(const TexelRect& rect, std::span<const std::byte> data);
  // Waits for the GPU.
  Status download(const TexelRect& rect, std::span<std::byte> data, int level = 0) const;
  // With mipmaps: the levels up to this one are all there are.
  void limit_levels(int last);
  void generate_mipmaps();

  // How texture() reads between texels; nearest at first. Not with mipmaps.
  void set_filter(Filter filter);

  void bind(unsigned unit) const;

 private:
  TextureHandle handle_;
  TexelFormat format_ = TexelFormat::r32f;
  std::int64_t width_ = 0;
  std::int64_t height_ = 0;
};

// Layers of one size, each as a 2D texture, that shaders read as one sampler2DArray without filtering.
class TextureLayers {
 public:
  TextureLayers() = default;
  // Fails (ErrorKind::capability) when memory is short or a size is beyond the driver's limit.
  static Result<TextureLayers> create(Device& device, TexelFormat format, std::int64_t width,
                                      std::int64_t height, std::int64_t layers, std::string_view label);

  [[nodiscard]] unsigned id() const { return handle_.id(); }
  [[nodiscard]] std::int64_t width() const { return width_; }
  [[nodiscard]] std::int64_t height() const { return height_; }
  [[nodiscard]] std::int64_t layers() const { return layers_; }
  [[nodiscard]] std::int64_t bytes() const { return width_ * height_ * layers_ * bytes_per_texel(format_); }

  // As those of Texture2D, in a layer.
  void upload(std::int64_t layer, const TexelRect& rect, std::span<const std::byte> data);
  Status download(std::int64_t layer, const TexelRect& rect, std::span<std::byte> data) const;

  void bind(unsigned unit) const;
  void bind_image(unsigned unit, bool writable) const;  // image2DArray; OpenGL 4.2

 private:
  TextureHandle handle_;
  TexelFormat format_ = TexelFormat::r32f;
  std::int64_t width_ = 0;
  std::int64_t height_ = 0;
  std::int64_t layers_ = 0;
};

// A 3D texture, x fastest.
class Texture3D {
 public:
  Texture3D() = default;
  // Without data the texels hold anything.
  static Result<Texture3D> create(Device& device, TexelFormat format, Index3 size,
                                  std::span<const std::byte> data, std::string_view label,
                                  Filter filter = Filter::nearest);

  // Replaces the texels of a box.
  void upload(Index3 first, Index3 size, std::span<const std::byte> data);

  [[nodiscard]] unsigned id() const { return handle_.id(); }
  void bind(unsigned unit) const;

 private:
  TextureHandle handle_;
  TexelFormat format_ = TexelFormat::r32f;
};

// A buffer that shaders of OpenGL 3.3 fetch from, as isamplerBuffer (r32i) or samplerBuffer (rg32f, rgba32f).
// It follows what is written to the buffer, and must not outlive it.
class BufferTexture {
 public:
  BufferTexture() = default;
  static Result<BufferTexture> create(Device& device, const Buffer& buffer, TexelFormat format,
                                      std::string_view label);
  void bind(unsigned unit) const;

 private:
  TextureHandle handle_;
};

}  // namespace tidemark::gpu
