#include "document/region_statistics.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <variant>

#include "core/paging/page_rows.h"
#include "core/typed_volume.h"

namespace tidemark::document {
namespace {

// Stored; the shift of sums that are added and taken away.
double some_value(const Volume& volume) {
  return std::visit([](const auto& stored) { return static_cast<double>(stored[stored.size() / 2]); },
                    volume.voxels);
}

}  // namespace

RegionStatistics ValueSums::result(const Volume& volume) const {
  RegionStatistics statistics;
  statistics.voxels = voxels;
  statistics.volume_ml = static_cast<double>(voxels) * volume.geometry.voxel_volume_ml();
  if (voxels == 0) return statistics;
  const double n = static_cast<double>(voxels);
  // Of stored values so far.
  statistics.mean = volume.slope * (shift + sum / n) + volume.intercept;
  const double variance = std::max(squares / n - (sum / n) * (sum / n), 0.0);
  statistics.standard_deviation = std::abs(volume.slope) * std::sqrt(variance);
  return statistics;
}

std::vector<RegionStatistics> LabelStatistics::measure(const std::shared_ptr<const Volume>& volume,
                                                       const PagedBytes& labels) {
  if (volume_ != volume || measured_.size() != labels.size()) {
    volume_ = volume;
    measured_ = PagedBytes(labels.size());
    ValueSums none;
    none.shift = some_value(*volume);
    sums_.assign(256, none);
  }
  std::visit(
      [&](const auto& stored) {
        const auto follow = [&](Index3 voxel, std::int64_t length, std::uint8_t before, std::uint8_t after) {
          const auto first = static_cast<std::size_t>(volume->geometry.offset(voxel));
          for (const auto stored_value : std::span(stored).subspan(first, static_cast<std::size_t>(length))) {
            const auto value = static_cast<double>(stored_value);
            if (before != 0) sums_[before].take_away(value);
            if (after != 0) sums_[after].add_to_shift(value);
          }
        };
        PagedBytes::for_each_difference(measured_, labels, follow);
      },
      volume->voxels);
  measured_ = labels;
  std::vector<RegionStatistics> statistics;
  for (const ValueSums& one : sums_) statistics.push_back(one.result(*volume));
  return statistics;
}

// Nothing is inside yet.
void InsideStatistics::begin(const std::shared_ptr<const Volume>& volume, const solver::Field& phi) {
  volume_ = volume;
  layout_ = phi.layout;
  measured_ = SharedPages(layout_.page_count(), layout_.voxels_per_page());
  sums_ = {};
  sums_.shift = some_value(*volume);
}

// With the shift of sums_.
ValueSums InsideStatistics::sums_of(const SharedPages& pages, std::int64_t page) const {
  ValueSums sums;
  sums.shift = sums_.shift;
  if (pages.kind(page) == SharedPages::Kind::outside) return sums;
  const float* const phi = pages.values(page);
  with_type(*volume_, [&](const auto& typed) {
    for_each_row(typed.geometry, layout_, page,
                 [&](std::int64_t offset, std::int64_t length, std::int64_t index) {
                   for (std::int64_t i = 0; i < length; ++i) {
                     if (phi != nullptr && !(phi[index + i] > 0.0F)) continue;
                     const auto at = static_cast<std::size_t>(offset + i);
                     sums.add_to_shift(static_cast<double>(typed.stored[at]));
                   }
                 });
  });
  return sums;
}

RegionStatistics InsideStatistics::measure(const std::shared_ptr<const Volume>& volume,
                                           const solver::Field& phi) {
  if (volume_ != volume || layout_ != phi.layout) begin(volume, phi);
  SharedPages::for_each_difference(measured_, phi.pages, [&](std::int64_t page) {
    const ValueSums before = sums_of(measured_, page);
    const ValueSums now = sums_of(phi.pages, page);
    sums_.voxels += now.voxels - before.voxels;
    sums_.sum += now.sum - before.sum;
    sums_.squares += now.squares - before.squares;
  });
  measured_ = phi.pages;
  return sums_.result(*volume_);
}

}  // namespace tidemark::document
