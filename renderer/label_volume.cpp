#include "renderer/label_volume.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>

#include "core/thread_pool.h"

namespace tidemark::renderer {
namespace {

constexpr std::int64_t kReach = 2;
constexpr std::int64_t kWidth = 2 * kReach + 1;
constexpr std::array<int, kWidth> kWeights{19, 66, 100, 66, 19};  // exp(-x^2 / (2 * 1.1^2)), of 100
constexpr int kWhole = 270 * 270 * 270;
constexpr int kLeast = 140;  // of 255
constexpr std::uint8_t kAll = 255;

// A page's labels with those around it, repeated beyond the volume's border.
struct Tile {
  Index3 size;
  std::vector<std::uint8_t> labels;

  Tile(const solver::PageLayout& layout, const SharedSlices& all, std::int64_t page)
      : size(layout.valid_shape(page) + Index3(2 * kReach)) {
    const Index3 first = layout.first_voxel(page) - Index3(kReach);
    const Index3 last = layout.volume_size() - Index3(1);
    labels.reserve(static_cast<std::size_t>(size.x * size.y * size.z));
    for (std::int64_t z = 0; z < size.z; ++z) {
      for (std::int64_t y = 0; y < size.y; ++y) {
        const auto row = all.row(std::clamp(first.y + y, std::int64_t{0}, last.y),
                                 std::clamp(first.z + z, std::int64_t{0}, last.z));
        for (std::int64_t x = 0; x < size.x; ++x) {
          const auto at = static_cast<std::size_t>(std::clamp(first.x + x, std::int64_t{0}, last.x));
          labels.push_back(row.empty() ? std::uint8_t{0} : row[at]);
        }
      }
    }
  }

  // Of the voxel in the page.
  [[nodiscard]] std::uint8_t share(Index3 at) const {
    const std::uint8_t* corner = labels.data() + at.x + size.x * (at.y + size.y * at.z);
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
    return static_cast<std::uint8_t>(std::clamp(sum / kUnit, kLeast, int{kAll}));
  }
};

}  // namespace

LabelVolume::LabelVolume(const solver::PageLayout& layout)
    : layout_(layout),
      pages_(layout),
      voxels_(layout.volume_size()),
      shares_(layout.volume_size(), kAll),
      has_shares_(layout.volume_size()) {}

std::vector<std::int64_t> LabelVolume::set_voxels(const SharedSlices& voxels) {
  std::vector<std::int64_t> changed = voxels.differing_slices(voxels_);
  if (changed.empty()) return changed;
  voxels_ = voxels;
  pages_.set_voxels(voxels, changed);
  return changed;
}

std::vector<std::int64_t> LabelVolume::prepare_borders() {
  const std::int64_t depth = layout_.page_shape().z;
  const std::int64_t pages_a_layer = layout_.pages().x * layout_.pages().y;
  const Index3 volume = layout_.volume_size();
  std::vector<std::int64_t> slices;
  std::vector<std::int64_t> mixed;
  std::vector<std::uint8_t*> values(static_cast<std::size_t>(volume.z));
  for (const std::int64_t layer : layers_around(layout_, voxels_.differing_slices(has_shares_), kReach)) {
    const std::size_t before = mixed.size();
    for (std::int64_t page = pages_a_layer * layer; page < pages_a_layer * (layer + 1); ++page) {
      if (pages_.is_mixed(page)) mixed.push_back(page);
    }
    for (std::int64_t k = layer * depth; k < std::min((layer + 1) * depth, volume.z); ++k) {
      slices.push_back(k);
      shares_.clear(k);
      if (mixed.size() > before) values[static_cast<std::size_t>(k)] = shares_.change(k);
    }
  }
  has_shares_ = voxels_;
  const auto fill = [&](std::int64_t page) {
    const Tile tile(layout_, voxels_, page);
    const Index3 first = layout_.first_voxel(page);
    const Index3 shape = layout_.valid_shape(page);
    for (std::int64_t z = 0; z < shape.z; ++z) {
      for (std::int64_t y = 0; y < shape.y; ++y) {
        std::uint8_t* row =
            values[static_cast<std::size_t>(first.z + z)] + first.x + volume.x * (first.y + y);
        for (std::int64_t x = 0; x < shape.x; ++x) row[x] = tile.share({x, y, z});
      }
    }
  };
  ThreadPool pool;
  pool.for_each(static_cast<std::int64_t>(mixed.size()), 16, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i) fill(mixed[static_cast<std::size_t>(i)]);
  });
  return slices;
}

}  // namespace tidemark::renderer
