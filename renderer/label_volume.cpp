#include "renderer/label_volume.h"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <optional>
#include <utility>

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

  Tile(const solver::PageLayout& layout, const SharedSlices& all, std::int64_t page)
      : size(layout.valid_shape(page) + Index3(2 * kReach)) {
    const Index3 first = layout.first_voxel(page) - Index3(kReach);
    const Index3 last = layout.domain_size() - Index3(1);
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
    return static_cast<std::uint8_t>(std::clamp(sum / kUnit, kLeast, int{LabelVolume::kAll}));
  }
};

// A box around the voxels that differ. Slices that both share are not looked at.
VoxelRange difference_of(const SharedSlices& a, const SharedSlices& b) {
  const Index3 size = a.size();
  VoxelRange box{size, Index3(0)};
  const auto width = static_cast<std::size_t>(size.x);
  std::vector<std::uint8_t> in_a(width * static_cast<std::size_t>(size.y));
  std::vector<std::uint8_t> in_b = in_a;
  for (const std::int64_t k : a.differing_slices(b)) {
    a.read(k, in_a);
    b.read(k, in_b);
    for (std::int64_t j = 0; j < size.y; ++j) {
      const auto row_a = std::span(in_a).subspan(width * static_cast<std::size_t>(j), width);
      const auto row_b = std::span(in_b).subspan(width * static_cast<std::size_t>(j), width);
      const auto first = std::mismatch(row_a.begin(), row_a.end(), row_b.begin()).first;
      if (first == row_a.end()) continue;
      const auto last = std::mismatch(row_a.rbegin(), row_a.rend(), row_b.rbegin()).first;
      box.low = glm::min(box.low, Index3(first - row_a.begin(), j, k));
      box.high = glm::max(box.high, Index3(row_a.rend() - last, j + 1, k + 1));
    }
  }
  return box.empty() ? VoxelRange() : box;
}

}  // namespace

LabelVolume::LabelVolume(const solver::PageLayout& layout)
    : layout_(layout),
      pages_(layout),
      voxels_(layout.domain_size()),
      shares_(layout.domain_size(), kAll),
      has_shares_(layout.domain_size()) {}

VoxelRange LabelVolume::set_voxels(const SharedSlices& voxels) {
  const VoxelRange changed = difference_of(voxels, voxels_);
  voxels_ = voxels;
  if (!changed.empty()) pages_.set_voxels(voxels, changed);
  return changed;
}

VoxelRange LabelVolume::prepare_borders() {
  const std::vector<std::int64_t> pages = pages_around(layout_, difference_of(voxels_, has_shares_), kReach);
  has_shares_ = voxels_;
  if (pages.empty()) return {};
  const Index3 volume = layout_.domain_size();
  const VoxelRange box{layout_.first_voxel(pages.front()),
                       layout_.first_voxel(pages.back()) + layout_.valid_shape(pages.back())};
  // Threads write to slices that are nobody else's. Where no page has a border there need not be one.
  std::vector<std::uint8_t*> slices(static_cast<std::size_t>(volume.z));
  for (std::int64_t k = box.low.z; k < box.high.z; ++k) {
    if (!shares_.slice(k).empty()) slices[static_cast<std::size_t>(k)] = shares_.change(k);
  }
  for (const std::int64_t page : pages) {
    if (!pages_.is_mixed(page)) continue;
    const std::int64_t first = layout_.first_voxel(page).z;
    for (std::int64_t k = first; k < first + layout_.valid_shape(page).z; ++k)
      slices[static_cast<std::size_t>(k)] = shares_.change(k);
  }
  const auto fill = [&](std::int64_t page) {
    std::optional<Tile> tile;
    if (pages_.is_mixed(page)) tile.emplace(layout_, voxels_, page);
    const Index3 first = layout_.first_voxel(page);
    const Index3 shape = layout_.valid_shape(page);
    for (std::int64_t z = 0; z < shape.z; ++z) {
      std::uint8_t* const slice = slices[static_cast<std::size_t>(first.z + z)];
      for (std::int64_t y = 0; y < shape.y && slice != nullptr; ++y) {
        std::uint8_t* const row = slice + first.x + volume.x * (first.y + y);
        for (std::int64_t x = 0; x < shape.x; ++x) row[x] = tile ? tile->share({x, y, z}) : kAll;
      }
    }
  };
  ThreadPool pool;
  pool.for_each(std::ssize(pages), 16, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i) fill(pages[static_cast<std::size_t>(i)]);
  });
  return box;
}

}  // namespace tidemark::renderer
