#include "renderer/label_volume.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <utility>

#include "core/index_walk.h"
#include "core/thread_pool.h"

namespace tidemark::renderer {
namespace {

constexpr std::int64_t kReach = 2;
constexpr std::int64_t kWidth = 2 * kReach + 1;
constexpr std::array<int, kWidth> kWeights{19, 66, 100, 66, 19};  // exp(-x^2 / (2 * 1.1^2)), of 100
constexpr int kWhole = 270 * 270 * 270;
constexpr int kLeast = 140;  // of 255

// A page's labels with those around it, repeated beyond the volume's border.
struct Tile {
  Index3 size;
  std::vector<std::uint8_t> labels;

  Tile(const PageLayout& layout, const PagedBytes& all, std::int64_t page)
      : size(layout.valid_shape(page) + Index3(2 * kReach)) {
    const Index3 first = layout.first_voxel(page) - Index3(kReach);
    const Index3 last = layout.domain_size() - Index3(1);
    const Index3 low = glm::max(first, Index3(0));
    const Index3 there = glm::min(first + size - Index3(1), last) - low + Index3(1);
    std::vector<std::uint8_t> known(static_cast<std::size_t>(there.x * there.y * there.z));
    all.read(low, there, known.data());
    if (there == size) {
      labels = std::move(known);
      return;
    }
    labels.reserve(static_cast<std::size_t>(size.x * size.y * size.z));
    for_each_index(first, first + size, [&](Index3 voxel) {
      const Index3 at = glm::clamp(voxel, Index3(0), last) - low;
      labels.push_back(known[static_cast<std::size_t>(number_in(there, at))]);
    });
  }

  // Of the voxel in the page.
  [[nodiscard]] std::uint8_t share(Index3 at) const {
    const std::uint8_t* corner = labels.data() + number_in(size, at);
    const std::uint8_t own = corner[kReach * (1 + size.x * (1 + size.y))];
    int sum = 0;
    for (std::size_t z = 0; z < kWidth; ++z) {
      for (std::size_t y = 0; y < kWidth; ++y) {
        const std::uint8_t* row =
            corner + size.x * (static_cast<std::int64_t>(y) + size.y * static_cast<std::int64_t>(z));
        int along = 0;
        for (std::size_t x = 0; x < kWidth; ++x) along += row[x] == own ? kWeights[x] : 0;
        sum += kWeights[z] * kWeights[y] * along;
      }
    }
    constexpr int kUnit = kWhole / 255;
    return static_cast<std::uint8_t>(std::clamp(sum / kUnit, kLeast, int{LabelVolume::kAll}));
  }
};

// A box around the voxels that differ.
VoxelRange difference_of(const PagedBytes& a, const PagedBytes& b) {
  VoxelRange box{a.size(), Index3(0)};
  PagedBytes::for_each_difference(a, b, [&](Index3 voxel, std::int64_t length, std::uint8_t, std::uint8_t) {
    box.low = glm::min(box.low, voxel);
    box.high = glm::max(box.high, voxel + Index3(length, 1, 1));
  });
  return box.empty() ? VoxelRange() : box;
}

}  // namespace

LabelVolume::LabelVolume(const PageLayout& layout)
    : layout_(layout),
      pages_(layout),
      voxels_(layout.domain_size()),
      shares_(layout.domain_size(), kAll),
      has_shares_(layout.domain_size()) {}

VoxelRange LabelVolume::set_voxels(const PagedBytes& voxels) {
  const VoxelRange changed = difference_of(voxels, voxels_);
  voxels_ = voxels;
  if (!changed.empty()) pages_.set_voxels(voxels, changed);
  return changed;
}

VoxelRange LabelVolume::prepare_borders() {
  const std::vector<std::int64_t> pages = pages_around(layout_, difference_of(voxels_, has_shares_), kReach);
  has_shares_ = voxels_;
  if (pages.empty()) return {};
  const VoxelRange box{layout_.first_voxel(pages.front()),
                       layout_.first_voxel(pages.back()) + layout_.valid_shape(pages.back())};
  std::vector<std::int64_t> mixed;
  for (const std::int64_t page : pages) {
    const Index3 first = layout_.first_voxel(page);
    const Index3 shape = layout_.valid_shape(page);
    if (pages_.is_mixed(page)) {
      mixed.push_back(page);
      shares_.own(first, shape);
    } else {
      shares_.fill(first, shape, kAll);
    }
  }
  const auto write = [&](std::int64_t page) {
    const Tile tile(layout_, voxels_, page);
    const Index3 shape = layout_.valid_shape(page);
    std::vector<std::uint8_t> values;
    values.reserve(static_cast<std::size_t>(shape.x * shape.y * shape.z));
    for_each_index(Index3(0), shape, [&](Index3 voxel) { values.push_back(tile.share(voxel)); });
    shares_.write(layout_.first_voxel(page), shape, values.data());
  };
  ThreadPool pool;
  pool.for_each(std::ssize(mixed), 16, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i) write(mixed[static_cast<std::size_t>(i)]);
  });
  return box;
}

}  // namespace tidemark::renderer
