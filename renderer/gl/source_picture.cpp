#include "renderer/gl/source_picture.h"

#include <algorithm>
#include <variant>

#include "renderer/gl/source_stack.h"

namespace tidemark::renderer {
Result<SourcePicture> SourcePicture::create(gpu::Device& device, const Volume& source,
                                            const PageLayout& layout) {
  SourcePicture picture;
  picture.opacity_ = PageOpacity(layout);
  picture.unit_ = 1.0F / glm::vec3(source.geometry.size);
  const auto [format, scale] = stored_as(source);
  picture.scale_ = scale;
  const Index3 size = source.geometry.size;
  picture.has_volume_ = std::max({size.x, size.y, size.z}) <= device.capabilities().largest_volume_texture;
  const auto make_texture = [&, format = format](Index3 extent, std::span<const std::byte> texels) {
    return gpu::Texture3D::create(device, format, extent, texels, "source for pictures", gpu::Filter::linear);
  };
  const std::vector<std::byte> nothing(static_cast<std::size_t>(gpu::bytes_per_texel(format)));
  auto texture =
      picture.has_volume_
          ? std::visit(
                [&](const auto& voxels) { return make_texture(size, std::as_bytes(std::span(voxels))); },
                source.voxels)
          : make_texture(Index3(1), nothing);
  if (!texture && picture.has_volume_ && !device.lost()) {
    // The GPU's memory is too small for it; slices will do.
    picture.has_volume_ = false;
    texture = make_texture(Index3(1), nothing);
  }
  if (!texture) return pass_on(texture);
  picture.texture_ = std::move(*texture);
  auto buffer = gpu::Buffer::create(
      device, layout.page_count() * static_cast<std::int64_t>(sizeof(glm::vec4)), "page opacities");
  if (!buffer) return pass_on(buffer);
  picture.opacity_buffer_ = std::move(*buffer);
  auto view = gpu::BufferTexture::create(device, picture.opacity_buffer_, gpu::TexelFormat::rgba32f,
                                         "page opacities");
  if (!view) return pass_on(view);
  picture.opacities_ = std::move(*view);
  return picture;
}

void SourcePicture::set_transfer_function(const Volume& source, const TransferFunction& function,
                                          Region region, double band) {
  if (!opacity_.set_transfer_function(source, function, region, band)) return;
  opacity_buffer_.upload_values<glm::vec4>(0, opacity_.pages());
}

void SourcePicture::set_uniforms(const gpu::Program& program, int unit) const {
  texture_.bind(static_cast<unsigned>(unit));
  program.set("source_values", unit);
  program.set("source_scale", scale_);
  program.set("source_unit", unit_);
  opacities_.bind(static_cast<unsigned>(unit + 1));
  program.set("page_opacity", unit + 1);
}

}  // namespace tidemark::renderer
