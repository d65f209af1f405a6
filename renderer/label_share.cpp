#include "renderer/label_share.h"

#include <algorithm>
#include <array>

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

  Tile(const solver::PageLayout& layout, std::span<const std::uint8_t> all, std::int64_t page)
      : size(layout.valid_shape(page) + Index3(2 * kReach)) {
    const Index3 first = layout.first_voxel(page) - Index3(kReach);
    const Index3 last = layout.volume_size() - Index3(1);
    labels.reserve(static_cast<std::size_t>(size.x * size.y * size.z));
    for (std::int64_t z = 0; z < size.z; ++z) {
      for (std::int64_t y = 0; y < size.y; ++y) {
        for (std::int64_t x = 0; x < size.x; ++x) {
          const Index3 v = glm::clamp(first + Index3(x, y, z), Index3(0), last);
          labels.push_back(all[static_cast<std::size_t>(v.x + (last.x + 1) * (v.y + (last.y + 1) * v.z))]);
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
    return static_cast<std::uint8_t>(std::clamp(sum / kUnit, kLeast, 255));
  }
};

}  // namespace

std::vector<std::uint8_t> label_shares(const solver::PageLayout& layout, std::span<const std::uint8_t> labels,
                                       const std::vector<std::int64_t>& mixed) {
  std::vector<std::uint8_t> shares(labels.size(), 255);
  const Index3 volume = layout.volume_size();
  const auto fill = [&](std::int64_t page) {
    const Tile tile(layout, labels, page);
    const Index3 first = layout.first_voxel(page);
    const Index3 shape = layout.valid_shape(page);
    for (std::int64_t z = 0; z < shape.z; ++z) {
      for (std::int64_t y = 0; y < shape.y; ++y) {
        std::uint8_t* row = shares.data() + first.x + volume.x * (first.y + y + volume.y * (first.z + z));
        for (std::int64_t x = 0; x < shape.x; ++x) row[x] = tile.share({x, y, z});
      }
    }
  };
  ThreadPool pool;
  pool.for_each(static_cast<std::int64_t>(mixed.size()), 16, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i) fill(mixed[static_cast<std::size_t>(i)]);
  });
  return shares;
}

}  // namespace tidemark::renderer
