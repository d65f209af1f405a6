// What pictures are drawn from: the source, phi's pages and what lets rays skip, on the GPU.
#pragma once

#include "core/thread_pool.h"
#include "core/volume.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "solver/field.h"
#include "solver/gl/packed_field.h"

namespace tidemark {

// The source as a texture that the hardware filters, and the range of its values in each page of V_P.
class SourcePicture {
 public:
  SourcePicture() = default;
  static Result<SourcePicture> create(gpu::Device& device, const Volume& source, const PageLayout& layout,
                                      ThreadPool& pool);
  // The uniforms of render/source.glsl, and page_range on the next unit.
  void set_uniforms(const gpu::Program& program, int unit) const;

 private:
  gpu::Texture3D texture_;
  gpu::Buffer range_buffer_;
  gpu::BufferTexture ranges_;
  glm::vec2 scale_{1.0F, 0.0F};
};

// phi in packed pages with its page table, for solver/phi.glsl.
class PhiPicture {
 public:
  PhiPicture() = default;
  static Result<PhiPicture> create(gpu::Device& device, const Field& phi);
  void set_uniforms(const gpu::Program& program, int unit) const;
  [[nodiscard]] const PackedLayout& layout() const { return field_.layout(); }

 private:
  PackedField field_;
  gpu::Buffer table_buffer_;
  gpu::BufferTexture table_;
  float band_ = 0.0F;
};

}  // namespace tidemark
