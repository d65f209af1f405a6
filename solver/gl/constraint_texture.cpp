#include "solver/gl/constraint_texture.h"

namespace tidemark::solver {

Result<ConstraintTexture> ConstraintTexture::create(gpu::Device& device, Index3 volume_size) {
  auto blocks = VolumeBlocks::create(device, volume_size, {gpu::TexelFormat::r8ui}, "walls and anchors");
  if (!blocks) return pass_on(blocks);
  ConstraintTexture result;
  result.blocks_ = std::move(*blocks);
  result.shown_ = Constraints(volume_size);
  return result;
}

Status ConstraintTexture::show(gpu::Device& device, const Constraints& constraints) {
  std::vector<std::int64_t> changed;
  std::vector<std::int64_t> free;
  Constraints::Pages::for_each_difference(constraints.pages(), shown_.pages(), [&](std::int64_t page) {
    (constraints.page(page) != nullptr ? changed : free).push_back(page);
  });
  const PackedTextures::Texels texels = [&](std::size_t i) { return constraints.page(changed[i]); };
  if (Status written = blocks_.write(device, changed, std::span(&texels, 1)); !written) {
    // Nobody knows what has arrived.
    shown_ = Constraints(constraints.layout().domain_size());
    TIDEMARK_TRY(blocks_.release(device));
    return written;
  }
  blocks_.remove(free);
  shown_ = constraints;
  return {};
}

gpu::Defines ConstraintTexture::defines() const {
  gpu::Defines defines = blocks_.defines();
  defines.emplace_back("CONSTRAINED", "");
  return defines;
}

void ConstraintTexture::set_uniforms(const gpu::Program& program, int unit) const {
  blocks_.bind(unit);
  program.set("constraint_blocks", unit);
  program.set("constraint_table", unit + 1);
}

}  // namespace tidemark::solver
