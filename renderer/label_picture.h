// Labels as pictures are drawn from them.
#pragma once

#include <array>
#include <bitset>
#include <cstdint>
#include <span>
#include <vector>

#include "gpu/program.h"
#include "gpu/texture.h"
#include "solver/paging/page_layout.h"

namespace tidemark::renderer {

// A label for each voxel, the labels' colours, and what each page of V_P shows of them, so that rays and
// slices skip pages without a label's border.
class LabelPicture {
 public:
  static constexpr std::size_t kLabels = 256;
  // Red, green, blue and opacity; 0: hidden.
  using Colour = std::array<std::uint8_t, 4>;

  LabelPicture() = default;
  // At first no voxel has a label, and all labels are seen in their first colours (core/label_colour.h).
  static Result<LabelPicture> create(gpu::Device& device, const solver::PageLayout& layout);

  // In voxel order. Fails (ErrorKind::capability) when memory is short.
  Status set_voxels(gpu::Device& device, std::span<const std::uint8_t> voxels);
  // Of the labels from 0 on.
  void set_colours(std::span<const Colour> colours);

  [[nodiscard]] bool has_voxels() const { return !sets_.empty(); }
  // Whether a label that is seen has a voxel.
  [[nodiscard]] bool shows() const { return shows_; }
  // By virtual page: 0 where no label shows, the label that it has throughout, or kMixed.
  static constexpr std::int32_t kMixed = -1;
  [[nodiscard]] std::span<const std::int32_t> pages() const { return pages_; }

  // Makes sure that render/labels.glsl finds what it looks at: slices need less. Fails
  // (ErrorKind::capability) when memory is short.
  Status prepare_borders(gpu::Device& device);

  // The uniforms of render/labels.glsl, and page_labels.
  struct Units {
    int voxels, colours, pages, shares;
  };
  void set_uniforms(const gpu::Program& program, const Units& units) const;

 private:
  using LabelSet = std::bitset<kLabels>;
  void update_pages();

  solver::PageLayout layout_;
  std::vector<std::uint8_t> labels_;  // by voxel, until their borders are known
  gpu::Texture3D voxels_;
  gpu::Texture3D shares_;
  gpu::Texture2D colours_;
  LabelSet visible_;            // without 0
  std::vector<LabelSet> sets_;  // by virtual page: what is in it and one voxel around it
  std::vector<std::int32_t> pages_;
  gpu::Buffer page_buffer_;
  gpu::BufferTexture page_texture_;
  bool shows_ = false;
};

}  // namespace tidemark::renderer
