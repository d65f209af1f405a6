#include "renderer/label_pages.h"

#include <algorithm>

#include "core/index_walk.h"
#include "core/label_colour.h"
#include "core/thread_pool.h"

namespace tidemark::renderer {
namespace {

constexpr std::int64_t kFiltered = 1;  // filtering reaches a voxel further

std::int32_t only_label(const std::bitset<kLabels>& set) {
  std::int32_t label = 0;
  while (!set[static_cast<std::size_t>(label)]) ++label;
  return label;
}

}  // namespace

std::vector<LabelColour> first_label_colours() {
  std::vector<LabelColour> colours(kLabels);
  for (std::size_t label = 1; label < colours.size(); ++label) {
    const auto [red, green, blue] = label_colour(static_cast<std::uint8_t>(label));
    colours[label] = {red, green, blue, 255};
  }
  return colours;
}

std::vector<std::int64_t> pages_around(const PageLayout& layout, const VoxelRange& box, std::int64_t reach) {
  std::vector<std::int64_t> pages;
  if (box.empty()) return pages;
  const VoxelRange around = box.widened(Index3(reach), layout.domain_size());
  for_each_page(layout, around.low, around.high,
                [&](Index3 page) { pages.push_back(layout.page_number(page)); });
  return pages;
}

LabelPages::LabelPages(const PageLayout& layout) : layout_(layout) {
  visible_.set();
  visible_.reset(0);
}

void LabelPages::set_voxels(const PagedBytes& voxels, const VoxelRange& changed) {
  const Index3 size = layout_.domain_size();
  if (sets_.empty()) sets_.assign(static_cast<std::size_t>(layout_.page_count()), LabelSet(1));
  const auto collect = [&](std::int64_t page) {
    const Index3 first = layout_.first_voxel(page);
    const Index3 low = glm::max(first - Index3(kFiltered), Index3(0));
    const Index3 high =
        glm::min(first + layout_.valid_shape(page) - Index3(1) + Index3(kFiltered), size - Index3(1));
    const Index3 shape = high - low + Index3(1);
    LabelSet& set = sets_[static_cast<std::size_t>(page)];
    set.reset();
    if (const auto one = voxels.even_value(low, shape)) {
      set.set(*one);
      return;
    }
    std::vector<std::uint8_t> labels(static_cast<std::size_t>(shape.x * shape.y * shape.z));
    voxels.read(low, shape, labels.data());
    int last = -1;
    for (const std::uint8_t label : labels) {
      if (label != last) set.set(label);
      last = label;
    }
  };
  const std::vector<std::int64_t> pages = pages_around(layout_, changed, kFiltered);
  ThreadPool pool;
  pool.for_each(std::ssize(pages), 64, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i) collect(pages[static_cast<std::size_t>(i)]);
  });
  update();
}

void LabelPages::set_colours(std::span<const LabelColour> colours) {
  visible_.reset();
  for (std::size_t label = 1; label < colours.size(); ++label) visible_[label] = colours[label][3] > 0;
  update();
}

void LabelPages::update() {
  if (sets_.empty()) return;
  pages_.clear();
  pages_.reserve(sets_.size());
  for (const LabelSet& set : sets_) {
    const LabelSet seen = set & visible_;
    pages_.push_back(seen.none() ? 0 : seen == set && seen.count() == 1 ? only_label(seen) : kMixed);
  }
  shows_ = std::any_of(pages_.begin(), pages_.end(), [](std::int32_t page) { return page != 0; });
}

}  // namespace tidemark::renderer
