// phi where an executor on a GPU keeps it, for drawing without a copy.
#pragma once

#include "gpu/buffer.h"
#include "solver/gl/packed_layout.h"

namespace tidemark::solver {

// The textures that resources/shaders/solver/phi.glsl reads. Valid until the next call to the executor.
struct PackedView {
  PackedLayout layout;
  const gpu::TextureLayers* phi = nullptr;
  const gpu::Buffer* page_table =
      nullptr;  // V_P -> G_P, an int32 a page: kOutsidePage, kInsidePage or a page
  float band = 0.0F;
};

}  // namespace tidemark::solver
