#include "solver/gl/speed_textures.h"

#include "solver/speed/cached_speed.h"

namespace tidemark::solver {

SpeedTextures::SpeedTextures(Index3 volume_size, int threads, bool velocity)
    : volume_size_(volume_size), threads_(threads), wants_velocity_(velocity) {}

std::int64_t SpeedTextures::bytes_per_voxel(const SpeedFunction& function) {
  return static_cast<std::int64_t>(sizeof(std::int16_t) + (function.advects() ? sizeof(glm::vec4) : 0));
}

Status SpeedTextures::set_function(gpu::Device& device, std::shared_ptr<const SpeedFunction> function) {
  if (function == function_) return {};
  const bool advects = wants_velocity_ && function->advects();
  if (function_ == nullptr || advects != has_velocity_) {
    std::vector<gpu::TexelFormat> formats = {gpu::TexelFormat::r16i};
    if (advects) formats.push_back(gpu::TexelFormat::rgba32f);
    auto made = FilledBlocks::create(device, volume_size_, std::move(formats), "D", threads_);
    if (!made) return pass_on(made);
    volume_ = std::move(*made);
    has_velocity_ = advects;
  } else {
    volume_.forget();
  }
  function_ = std::move(function);
  return {};
}

Status SpeedTextures::fill(gpu::Device& device, std::int64_t most_bytes) {
  const auto evaluate = [&](const VoxelBox& box, std::span<std::byte* const> texels) {
    std::vector<std::int16_t> speed(static_cast<std::size_t>(box.voxels()));
    evaluate_quantised(*function_, box, speed.data());
    to_blocks(box.size, speed.data(), reinterpret_cast<std::int16_t*>(texels[0]));
    if (!has_velocity_) return;
    std::vector<glm::vec3> evaluated(speed.size());
    function_->evaluate_advection(box, evaluated.data());
    std::vector<glm::vec4> velocity;
    velocity.reserve(evaluated.size());
    for (const glm::vec3 v : evaluated) velocity.emplace_back(v, 0.0F);
    to_blocks(box.size, velocity.data(), reinterpret_cast<glm::vec4*>(texels[1]));
  };
  return volume_.fill(device, evaluate, most_bytes);
}

gpu::Defines SpeedTextures::defines() const {
  gpu::Defines defines = volume_.blocks().defines();
  defines.emplace_back("SPEED_VOLUME", "");
  if (has_velocity_) defines.emplace_back("ADVECTION", "");
  return defines;
}

void SpeedTextures::set_uniforms(const gpu::Program& program, int unit) const {
  volume_.blocks().bind(unit);
  program.set("speed_blocks", unit);
  if (has_velocity_) program.set("velocity_blocks", unit + 1);
  program.set("speed_table", unit + (has_velocity_ ? 2 : 1));
}

}  // namespace tidemark::solver
