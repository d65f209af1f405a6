// The source volume as pictures are drawn from it.
#pragma once

#include <optional>
#include <vector>

#include "core/thread_pool.h"
#include "core/volume.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "renderer/views.h"
#include "solver/paging/page_layout.h"

namespace tidemark {

// The source as a texture that the hardware filters, and how opaque it is at most in each page of V_P, so
// that rays skip pages that show nothing.
class SourcePicture {
 public:
  SourcePicture() = default;
  // Fails (ErrorKind::capability) when the volume is beyond the driver's limit or its memory.
  static Result<SourcePicture> create(gpu::Device& device, const Volume& source, const PageLayout& layout,
                                      ThreadPool& pool);

  // From now on the transfer function, for that region and that band, says what pages show.
  void set_transfer_function(const TransferFunction& function, Region region, double band);

  // The uniforms of render/source.glsl, and page_opacity on the next unit.
  void set_uniforms(const gpu::Program& program, int unit) const;

 private:
  gpu::Texture3D texture_;
  std::vector<glm::vec2> ranges_;  // least and greatest value in each page, and one voxel around
  gpu::Buffer opacity_buffer_;
  gpu::BufferTexture opacities_;
  struct Shown {
    TransferFunction function;
    Region region;
    double band;
    bool operator==(const Shown&) const = default;
  };
  std::optional<Shown> shown_;
  glm::vec3 unit_{1.0F};
  glm::vec2 scale_{1.0F, 0.0F};
};

}  // namespace tidemark
