// The fields of the host executor's paged memory: two buffers of phi, what drives it, and what is known of a
// page.
#pragma once

#include <cstdint>

#include "solver/convergence.h"
#include "solver/host/row_masks.h"
#include "solver/paging/page_neighbours.h"
#include "solver/paging/paged_memory.h"
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

  const Constraint* constraints = nullptr;  // of its voxels; null: none
};

// NOLINTNEXTLINE(bugprone-reserved-identifier, readability-identifier-naming): of what the compiler adds
class HostFields {
 public:
  HostFields() = default;
  // Attached to a memory whose pages have the default shape, which outlives this.
  explicit HostFields(PagedMemory<3>& memory);

  // phi of buffer 0, of buffer 1, then how far the data term moves the surface in a step: side by side, so
  // that a page is one stretch of memory.
  static constexpr int kFloatsPerPage = 3 * kPageVoxels;
  [[nodiscard]] const float* all_values(PhysicalPage page) const { return values_.values(page); }
  [[nodiscard]] float* phi(int buffer, PhysicalPage page) const { return values_.values(page, buffer); }
  [[nodiscard]] float* data_motion(PhysicalPage page) const { return values_.values(page, 2); }

  // dt v / h of each axis, three times kPageVoxels; null: the speed function has no velocity.
  [[nodiscard]] float* advection(PhysicalPage page) const {
    return keeps_advection() ? advection_.values(page) : nullptr;
  }
  static constexpr int kAdvectionFloatsPerPage = 3 * kPageVoxels;
  [[nodiscard]] bool keeps_advection() const { return advection_.is_attached(); }
  void keep_advection(bool wanted);

  [[nodiscard]] PageInfo& info(PhysicalPage page) { return infos_[page]; }
  [[nodiscard]] const PageInfo& info(PhysicalPage page) const { return infos_[page]; }
  // Apart by buffer: while a page writes the next buffer's, its neighbours read the current one's.
  [[nodiscard]] RowMasks& masks(int buffer, PhysicalPage page) { return masks_[buffer][page]; }
  [[nodiscard]] const RowMasks& masks(int buffer, PhysicalPage page) const { return masks_[buffer][page]; }

  // Bytes that what drives the surface takes in a page.
  [[nodiscard]] std::int64_t drive_bytes() const;

 private:
  PagedMemory<3>* memory_ = nullptr;
  PageField<float, kPageVoxels, 3> values_;
  PageField<float, kPageVoxels, 3> advection_;
  PageField<RowMasks, 1, 1> masks_[2];
  PageField<PageInfo, 1, 1> infos_;
};

}  // namespace tidemark::solver
