// The labels of a volume as renderers read them: by voxel, by page, and their borders between voxels.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/paged_bytes.h"
#include "core/paging/page_layout.h"
#include "renderer/label_pages.h"

namespace tidemark::renderer {

// Keeps no copy of the voxels, and works out anew only what has changed and what is near it.
class LabelVolume {
 public:
  static constexpr std::uint8_t kAll = 255;  // of shares()

  LabelVolume() = default;
  // At first no voxel has a label, and all labels are seen.
  explicit LabelVolume(const PageLayout& layout);

  // Of the layout's volume. Returns a box around the voxels that have another label than before.
  VoxelRange set_voxels(const PagedBytes& voxels);
  // Of the labels from 0 on.
  void set_colours(std::span<const LabelColour> colours) { pages_.set_colours(colours); }
  // Brings shares() up to date. Returns a box around those that may differ from before.
  VoxelRange prepare_borders();

  [[nodiscard]] bool has_voxels() const { return pages_.has_voxels(); }
  [[nodiscard]] const PagedBytes& voxels() const { return voxels_; }
  // For each voxel, how much of what is around it has its own label: the weight in a Gaussian of 1.1 voxels
  // over 5 voxels an axis, kAll for all of it. Never less than a little above a half, so that where shares
  // are equal between two voxels is never beyond the middle of either: what is one voxel thick stays. kAll in
  // pages that hold a single label, or none. Where it is kAll all voxels around have the same label.
  [[nodiscard]] const PagedBytes& shares() const { return shares_; }
  [[nodiscard]] const LabelPages& pages() const { return pages_; }

 private:
  PageLayout layout_;
  LabelPages pages_;
  PagedBytes voxels_;
  PagedBytes shares_;
  PagedBytes has_shares_;  // the voxels that shares_ are of
};

}  // namespace tidemark::renderer
