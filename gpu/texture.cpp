#include "gpu/texture.h"

#include "gpu/framebuffer.h"
#include "gpu/gl.h"
#include "gpu/label.h"

namespace tidemark::gpu {
namespace {

struct GlFormat {
  GLenum internal, format, type;
  std::int64_t bytes;
};

GlFormat gl_format(TexelFormat format) {
  switch (format) {
    case TexelFormat::r32f:
      return {GL_R32F, GL_RED, GL_FLOAT, 4};
    case TexelFormat::rgba32f:
      return {GL_RGBA32F, GL_RGBA, GL_FLOAT, 16};
    case TexelFormat::r16f:
      return {GL_R16F, GL_RED, GL_HALF_FLOAT, 2};
    case TexelFormat::rgba16f:
      return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, 8};
    case TexelFormat::r8:
      return {GL_R8, GL_RED, GL_UNSIGNED_BYTE, 1};
    case TexelFormat::rgba8:
      return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, 4};
    case TexelFormat::r16i:
      return {GL_R16I, GL_RED_INTEGER, GL_SHORT, 2};
    case TexelFormat::r16ui:
      return {GL_R16UI, GL_RED_INTEGER, GL_UNSIGNED_SHORT, 2};
    case TexelFormat::r8ui:
      return {GL_R8UI, GL_RED_INTEGER, GL_UNSIGNED_BYTE, 1};
    case TexelFormat::r32i:
      return {GL_R32I, GL_RED_INTEGER, GL_INT, 4};
    case TexelFormat::rg32f:
      return {GL_RG32F, GL_RG, GL_FLOAT, 8};
    case TexelFormat::r16_snorm:
      return {GL_R16_SNORM, GL_RED, GL_SHORT, 2};
    case TexelFormat::r16_unorm:
      return {GL_R16, GL_RED, GL_UNSIGNED_SHORT, 2};
  }
  return {};
}

void fetch_only(GLenum target, bool mipmaps) {
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, mipmaps ? GL_NEAREST_MIPMAP_NEAREST : GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(target, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glTexParameteri(target, GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
}

// Textures are made and written on a unit of their own, so that textures bound for drawing stay bound.
void bind_for_editing(GLenum target, GLuint id) {
  constexpr GLenum kUnit = GL_TEXTURE0 + 15;
  glActiveTexture(kUnit);
  glBindTexture(target, id);
}

unsigned new_texture(GLenum target) {
  GLuint id = 0;
  glGenTextures(1, &id);
  bind_for_editing(target, id);
  return id;
}

Status check_size(const Device& device, std::int64_t width, std::int64_t height) {
  const std::int64_t limit = device.capabilities().largest_texture;
  if (width <= limit && height <= limit) return {};
  return fail(ErrorKind::capability, "a texture of {} x {} is needed; this driver allows {} along an axis",
              width, height, limit);
}

// From the first texture of a framebuffer, which is bound.
Status read_texels(Device& device, const GlFormat& gl, const TexelRect& rect, std::span<std::byte> data) {
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glReadPixels(static_cast<GLint>(rect.x), static_cast<GLint>(rect.y), static_cast<GLsizei>(rect.width),
               static_cast<GLsizei>(rect.height), gl.format, gl.type, data.data());
  return device.check("reading a texture");
}

}  // namespace

std::int64_t bytes_per_texel(TexelFormat format) {
  return gl_format(format).bytes;
}

Result<Texture2D> Texture2D::create(Device& device, TexelFormat format, std::int64_t width,
                                    std::int64_t height, std::string_view label, bool mipmaps) {
  TIDEMARK_TRY(check_size(device, width, height));
  TIDEMARK_TRY(device.check("allocating a texture"));
  Texture2D texture;
  texture.handle_ = TextureHandle(device, new_texture(GL_TEXTURE_2D));
  texture.format_ = format;
  texture.width_ = width;
  texture.height_ = height;
  const GlFormat gl = gl_format(format);
  fetch_only(GL_TEXTURE_2D, mipmaps);
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(gl.internal), static_cast<GLsizei>(width),
               static_cast<GLsizei>(height), 0, gl.format, gl.type, nullptr);
  if (mipmaps) {
    glGenerateMipmap(GL_TEXTURE_2D);
  } else {
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, 0);
  }
  set_label(device, GL_TEXTURE, texture.id(), label);
  TIDEMARK_TRY(device.check("allocating a texture"));
  return texture;
}

void Texture2D::upload(const TexelRect& rect, std::span<const std::byte> data) {
  const GlFormat gl = gl_format(format_);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  bind_for_editing(GL_TEXTURE_2D, id());
  glTexSubImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(rect.x), static_cast<GLint>(rect.y),
                  static_cast<GLsizei>(rect.width), static_cast<GLsizei>(rect.height), gl.format, gl.type,
                  data.data());
}

Status Texture2D::download(const TexelRect& rect, std::span<std::byte> data, int level) const {
  Device& device = handle_.device();
  auto source = Framebuffer::create(device, {this}, "download", level);
  if (!source) return pass_on(source);
  source->bind();
  return read_texels(device, gl_format(format_), rect, data);
}

void Texture2D::limit_levels(int last) {
  bind_for_editing(GL_TEXTURE_2D, id());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, last);
}

void Texture2D::generate_mipmaps() {
  bind_for_editing(GL_TEXTURE_2D, id());
  glGenerateMipmap(GL_TEXTURE_2D);
}

void Texture2D::set_filter(Filter filter) {
  const GLint way = filter == Filter::linear ? GL_LINEAR : GL_NEAREST;
  bind_for_editing(GL_TEXTURE_2D, id());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, way);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, way);
}

void Texture2D::bind(unsigned unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D, id());
}

Result<TextureLayers> TextureLayers::create(Device& device, TexelFormat format, std::int64_t width,
                                            std::int64_t height, std::int64_t layers,
                                            std::string_view label) {
  TIDEMARK_TRY(check_size(device, width, height));
  if (layers > device.capabilities().largest_layers) {
    return fail(ErrorKind::capability, "a texture of {} layers is needed; this driver allows {}", layers,
                device.capabilities().largest_layers);
  }
  TIDEMARK_TRY(device.check("allocating a texture"));
  TextureLayers texture;
  texture.handle_ = TextureHandle(device, new_texture(GL_TEXTURE_2D_ARRAY));
  texture.format_ = format;
  texture.width_ = width;
  texture.height_ = height;
  texture.layers_ = layers;
  const GlFormat gl = gl_format(format);
  fetch_only(GL_TEXTURE_2D_ARRAY, false);
  glTexParameteri(GL_TEXTURE_2D_ARRAY, GL_TEXTURE_MAX_LEVEL, 0);
  glTexImage3D(GL_TEXTURE_2D_ARRAY, 0, static_cast<GLint>(gl.internal), static_cast<GLsizei>(width),
               static_cast<GLsizei>(height), static_cast<GLsizei>(layers), 0, gl.format, gl.type, nullptr);
  set_label(device, GL_TEXTURE, texture.id(), label);
  TIDEMARK_TRY(device.check("allocating a texture"));
  return texture;
}

void TextureLayers::upload(std::int64_t layer, const TexelRect& rect, std::span<const std::byte> data) {
  const GlFormat gl = gl_format(format_);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  bind_for_editing(GL_TEXTURE_2D_ARRAY, id());
  glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, static_cast<GLint>(rect.x), static_cast<GLint>(rect.y),
                  static_cast<GLint>(layer), static_cast<GLsizei>(rect.width),
                  static_cast<GLsizei>(rect.height), 1, gl.format, gl.type, data.data());
}

Status TextureLayers::download(std::int64_t layer, const TexelRect& rect, std::span<std::byte> data) const {
  Device& device = handle_.device();
  auto source = Framebuffer::create_on_layer(device, layer, {this}, "download");
  if (!source) return pass_on(source);
  source->bind();
  return read_texels(device, gl_format(format_), rect, data);
}

void TextureLayers::bind(unsigned unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_2D_ARRAY, id());
}

void TextureLayers::bind_image(unsigned unit, bool writable) const {
  glBindImageTexture(unit, id(), 0, GL_TRUE, 0, writable ? GL_READ_WRITE : GL_READ_ONLY,
                     gl_format(format_).internal);
}

Result<Texture3D> Texture3D::create(Device& device, TexelFormat format, Index3 size,
                                    std::span<const std::byte> data, std::string_view label, Filter filter) {
  const std::int64_t limit = device.capabilities().largest_volume_texture;
  if (size.x > limit || size.y > limit || size.z > limit) {
    return fail(ErrorKind::capability,
                "a volume of {} x {} x {} voxels is needed as a texture; this driver allows {} along an axis",
                size.x, size.y, size.z, limit);
  }
  TIDEMARK_TRY(device.check("allocating a volume texture"));
  Texture3D texture;
  texture.handle_ = TextureHandle(device, new_texture(GL_TEXTURE_3D));
  texture.format_ = format;
  const GlFormat gl = gl_format(format);
  fetch_only(GL_TEXTURE_3D, false);
  if (filter == Filter::linear) {
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  }
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAX_LEVEL, 0);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  glTexImage3D(GL_TEXTURE_3D, 0, static_cast<GLint>(gl.internal), static_cast<GLsizei>(size.x),
               static_cast<GLsizei>(size.y), static_cast<GLsizei>(size.z), 0, gl.format, gl.type,
               data.data());
  set_label(device, GL_TEXTURE, texture.id(), label);
  TIDEMARK_TRY(device.check("allocating a volume texture"));
  return texture;
}

void Texture3D::upload(Index3 first, Index3 size, std::span<const std::byte> data) {
  const GlFormat gl = gl_format(format_);
  glBindBuffer(GL_PIXEL_UNPACK_BUFFER, 0);
  bind_for_editing(GL_TEXTURE_3D, id());
  glTexSubImage3D(GL_TEXTURE_3D, 0, static_cast<GLint>(first.x), static_cast<GLint>(first.y),
                  static_cast<GLint>(first.z), static_cast<GLsizei>(size.x), static_cast<GLsizei>(size.y),
                  static_cast<GLsizei>(size.z), gl.format, gl.type, data.data());
}

void Texture3D::bind(unsigned unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_3D, id());
}

Result<BufferTexture> BufferTexture::create(Device& device, const Buffer& buffer, TexelFormat format,
                                            std::string_view label) {
  const std::int64_t texels = buffer.bytes() / bytes_per_texel(format);
  if (texels > device.capabilities().largest_buffer_texture) {
    return fail(ErrorKind::capability, "a table of {} entries is needed; this driver allows {}", texels,
                device.capabilities().largest_buffer_texture);
  }
  BufferTexture texture;
  texture.handle_ = TextureHandle(device, new_texture(GL_TEXTURE_BUFFER));
  glTexBuffer(GL_TEXTURE_BUFFER, gl_format(format).internal, buffer.id());
  set_label(device, GL_TEXTURE, texture.handle_.id(), label);
  TIDEMARK_TRY(device.check("making a table readable"));
  return texture;
}

void BufferTexture::bind(unsigned unit) const {
  glActiveTexture(GL_TEXTURE0 + unit);
  glBindTexture(GL_TEXTURE_BUFFER, handle_.id());
}

}  // namespace tidemark::gpu
