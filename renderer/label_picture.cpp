#include "renderer/label_picture.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/label_colour.h"
#include "core/thread_pool.h"
#include "renderer/label_share.h"

namespace tidemark::renderer {
namespace {

std::vector<LabelPicture::Colour> first_colours() {
  std::vector<LabelPicture::Colour> colours(LabelPicture::kLabels);
  for (std::size_t label = 1; label < colours.size(); ++label) {
    const auto [red, green, blue] = label_colour(static_cast<std::uint8_t>(label));
    colours[label] = {red, green, blue, 255};
  }
  return colours;
}

std::int32_t only_label(const std::bitset<LabelPicture::kLabels>& set) {
  std::int32_t label = 0;
  while (!set[static_cast<std::size_t>(label)]) ++label;
  return label;
}

}  // namespace

Result<LabelPicture> LabelPicture::create(gpu::Device& device, const solver::PageLayout& layout) {
  LabelPicture picture;
  picture.layout_ = layout;
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
  picture.set_colours(first_colours());
  return picture;
}

Status LabelPicture::set_voxels(gpu::Device& device, std::span<const std::uint8_t> voxels) {
  const Index3 size = layout_.volume_size();
  auto texture =
      gpu::Texture3D::create(device, gpu::TexelFormat::r8ui, size, std::as_bytes(voxels), "labels");
  if (!texture) return pass_on(texture);
  voxels_ = std::move(*texture);
  labels_.assign(voxels.begin(), voxels.end());
  sets_.assign(static_cast<std::size_t>(layout_.page_count()), {});
  const auto collect = [&](std::int64_t page) {
    // Filtering reaches a voxel further.
    const Index3 first = layout_.first_voxel(page);
    const Index3 low = glm::max(first - Index3(1), Index3(0));
    const Index3 high = glm::min(first + layout_.valid_shape(page), size - Index3(1));
    LabelSet& set = sets_[static_cast<std::size_t>(page)];
    int last = -1;
    for (std::int64_t z = low.z; z <= high.z; ++z) {
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        const std::uint8_t* row = voxels.data() + size.x * (y + size.y * z);
        for (std::int64_t x = low.x; x <= high.x; ++x) {
          if (row[x] != last) set.set(row[x]);
          last = row[x];
        }
      }
    }
  };
  ThreadPool pool;
  pool.for_each(layout_.page_count(), 64, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t page = begin; page < end; ++page) collect(page);
  });
  update_pages();
  return {};
}

Status LabelPicture::prepare_borders(gpu::Device& device) {
  if (labels_.empty()) return {};
  std::vector<std::int64_t> mixed;
  for (std::size_t page = 0; page < sets_.size(); ++page) {
    if (sets_[page].count() > 1) mixed.push_back(static_cast<std::int64_t>(page));
  }
  const std::vector<std::uint8_t> shares = label_shares(layout_, labels_, mixed);
  auto texture = gpu::Texture3D::create(device, gpu::TexelFormat::r8, layout_.volume_size(),
                                        std::as_bytes(std::span(shares)), "borders of labels");
  if (!texture) return pass_on(texture);
  shares_ = std::move(*texture);
  labels_ = {};
  return {};
}

void LabelPicture::set_colours(std::span<const Colour> colours) {
  colours_.upload({0, 0, static_cast<std::int64_t>(colours.size()), 1}, std::as_bytes(colours));
  visible_.reset();
  for (std::size_t label = 1; label < colours.size(); ++label) visible_[label] = colours[label][3] > 0;
  update_pages();
}

void LabelPicture::update_pages() {
  if (sets_.empty()) return;
  pages_.clear();
  pages_.reserve(sets_.size());
  for (const LabelSet& set : sets_) {
    const LabelSet seen = set & visible_;
    pages_.push_back(seen.none() ? 0 : seen == set && seen.count() == 1 ? only_label(seen) : kMixed);
  }
  shows_ = std::any_of(pages_.begin(), pages_.end(), [](std::int32_t page) { return page != 0; });
  page_buffer_.upload_values<std::int32_t>(0, pages_);
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
      bits |= visible_[kBits * word + bit] ? 1U << bit : 0U;
    }
    program.set(fmt::format("visible_labels[{}]", word).c_str(), bits);
  }
}

}  // namespace tidemark::renderer
