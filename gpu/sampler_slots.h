// The sampler slots, cleared so that a processor that plays the GPU compiles a program only once.
#pragma once

#include "gpu/draw.h"
#include "gpu/framebuffer.h"
#include "gpu/program.h"
#include "gpu/texture.h"

namespace tidemark::gpu {

// Mesa's llvmpipe compiles a fragment shader for the filters in its sampler slots. A buffer's texture has no
// filter: its slot keeps that of whichever program used the slot last, so that the same program is compiled
// again, for up to a second, when it follows another one than before.
class SamplerSlots {
 public:
  SamplerSlots() = default;
  static Result<SamplerSlots> create(Device& device);

  // Every slot has the filter of textures that are only fetched from. To be called before a program with
  // buffer textures is used; leaves other programs, framebuffers and vertex arrays in use. Does nothing on a
  // GPU.
  void clear() const;

 private:
  bool needed_ = false;
  Program program_;
  Texture2D texture_;
  Framebuffer framebuffer_;
  VertexArray vertices_;
};

}  // namespace tidemark::gpu
