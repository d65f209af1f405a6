#include "renderer/gl/label_picture.h"

#include <fmt/format.h>

#include <utility>

namespace tidemark::renderer {
namespace {

Result<gpu::Texture3D> texture_of(gpu::Device& device, gpu::TexelFormat format, const PagedBytes& values,
                                  std::string_view label) {
  const std::vector<std::uint8_t> voxels = values.voxels();
  return gpu::Texture3D::create(device, format, values.size(), std::as_bytes(std::span(voxels)), label);
}

void upload(gpu::Texture3D& texture, const PagedBytes& values, const VoxelRange& box) {
  if (box.empty()) return;
  const Index3 shape = box.high - box.low;
  std::vector<std::uint8_t> packed(static_cast<std::size_t>(shape.x * shape.y * shape.z));
  values.read(box.low, shape, packed.data());
  texture.upload(box.low, shape, std::as_bytes(std::span(packed)));
}

}  // namespace

Result<LabelPicture> LabelPicture::create(gpu::Device& device, const PageLayout& layout) {
  LabelPicture picture;
  picture.volume_ = LabelVolume(layout);
  const std::vector<std::uint8_t> none(1);
  auto voxels = gpu::Texture3D::create(device, gpu::TexelFormat::r8ui, Index3(1),
                                       std::as_bytes(std::span(none)), "no labels");
  if (!voxels) return pass_on(voxels);
  picture.voxels_ = std::move(*voxels);
  auto shares = gpu::Texture3D::create(device, gpu::TexelFormat::r8, Index3(1),
                                       std::as_bytes(std::span(none)), "no borders of labels");
  if (!shares) return pass_on(shares);
  picture.shares_ = std::move(*shares);
  auto colours = gpu::Texture2D::create(device, gpu::TexelFormat::rgba8, kLabels, 1, "colours of labels");
  if (!colours) return pass_on(colours);
  picture.colours_ = std::move(*colours);
  auto buffer = gpu::Buffer::create(
      device, layout.page_count() * static_cast<std::int64_t>(sizeof(std::int32_t)), "labels of pages");
  if (!buffer) return pass_on(buffer);
  picture.page_buffer_ = std::move(*buffer);
  auto pages =
      gpu::BufferTexture::create(device, picture.page_buffer_, gpu::TexelFormat::r32i, "labels of pages");
  if (!pages) return pass_on(pages);
  picture.page_texture_ = std::move(*pages);
  picture.set_colours(first_label_colours());
  return picture;
}

Status LabelPicture::set_voxels(gpu::Device& device, const PagedBytes& voxels) {
  if (!has_voxels_ && voxels.empty()) return {};
  if (!has_voxels_) {
    auto texture = texture_of(device, gpu::TexelFormat::r8ui, voxels, "labels");
    if (!texture) return pass_on(texture);
    voxels_ = std::move(*texture);
  }
  const VoxelRange changed = volume_.set_voxels(voxels);
  if (std::exchange(has_voxels_, true)) upload(voxels_, voxels, changed);
  if (!changed.empty()) upload_pages();
  return device.check("showing labels");
}

Status LabelPicture::prepare_borders(gpu::Device& device) {
  if (!has_voxels_) return {};
  const VoxelRange changed = volume_.prepare_borders();
  if (has_shares_) {
    upload(shares_, volume_.shares(), changed);
    return device.check("showing borders of labels");
  }
  auto texture = texture_of(device, gpu::TexelFormat::r8, volume_.shares(), "borders of labels");
  if (!texture) return pass_on(texture);
  shares_ = std::move(*texture);
  has_shares_ = true;
  return {};
}

void LabelPicture::set_colours(std::span<const LabelColour> colours) {
  colours_.upload({0, 0, static_cast<std::int64_t>(colours.size()), 1}, std::as_bytes(colours));
  volume_.set_colours(colours);
  upload_pages();
}

void LabelPicture::upload_pages() {
  if (volume_.has_voxels()) page_buffer_.upload_values<std::int32_t>(0, pages().pages());
}

void LabelPicture::set_uniforms(const gpu::Program& program, const Units& units) const {
  voxels_.bind(static_cast<unsigned>(units.voxels));
  program.set("labels", units.voxels);
  colours_.bind(static_cast<unsigned>(units.colours));
  program.set("label_colours", units.colours);
  shares_.bind(static_cast<unsigned>(units.shares));
  program.set("label_shares", units.shares);
  page_texture_.bind(static_cast<unsigned>(units.pages));
  program.set("page_labels", units.pages);
  if (!program.has_uniform("visible_labels[0]")) return;
  constexpr std::size_t kBits = 32;
  for (std::size_t word = 0; word < kLabels / kBits; ++word) {
    unsigned bits = 0;
    for (std::size_t bit = 0; bit < kBits; ++bit) {
      bits |= pages().is_seen(static_cast<int>(kBits * word + bit)) ? 1U << bit : 0U;
    }
    program.set(fmt::format("visible_labels[{}]", word).c_str(), bits);
  }
}

}  // namespace tidemark::renderer
