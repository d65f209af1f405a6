// Walls and anchors as a volume on the GPU, a byte a voxel of the blocks that have any
// (resources/shaders/solver/speed/constraints.glsl).
#pragma once

#include "gpu/program.h"
#include "solver/gl/volume_blocks.h"
#include "solver/speed/constraints.h"

namespace tidemark::solver {

class ConstraintTexture {
 public:
  ConstraintTexture() = default;
  // No voxel is constrained at first. Fails (ErrorKind::capability) when the driver's limits or its memory
  // are too small.
  static Result<ConstraintTexture> create(gpu::Device& device, Index3 volume_size);

  // Writes the pages that are others than before. Fails (ErrorKind::capability) when memory is short; it
  // shows none then.
  Status show(gpu::Device& device, const Constraints& constraints);
  [[nodiscard]] std::int64_t bytes() const { return blocks_.bytes(); }

  // CONSTRAINED; two units from `unit` on.
  [[nodiscard]] gpu::Defines defines() const;
  void set_uniforms(const gpu::Program& program, int unit) const;

 private:
  VolumeBlocks blocks_;
  Constraints shown_;
};

}  // namespace tidemark::solver
