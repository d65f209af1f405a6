#include "gpu/framebuffer.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "gpu/gl.h"
#include "gpu/label.h"

namespace tidemark::gpu {

namespace {

// Bound.
FramebufferHandle new_framebuffer(Device& device) {
  GLuint id = 0;
  glGenFramebuffers(1, &id);
  FramebufferHandle handle(device, id);
  glBindFramebuffer(GL_FRAMEBUFFER, id);
  return handle;
}

}  // namespace

Result<Framebuffer> Framebuffer::finish(Device& device, FramebufferHandle handle, std::size_t colours,
                                        std::int64_t width, std::int64_t height, std::string_view label) {
  std::vector<GLenum> buffers(colours);
  for (std::size_t i = 0; i < colours; ++i) buffers[i] = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(i);
  glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  set_label(device, GL_FRAMEBUFFER, handle.id(), label);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    TIDEMARK_TRY(device.check("making a framebuffer"));
    return fail(ErrorKind::capability, "the graphics driver cannot draw into the texture of '{}'", label);
  }
  Framebuffer framebuffer;
  framebuffer.handle_ = std::move(handle);
  framebuffer.width_ = std::max<std::int64_t>(1, width);
  framebuffer.height_ = std::max<std::int64_t>(1, height);
  return framebuffer;
}

Result<Framebuffer> Framebuffer::create(Device& device, std::initializer_list<const Texture2D*> colours,
                                        std::string_view label, int level) {
  FramebufferHandle handle = new_framebuffer(device);
  GLenum attachment = GL_COLOR_ATTACHMENT0;
  for (const Texture2D* colour : colours) {
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment++, GL_TEXTURE_2D, colour->id(), level);
  }
  const Texture2D& first = **colours.begin();
  return finish(device, std::move(handle), colours.size(), first.width() >> level, first.height() >> level,
                label);
}

Result<Framebuffer> Framebuffer::create_on_layer(Device& device, std::int64_t layer,
                                                 std::initializer_list<const TextureLayers*> colours,
                                                 std::string_view label) {
  FramebufferHandle handle = new_framebuffer(device);
  GLenum attachment = GL_COLOR_ATTACHMENT0;
  for (const TextureLayers* colour : colours) {
    glFramebufferTextureLayer(GL_FRAMEBUFFER, attachment++, colour->id(), 0, static_cast<GLint>(layer));
  }
  const TextureLayers& first = **colours.begin();
  return finish(device, std::move(handle), colours.size(), first.width(), first.height(), label);
}

void Framebuffer::bind() const {
  glBindFramebuffer(GL_FRAMEBUFFER, handle_.id());
  glViewport(0, 0, static_cast<GLsizei>(width_), static_cast<GLsizei>(height_));
}

void Framebuffer::copy_to(const TexelRect& from, const Texture2D& to, std::int64_t x, std::int64_t y) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_.id());
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glBindTexture(GL_TEXTURE_2D, to.id());
  glCopyTexSubImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(x), static_cast<GLint>(y),
                      static_cast<GLint>(from.x), static_cast<GLint>(from.y),
                      static_cast<GLsizei>(from.width), static_cast<GLsizei>(from.height));
}

void Framebuffer::copy_to(const TexelRect& from, const TextureLayers& to, std::int64_t layer) const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, handle_.id());
  glReadBuffer(GL_COLOR_ATTACHMENT0);
  glBindTexture(GL_TEXTURE_2D_ARRAY, to.id());
  glCopyTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, static_cast<GLint>(from.x), static_cast<GLint>(from.y),
                      static_cast<GLint>(layer), static_cast<GLint>(from.x), static_cast<GLint>(from.y),
                      static_cast<GLsizei>(from.width), static_cast<GLsizei>(from.height));
}

}  // namespace tidemark::gpu
