// Labels as pictures are drawn from them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/paging/page_layout.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "renderer/label_volume.h"
#include "solver/gl/volume_blocks.h"

namespace tidemark::renderer {

// A label for each voxel, the labels' colours, and what each page shows of them, on the GPU.
class LabelPicture {
 public:
  LabelPicture() = default;
  // At first no voxel has a label, and all labels are seen in their first colours (core/label_colour.h).
  static Result<LabelPicture> create(gpu::Device& device, const PageLayout& layout);

  void set_voxels(const PagedBytes& voxels);
  // Of the labels from 0 on.
  void set_colours(std::span<const LabelColour> colours);

  [[nodiscard]] const LabelPages& pages() const { return volume_.pages(); }

  // Makes sure that shaders find what they look at: render/labels.glsl needs borders, slices do not. Fails
  // (ErrorKind::capability) when memory is short.
  Status prepare(gpu::Device& device, bool borders);

  // The variant of shaders, and the uniforms of render/labels.glsl and page_labels. Voxels take three units.
  struct Units {
    int colours, pages, voxels;
  };
  [[nodiscard]] gpu::Defines defines() const { return blocks_.defines(); }
  void set_uniforms(const gpu::Program& program, const Units& units) const;

 private:
  void add_to_upload(const VoxelRange& box);
  Status upload(gpu::Device& device, const VoxelRange& box);
  void upload_pages();

  LabelVolume volume_;
  solver::VolumeBlocks blocks_;  // labels, and what their shares lack of LabelVolume::kAll
  VoxelRange to_upload_;
  gpu::Texture2D colours_;
  gpu::Buffer page_buffer_;
  gpu::BufferTexture page_texture_;
};

}  // namespace tidemark::renderer
