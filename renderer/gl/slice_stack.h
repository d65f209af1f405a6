// phi as slices, each reconstructed from the packed pages when it is its turn (paper section 5, Fig. 9 and
// 10).
#pragma once

#include <span>
#include <vector>

#include "gpu/draw.h"
#include "renderer/gl/draw_throttle.h"
#include "renderer/gl/phi_picture.h"
#include "renderer/gl/slice_pair.h"

namespace tidemark::renderer {

// Only pages that a slice passes and that are not outside are drawn; two slices are there at a time.
class SliceStack {
 public:
  SliceStack() = default;
  static Result<SliceStack> create(gpu::Device& device, const solver::PackedLayout& layout,
                                   const SliceAxis& axis);

  // Begins a picture. `table`: the physical page of each virtual one.
  void begin(std::span<const solver::PhysicalPage> table);
  // Makes sure that a slice is there. Units: three of phi's, one of the list of pages.
  Status reconstruct(const PhiPicture& phi, std::int64_t slice, int phi_unit, int list_unit,
                     DrawThrottle& throttle);

  [[nodiscard]] const gpu::Texture2D& texture(std::int64_t slice) const { return pair_.texture(slice); }

 private:
  SliceAxis axis_;
  PageLayout pages_;
  SlicePair pair_;
  gpu::Program program_;
  gpu::VertexArray vertices_;
  gpu::Buffer list_buffer_;  // the pages to draw, layer by layer
  gpu::BufferTexture list_;
  std::vector<std::int64_t> layer_begins_;  // in the list; one more than layers
};

}  // namespace tidemark::renderer
