#include "gpu/framebuffer.h"

#include <algorithm>
#include <vector>

#include "gpu/gl.h"
#include "gpu/label.h"

namespace tidemark::gpu {

Result<Framebuffer> Framebuffer::create(Device& device, std::initializer_list<const Texture2D*> colours,
                                        std::string_view label, int level) {
  GLuint id = 0;
  glGenFramebuffers(1, &id);
  Framebuffer framebuffer;
  framebuffer.handle_ = FramebufferHandle(device, id);
  const Texture2D& first = **colours.begin();
  framebuffer.width_ = std::max<std::int64_t>(1, first.width() >> level);
  framebuffer.height_ = std::max<std::int64_t>(1, first.height() >> level);
  glBindFramebuffer(GL_FRAMEBUFFER, id);
  std::vector<GLenum> buffers;
  for (const Texture2D* colour : colours) {
    const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(buffers.size());
    glFramebufferTexture2D(GL_FRAMEBUFFER, attachment, GL_TEXTURE_2D, colour->id(), level);
    buffers.push_back(attachment);
  }
  glDrawBuffers(static_cast<GLsizei>(buffers.size()), buffers.data());
  set_label(device, GL_FRAMEBUFFER, id, label);
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    TIDEMARK_TRY(device.check("making a framebuffer"));
    return fail(ErrorKind::capability, "the graphics driver cannot draw into the texture of '{}'", label);
  }
  return framebuffer;
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

}  // namespace tidemark::gpu
