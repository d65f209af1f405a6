#include "solver/gl/step_uniforms.h"

#include <variant>

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

Result<SourceTexture> SourceTexture::create(gpu::Device& device, const Volume& source) {
  struct Stored {
    gpu::TexelFormat format;
    const char* sampler;
  };
  const auto stored_as = [](const auto& voxels) -> Stored {
    using Scalar = typename std::decay_t<decltype(voxels)>::value_type;
    if constexpr (std::is_same_v<Scalar, std::int16_t>) return {gpu::TexelFormat::r16i, "isampler3D"};
    if constexpr (std::is_same_v<Scalar, std::uint16_t>) return {gpu::TexelFormat::r16ui, "usampler3D"};
    return {gpu::TexelFormat::r32f, "sampler3D"};
  };
  return std::visit(
      [&](const auto& voxels) -> Result<SourceTexture> {
        const Stored stored = stored_as(voxels);
        auto texture = gpu::Texture3D::create(device, stored.format, source.geometry.size,
                                              std::as_bytes(std::span(voxels)), "source");
        if (!texture) return pass_on(texture);
        SourceTexture result;
        result.texture_ = std::move(*texture);
        result.sampler_ = stored.sampler;
        result.slope_ = static_cast<float>(source.slope);
        result.intercept_ = static_cast<float>(source.intercept);
        return result;
      },
      source.voxels);
}

void SourceTexture::set_uniforms(const gpu::Program& program, int unit) const {
  texture_.bind(static_cast<unsigned>(unit));
  program.set("source_volume", unit);
  program.set("source_slope", slope_);
  program.set("source_intercept", intercept_);
}

}  // namespace tidemark::solver
