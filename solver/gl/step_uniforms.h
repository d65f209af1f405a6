// The uniforms of the solver's shaders: the equation's constants and the source volume.
#pragma once

#include "core/volume.h"
#include "gpu/program.h"
#include "gpu/texture.h"
#include "solver/model.h"

namespace tidemark::solver {

// The uniforms of resources/shaders/solver/speed.
void set_step_uniforms(const gpu::Program& program, const StepConstants<float>& constants);
void set_tent_uniforms(const gpu::Program& program, const Tent& tent);
// The variant of the update that the model needs: PAPER_SCHEME, ANISOTROPIC.
gpu::Defines step_defines(const Model& model);

// The source as a 3D texture of its stored type; solver/source.glsl reads it.
class SourceTexture {
 public:
  SourceTexture() = default;
  // Fails (ErrorKind::capability) when the volume is beyond the driver's limit or its memory.
  static Result<SourceTexture> create(gpu::Device& device, const Volume& source);

  [[nodiscard]] gpu::Defines defines() const { return {{"SOURCE_SAMPLER", sampler_}}; }
  void set_uniforms(const gpu::Program& program, int unit) const;  // of the program in use

 private:
  gpu::Texture3D texture_;
  std::string sampler_;
  float slope_ = 1.0F;
  float intercept_ = 0.0F;
};

}  // namespace tidemark::solver
