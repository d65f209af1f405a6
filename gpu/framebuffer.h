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
  // Into one layer of each.
  static Result<Framebuffer> create_on_layer(Device& device, std::int64_t layer,
                                             std::initializer_list<const TextureLayers*> colours,
                                             std::string_view label);
  // Drawing and reading go here from now on; the viewport covers it.
  void bind() const;
  // Copies a rectangle of the first texture into another one of the same format.
  void copy_to(const TexelRect& from, const Texture2D& to, std::int64_t x, std::int64_t y) const;
  // To the same place in a layer.
  void copy_to(const TexelRect& from, const TextureLayers& to, std::int64_t layer) const;

 private:
  // The framebuffer of textures of that size that are attached already.
  static Result<Framebuffer> finish(Device& device, FramebufferHandle handle, std::size_t colours,
                                    std::int64_t width, std::int64_t height, std::string_view label);

  FramebufferHandle handle_;
  std::int64_t width_ = 0;
  std::int64_t height_ = 0;
};

}  // namespace tidemark::gpu
