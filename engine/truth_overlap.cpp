#include "engine/truth_overlap.h"

#include "solver/paging/page_rows.h"

namespace tidemark::engine {

void TruthOverlap::count_pages(const solver::PageLayout& layout) {
  if (layout_ == layout) return;
  layout_ = layout;
  in_page_.assign(static_cast<std::size_t>(layout.page_count()), 0);
  in_truth_ = 0;
  for (std::int64_t page = 0; page < layout.page_count(); ++page) {
    std::int64_t& count = in_page_[static_cast<std::size_t>(page)];
    solver::for_each_row(truth_->geometry, layout, page,
                         [&](std::int64_t offset, std::int64_t length, std::int64_t) {
                           for (std::int64_t i = 0; i < length; ++i)
                             count += truth_->voxels[static_cast<std::size_t>(offset + i)] != 0 ? 1 : 0;
                         });
    in_truth_ += count;
  }
}

double TruthOverlap::dice(const solver::Field& phi) {
  count_pages(phi.layout);
  std::int64_t inside = 0;
  std::int64_t common = 0;
  for (std::int64_t page = 0; page < layout_.page_count(); ++page) {
    const std::int32_t entry = phi.table[static_cast<std::size_t>(page)];
    if (entry == solver::Field::kOutside) continue;
    if (entry == solver::Field::kInside) {
      const Index3 valid = layout_.valid_shape(page);
      inside += valid.x * valid.y * valid.z;
      common += in_page_[static_cast<std::size_t>(page)];
      continue;
    }
    const float* values = phi.pages.data() + entry * layout_.voxels_per_page();
    solver::for_each_row(phi.geometry, layout_, page,
                         [&](std::int64_t offset, std::int64_t length, std::int64_t index) {
                           const std::uint8_t* truth = truth_->voxels.data() + offset;
                           for (std::int64_t i = 0; i < length; ++i) {
                             const std::int64_t is_inside = values[index + i] > 0.0F ? 1 : 0;
                             inside += is_inside;
                             common += truth[i] != 0 ? is_inside : 0;
                           }
                         });
  }
  const std::int64_t both = inside + in_truth_;
  return both == 0 ? 1.0 : 2.0 * static_cast<double>(common) / static_cast<double>(both);
}

}  // namespace tidemark::engine
