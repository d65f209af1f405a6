// The host's physical memory G: two buffers of phi and the data term for each physical page.
#pragma once

#include <cstddef>
#include <cstdint>

#include "solver/convergence.h"
#include "solver/host/reserved_array.h"
#include "solver/host/row_masks.h"
#include "solver/paging/page_table.h"
#include "solver/speed/constraints.h"

namespace tidemark::solver {

// What is kept beside the voxels of a physical page.
struct PageInfo {
  // The physical pages around it, at (dx + 1) + 3 (dy + 1) + 9 (dz + 1); its own number in the middle.
  PhysicalPage neighbours[kNeighbours];
  Rows padding = 0;  // rows beyond the volume

  // Since the window began: the sum of the largest changes beside the surface, and what PageContent says.
  float change = 0.0F;
  float content = 0.0F;
  std::int32_t near_voxels = 0;
  PageRest rest;

  // How many voxels of the page are inside the volume, along each axis.
  std::uint8_t valid[3] = {kPageSide, kPageSide, kPageSide};
  std::uint8_t constant_steps = 0;  // for how many steps it has been constant
  std::uint8_t samples = 0;         // of content and near_voxels
  bool asleep = false;              // quiet: not computed, both buffers are equal
  bool woke_neighbours = false;     // in this window

  const Constraints::Page* constraints = nullptr;  // of its voxels; null: none
};

// Pages lie one after the other in reserved address space: phi of buffer 0, of buffer 1, then how far the
// data term moves the surface in a step.
// NOLINTNEXTLINE(bugprone-reserved-identifier, readability-identifier-naming): of what the compiler adds
class PagePool {
 public:
  // Room for at most `capacity` pages; memory is taken as pages are used.
  explicit PagePool(PhysicalPage capacity);
  static constexpr int kFloatsPerPage = 3 * kPageVoxels;

  [[nodiscard]] float* phi(int buffer, PhysicalPage page) const {
    return values(page) + buffer * kPageVoxels;
  }
  [[nodiscard]] float* data_motion(PhysicalPage page) const { return values(page) + 2 * kPageVoxels; }

  // dt v / h of each axis, three times kPageVoxels; null: the speed function has no velocity.
  [[nodiscard]] float* advection(PhysicalPage page) const {
    return advection_.data() == nullptr ? nullptr : advection_.data() + index(page) * 3 * kPageVoxels;
  }
  void keep_advection(bool wanted);

  // All that is kept for each voxel of a page, but for the velocity: kFloatsPerPage floats.
  [[nodiscard]] const float* all_values(PhysicalPage page) const { return values(page); }

  [[nodiscard]] PageInfo& info(PhysicalPage page) { return infos_[index(page)]; }
  [[nodiscard]] const PageInfo& info(PhysicalPage page) const { return infos_[index(page)]; }

  // Apart by buffer: while a page writes the next buffer's, its neighbours read the current one's.
  [[nodiscard]] RowMasks& masks(int buffer, PhysicalPage page) { return masks_[buffer][index(page)]; }
  [[nodiscard]] const RowMasks& masks(int buffer, PhysicalPage page) const {
    return masks_[buffer][index(page)];
  }

  // Bytes that `pages` pages take for phi and what is kept beside it, and for the data term.
  [[nodiscard]] static std::int64_t state_bytes(std::int64_t pages);
  [[nodiscard]] static std::int64_t data_bytes(std::int64_t pages);
  [[nodiscard]] std::int64_t advection_bytes(std::int64_t pages) const;

 private:
  static std::size_t index(PhysicalPage page) { return static_cast<std::size_t>(page); }
  [[nodiscard]] float* values(PhysicalPage page) const {
    return values_.data() + index(page) * kFloatsPerPage;
  }

  PhysicalPage capacity_;
  ReservedArray<float> values_;
  ReservedArray<float> advection_;
  ReservedArray<RowMasks> masks_[2];
  ReservedArray<PageInfo> infos_;
};

}  // namespace tidemark::solver
