#include "solver/gl/step_uniforms.h"

namespace tidemark::solver {

void set_step_uniforms(const gpu::Program& program, const StepConstants<float>& k) {
  program.set("inverse_spacing", glm::vec3(k.inverse_spacing[0], k.inverse_spacing[1], k.inverse_spacing[2]));
  program.set("time_step", k.time_step);
  program.set("band", k.band);
  program.set("near", k.near);
  program.set("data_weight", k.data_weight);
  program.set("curvature_weight", k.curvature_weight);
  program.set("rescaling_weight", k.rescaling_weight);
  program.set("target_gradient", k.target_gradient);
}

void set_tent_uniforms(const gpu::Program& program, const Tent& tent) {
  program.set("target", static_cast<float>(tent.target));
  program.set("data_peak", static_cast<float>(tent.peak));
  program.set("data_slope", static_cast<float>(tent.slope));
  program.set("data_floor", static_cast<float>(tent.floor));
}

gpu::Defines step_defines(const Model& model) {
  gpu::Defines defines;
  if (model.parameters().scheme == Scheme::paper) defines.emplace_back("PAPER_SCHEME", "");
  if (model.spacing() != glm::dvec3(1.0)) defines.emplace_back("ANISOTROPIC", "");
  return defines;
}

}  // namespace tidemark::solver
