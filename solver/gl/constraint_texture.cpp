#include "solver/gl/constraint_texture.h"

#include <algorithm>

namespace tidemark::solver {

Result<ConstraintTexture> ConstraintTexture::create(gpu::Device& device, Index3 volume_size) {
  auto texture = gpu::Texture3D::create(device, gpu::TexelFormat::r8ui, volume_size, {}, "walls and anchors");
  if (!texture) return pass_on(texture);
  const std::vector<std::byte> free_slice(static_cast<std::size_t>(volume_size.x * volume_size.y));
  for (std::int64_t z = 0; z < volume_size.z; ++z) {
    texture->upload({0, 0, z}, {volume_size.x, volume_size.y, 1}, free_slice);
  }
  TIDEMARK_TRY(device.check("making a texture of walls and anchors"));
  ConstraintTexture result;
  result.texture_ = std::move(*texture);
  result.shown_ = Constraints(volume_size);
  return result;
}

void ConstraintTexture::show(const Constraints& constraints) {
  const PageLayout& layout = constraints.layout();
  std::vector<Constraint> values;
  Constraints::Pages::for_each_difference(constraints.pages(), shown_.pages(), [&](std::int64_t page) {
    const Constraint* const there = constraints.page(page);
    const Index3 valid = layout.valid_shape(page);
    values.assign(static_cast<std::size_t>(valid.x * valid.y * valid.z), Constraint::none);
    for (std::int64_t row = 0; there != nullptr && row < valid.y * valid.z; ++row) {
      const std::int64_t y = row % valid.y;
      const std::int64_t z = row / valid.y;
      std::copy_n(there + 8 * (y + 8 * z), valid.x, values.begin() + valid.x * row);
    }
    texture_.upload(layout.first_voxel(page), valid, std::as_bytes(std::span(values)));
  });
  shown_ = constraints;
}

void ConstraintTexture::set_uniforms(const gpu::Program& program, int unit) const {
  texture_.bind(static_cast<unsigned>(unit));
  program.set("constraint_volume", unit);
}

}  // namespace tidemark::solver
