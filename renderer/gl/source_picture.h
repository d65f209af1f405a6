// The source volume for pictures: its texture, and its opacity page by page.
#pragma once

#include <vector>

#include "core/volume.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "renderer/page_opacity.h"

namespace tidemark::renderer {

// The source as a texture that the hardware filters, and how opaque it is at most in each page of V_P, so
// that rays and slices skip pages that show nothing.
class SourcePicture {
 public:
  SourcePicture() = default;
  // Volumes with more voxels along an axis than the driver allows get no texture. Fails
  // (ErrorKind::capability) when memory is short.
  static Result<SourcePicture> create(gpu::Device& device, const Volume& source, const PageLayout& layout);

  // Whether there is a texture. If not, pictures are made from slices (SourceStack, source_on_plane()).
  [[nodiscard]] bool has_volume() const { return has_volume_; }

  // Sets the transfer function, region and band from which page_opacities() are computed.
  void set_transfer_function(const Volume& source, const TransferFunction& function, Region region,
                             double band);

  // The greatest opacity of each page by that function: outside throughout, inside throughout, mixed.
  [[nodiscard]] const std::vector<glm::vec4>& page_opacities() const { return opacity_.pages(); }

  // The uniforms of render/source.glsl, and page_opacity on the next unit.
  void set_uniforms(const gpu::Program& program, int unit) const;

 private:
  gpu::Texture3D texture_;
  bool has_volume_ = false;
  PageOpacity opacity_;
  gpu::Buffer opacity_buffer_;
  gpu::BufferTexture opacities_;
  glm::vec3 unit_{1.0F};
  glm::vec2 scale_{1.0F, 0.0F};
};

}  // namespace tidemark::renderer
