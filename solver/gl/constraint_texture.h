// Walls and anchors as a texture over the volume, a byte a voxel
// (resources/shaders/solver/speed/constraints.glsl).
#pragma once

#include "gpu/program.h"
#include "gpu/texture.h"
#include "solver/speed/constraints.h"

namespace tidemark::solver {

class ConstraintTexture {
 public:
  ConstraintTexture() = default;
  // No voxel is constrained at first. Fails (ErrorKind::capability) when the volume is beyond the driver's
  // limit or its memory.
  static Result<ConstraintTexture> create(gpu::Device& device, Index3 volume_size);

  // Writes the pages that are others than before.
  void show(const Constraints& constraints);

  [[nodiscard]] gpu::Defines defines() const { return {{"CONSTRAINED", ""}}; }
  void set_uniforms(const gpu::Program& program, int unit) const;

 private:
  gpu::Texture3D texture_;
  Constraints shown_;
};

}  // namespace tidemark::solver
