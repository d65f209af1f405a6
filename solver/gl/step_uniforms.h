// The uniforms of the solver's shaders: the equation's constants.
#pragma once

#include "gpu/program.h"
#include "solver/model.h"

namespace tidemark::solver {

// The uniforms of resources/shaders/solver/speed.
void set_step_uniforms(const gpu::Program& program, const StepConstants<float>& constants);
void set_tent_uniforms(const gpu::Program& program, const Tent& tent);
// The variant of the update that the model needs: PAPER_SCHEME, ANISOTROPIC.
gpu::Defines step_defines(const Model& model);

}  // namespace tidemark::solver
