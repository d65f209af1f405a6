// The labels that each page of V_P shows, so that rays and slices skip pages without a label's border.
#pragma once

#include <bitset>
#include <cstdint>
#include <span>
#include <vector>

#include "core/paged_bytes.h"
#include "core/paging/page_layout.h"
#include "core/region.h"
#include "renderer/renderer.h"

namespace tidemark::renderer {

class LabelPages {
 public:
  LabelPages() = default;
  // At first no voxel has a label, and all labels are seen.
  explicit LabelPages(const PageLayout& layout);

  // `changed` is around all voxels that have another label than before.
  void set_voxels(const PagedBytes& voxels, const VoxelRange& changed);
  // Of the labels from 0 on.
  void set_colours(std::span<const LabelColour> colours);

  [[nodiscard]] bool has_voxels() const { return !sets_.empty(); }
  // Whether labels show in a view that draws them with this opacity: a label that is seen has a voxel.
  [[nodiscard]] bool show_at(double opacity) const { return opacity > 0.0 && shows_; }
  [[nodiscard]] bool is_seen(int label) const { return visible_[static_cast<std::size_t>(label)]; }
  // By virtual page: 0 where no label shows, the label that it has throughout, or kMixed.
  static constexpr std::int32_t kMixed = -1;
  [[nodiscard]] std::span<const std::int32_t> pages() const { return pages_; }
  // Whether it holds several labels, or a label and none, in it or one voxel around it.
  [[nodiscard]] bool is_mixed(std::int64_t page) const {
    return sets_[static_cast<std::size_t>(page)].count() > 1;
  }

 private:
  using LabelSet = std::bitset<kLabels>;
  void update();

  PageLayout layout_;
  LabelSet visible_;            // without 0
  std::vector<LabelSet> sets_;  // by virtual page: what is in it and one voxel around it
  std::vector<std::int32_t> pages_;
  bool shows_ = false;
};

// The pages that have a voxel of the box, or one at most `reach` from it along each axis.
[[nodiscard]] std::vector<std::int64_t> pages_around(const PageLayout& layout, const VoxelRange& box,
                                                     std::int64_t reach);

// The labels' first colours (core/label_colour.h).
std::vector<LabelColour> first_label_colours();

}  // namespace tidemark::renderer
