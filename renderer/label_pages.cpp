#include "renderer/label_pages.h"

#include <algorithm>

#include "core/label_colour.h"
#include "core/thread_pool.h"

namespace tidemark::renderer {
namespace {

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

LabelPages::LabelPages(const solver::PageLayout& layout) : layout_(layout) {
  visible_.set();
  visible_.reset(0);
}

void LabelPages::set_voxels(std::span<const std::uint8_t> voxels) {
  const Index3 size = layout_.volume_size();
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
  update();
}

void LabelPages::set_colours(std::span<const LabelColour> colours) {
  visible_.reset();
  for (std::size_t label = 1; label < colours.size(); ++label) visible_[label] = colours[label][3] > 0;
  update();
}

std::vector<std::int64_t> LabelPages::mixed() const {
  std::vector<std::int64_t> mixed;
  for (std::size_t page = 0; page < sets_.size(); ++page) {
    if (sets_[page].count() > 1) mixed.push_back(static_cast<std::int64_t>(page));
  }
  return mixed;
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
