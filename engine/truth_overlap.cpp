#include "engine/truth_overlap.h"

#include "core/paging/page_rows.h"

namespace tidemark::engine {

// Counts the truth for these pages; nothing is inside yet.
void TruthOverlap::begin(const solver::Field& phi) {
  layout_ = phi.layout;
  counted_ = solver::Field::empty(phi.geometry, phi.band, phi.layout.page_shape()).pages;
  counts_ = {};
  in_page_.assign(static_cast<std::size_t>(layout_.page_count()), 0);
  in_truth_ = 0;
  for (std::int64_t page = 0; page < layout_.page_count(); ++page) {
    std::int64_t& count = in_page_[static_cast<std::size_t>(page)];
    for_each_row(truth_->geometry(), layout_, page,
                 [&](std::int64_t offset, std::int64_t length, std::int64_t) {
                   for (std::int64_t i = 0; i < length; ++i) count += truth_->contains(offset + i) ? 1 : 0;
                 });
    in_truth_ += count;
  }
}

TruthOverlap::Counts TruthOverlap::count(const SharedPages& pages, std::int64_t page) const {
  const float* const values = pages.values(page);
  if (values == nullptr) {
    if (pages.kind(page) == SharedPages::Kind::outside) return {};
    const Index3 valid = layout_.valid_shape(page);
    return {valid.x * valid.y * valid.z, in_page_[static_cast<std::size_t>(page)]};
  }
  Counts counts;
  for_each_row(truth_->geometry(), layout_, page,
               [&](std::int64_t offset, std::int64_t length, std::int64_t index) {
                 for (std::int64_t i = 0; i < length; ++i) {
                   const std::int64_t is_inside = values[index + i] > 0.0F ? 1 : 0;
                   counts.inside += is_inside;
                   counts.common += truth_->contains(offset + i) ? is_inside : 0;
                 }
               });
  return counts;
}

double TruthOverlap::dice(const solver::Field& phi) {
  if (layout_ != phi.layout) begin(phi);
  SharedPages::for_each_difference(counted_, phi.pages, [&](std::int64_t page) {
    const Counts before = count(counted_, page);
    const Counts now = count(phi.pages, page);
    counts_.inside += now.inside - before.inside;
    counts_.common += now.common - before.common;
  });
  counted_ = phi.pages;
  const std::int64_t both = counts_.inside + in_truth_;
  return both == 0 ? 1.0 : 2.0 * static_cast<double>(counts_.common) / static_cast<double>(both);
}

}  // namespace tidemark::engine
