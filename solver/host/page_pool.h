// The host's physical memory G: two buffers of phi and the source for each physical page.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "solver/host/row_masks.h"
#include "solver/paging/page_table.h"

namespace tidemark {

// What is kept beside the voxels of a physical page.
struct PageInfo {
  // The physical pages around it, at (dx + 1) + 3 (dy + 1) + 9 (dz + 1); its own number in the middle.
  PhysicalPage neighbours[27];
  Rows padding = 0;  // rows beyond the volume

  // Since the window began, over the voxels beside the surface (StepConstants::near): the sum of the steps'
  // largest changes, the sum of the squared changes, and the number of voxels.
  float change = 0.0F;
  float squared_change = 0.0F;
  std::int32_t near_voxels = 0;

  // How many voxels of the page are inside the volume, along each axis.
  std::uint8_t valid[3] = {kPageSide, kPageSide, kPageSide};
  std::uint8_t constant_steps = 0;  // for how many steps it has been constant
  bool asleep = false;              // quiet: not computed, both buffers are equal
  bool woke_neighbours = false;     // in this window
};

// Pages come in chunks that never move, so growing copies nothing and a page's address is good for its life.
class PagePool {
 public:
  PagePool();

  // Makes room for pages [0, capacity).
  void reserve(PhysicalPage capacity);

  [[nodiscard]] float* phi(int buffer, PhysicalPage page) { return values(page) + buffer * kPageVoxels; }
  [[nodiscard]] const float* phi(int buffer, PhysicalPage page) const {
    return values(page) + buffer * kPageVoxels;
  }
  [[nodiscard]] float* source(PhysicalPage page) { return values(page) + 2 * kPageVoxels; }

  [[nodiscard]] PageInfo& info(PhysicalPage page) {
    return chunk(page).infos[static_cast<std::uint32_t>(page) % kPagesPerChunk];
  }
  [[nodiscard]] const PageInfo& info(PhysicalPage page) const {
    return chunk(page).infos[static_cast<std::uint32_t>(page) % kPagesPerChunk];
  }

  [[nodiscard]] RowMasks& masks(int buffer, PhysicalPage page) {
    return chunk(page).masks[buffer][static_cast<std::uint32_t>(page) % kPagesPerChunk];
  }
  [[nodiscard]] const RowMasks& masks(int buffer, PhysicalPage page) const {
    return chunk(page).masks[buffer][static_cast<std::uint32_t>(page) % kPagesPerChunk];
  }

  // Asks for a page's values to be brought into the cache.
  void prefetch(PhysicalPage page) const {
    constexpr int kFloatsPerLine = 16;
    const float* first = values(page);
    for (int i = 0; i < kFloatsPerPage; i += kFloatsPerLine) __builtin_prefetch(first + i);
  }

  // Bytes for phi and page information, and for the source, with room for `capacity` pages.
  [[nodiscard]] static std::int64_t state_bytes(std::int64_t capacity);
  [[nodiscard]] static std::int64_t source_bytes(std::int64_t capacity);

 private:
  static constexpr std::uint32_t kPagesPerChunk = 32;
  static constexpr int kFloatsPerPage = 3 * kPageVoxels;

  struct Chunk {
    alignas(64) float values[kPagesPerChunk * kFloatsPerPage];
    // Apart by buffer: while a page writes the next buffer's, its neighbours read the current one's.
    RowMasks masks[2][kPagesPerChunk];
    PageInfo infos[kPagesPerChunk];
  };

  [[nodiscard]] Chunk& chunk(PhysicalPage page) const {
    return *chunks_[static_cast<std::uint32_t>(page) / kPagesPerChunk];
  }
  [[nodiscard]] float* values(PhysicalPage page) const {
    return chunk(page).values +
           std::size_t{static_cast<std::uint32_t>(page) % kPagesPerChunk} * kFloatsPerPage;
  }

  std::vector<std::unique_ptr<Chunk>> chunks_;
};

}  // namespace tidemark
