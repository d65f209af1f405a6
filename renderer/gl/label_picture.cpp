#include "renderer/gl/label_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <utility>

#include "core/index_walk.h"

namespace tidemark::renderer {
namespace {

// A block as a texture has it; beyond the volume's end there is `rest`.
using Block = std::array<std::uint8_t, 512>;

Block block_of(const PagedBytes& values, Index3 first, Index3 shape, std::uint8_t rest) {
  std::array<std::uint8_t, 512> voxels;
  values.read(first, shape, voxels.data());
  Block block;
  block.fill(rest);
  solver::to_blocks(shape, voxels.data(), block.data());
  return block;
}

}  // namespace

Result<LabelPicture> LabelPicture::create(gpu::Device& device, const PageLayout& layout) {
  LabelPicture picture;
  picture.volume_ = LabelVolume(layout);
  auto blocks = solver::VolumeBlocks::create(device, layout.domain_size(),
                                             {gpu::TexelFormat::r8ui, gpu::TexelFormat::r8}, "labels");
  if (!blocks) return pass_on(blocks);
  picture.blocks_ = std::move(*blocks);
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

void LabelPicture::set_voxels(const PagedBytes& voxels) {
  const VoxelRange changed = volume_.set_voxels(voxels);
  if (changed.empty()) return;
  upload_pages();
  add_to_upload(changed);
}

Status LabelPicture::prepare(gpu::Device& device, bool borders) {
  if (borders) add_to_upload(volume_.prepare_borders());
  if (to_upload_.empty()) return {};
  TIDEMARK_TRY(upload(device, to_upload_));
  to_upload_ = {};
  return {};
}

void LabelPicture::add_to_upload(const VoxelRange& box) {
  if (to_upload_.empty()) {
    to_upload_ = box;
  } else if (!box.empty()) {
    to_upload_ = {glm::min(to_upload_.low, box.low), glm::max(to_upload_.high, box.high)};
  }
}

// Blocks without a label take no memory.
Status LabelPicture::upload(gpu::Device& device, const VoxelRange& box) {
  constexpr std::size_t kBlocksAtATime = 4096;
  constexpr std::uint8_t kAll = LabelVolume::kAll;
  const PageLayout& layout = blocks_.layout();
  std::vector<std::int64_t> written;
  std::vector<std::int64_t> empty;
  std::vector<Block> labels;
  std::vector<Block> lacks;
  const auto write = [&]() -> Status {
    const std::array<solver::PackedTextures::Texels, 2> texels{
        [&](std::size_t i) { return labels[i].data(); }, [&](std::size_t i) { return lacks[i].data(); }};
    TIDEMARK_TRY(blocks_.write(device, written, texels));
    written.clear();
    labels.clear();
    lacks.clear();
    return {};
  };
  Status status;
  all_pages(layout, box.low, box.high, [&](Index3 coordinates) {
    const std::int64_t block = layout.page_number(coordinates);
    const Index3 voxel = layout.first_voxel(block);
    const Index3 shape = layout.valid_shape(block);
    Block label{};
    Block lack{};
    if (volume_.voxels().even_value(voxel, shape) != 0 || volume_.shares().even_value(voxel, shape) != kAll) {
      label = block_of(volume_.voxels(), voxel, shape, 0);
      lack = block_of(volume_.shares(), voxel, shape, kAll);
      for (std::uint8_t& value : lack) value = static_cast<std::uint8_t>(kAll - value);
    }
    if (label == Block{} && lack == Block{}) {
      empty.push_back(block);
      return true;
    }
    written.push_back(block);
    labels.push_back(label);
    lacks.push_back(lack);
    if (written.size() == kBlocksAtATime) status = write();
    return status.has_value();
  });
  TIDEMARK_TRY(status);
  blocks_.remove(empty);
  return write();
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
  blocks_.bind(units.voxels);
  program.set("labels", units.voxels);
  program.set("label_lacks", units.voxels + 1);
  program.set("label_table", units.voxels + 2);
  colours_.bind(static_cast<unsigned>(units.colours));
  program.set("label_colours", units.colours);
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
