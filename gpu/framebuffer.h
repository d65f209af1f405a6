// Framebuffers over textures, and the vertex arrays that drawing needs.
#pragma once

#include <initializer_list>
#include <string_view>

#include "gpu/handles.h"
#include "gpu/texture.h"

namespace tidemark::gpu {

// Draws into one or more textures of the same size. The textures must outlive it.
class Framebuffer {
 public:
  Framebuffer() = default;
  static Result<Framebuffer> create(Device& device, std::initializer_list<const Texture2D*> colours,
                                    std::string_view label, int level = 0);
  // Drawing and reading go here from now on; the viewport covers it.
  void bind() const;
  // Copies a rectangle of the first texture into another one of the same format.
  void copy_to(const TexelRect& from, const Texture2D& to, std::int64_t x, std::int64_t y) const;

 private:
  FramebufferHandle handle_;
  std::int64_t width_ = 0;
  std::int64_t height_ = 0;
};

}  // namespace tidemark::gpu
