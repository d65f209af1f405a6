#include "document/region_statistics.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <variant>

#include "core/typed_volume.h"
#include "solver/paging/page_rows.h"

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
                                                       const SharedSlices& labels) {
  if (volume_ != volume || measured_.size() != labels.size()) {
    volume_ = volume;
    measured_ = SharedSlices(labels.size());
    ValueSums none;
    none.shift = some_value(*volume);
    sums_.assign(256, none);
  }
  const auto area = static_cast<std::size_t>(labels.size().x * labels.size().y);
  const auto id_in = [](std::span<const std::uint8_t> slice, std::size_t i) {
    return slice.empty() ? std::uint8_t{0} : slice[i];
  };
  std::visit(
      [&](const auto& stored) {
        for (const std::int64_t k : labels.differing_slices(measured_)) {
          const std::span<const std::uint8_t> then = measured_.slice(k);
          const std::span<const std::uint8_t> now = labels.slice(k);
          const auto values = std::span(stored).subspan(static_cast<std::size_t>(k) * area, area);
          for (std::size_t i = 0; i < area; ++i) {
            const std::uint8_t before = id_in(then, i);
            const std::uint8_t after = id_in(now, i);
            if (before == after) continue;
            const auto value = static_cast<double>(values[i]);
            if (before != 0) sums_[before].take_away(value);
            if (after != 0) sums_[after].add_to_shift(value);
          }
        }
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
  measured_ = solver::SharedPages(layout_.page_count(), layout_.voxels_per_page());
  sums_ = {};
  sums_.shift = some_value(*volume);
}

// With the shift of sums_.
ValueSums InsideStatistics::sums_of(const solver::SharedPages& pages, std::int64_t page) const {
  ValueSums sums;
  sums.shift = sums_.shift;
  if (pages.kind(page) == solver::SharedPages::Kind::outside) return sums;
  const float* const phi = pages.values(page);
  with_type(*volume_, [&](const auto& typed) {
    solver::for_each_row(typed.geometry, layout_, page,
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
  solver::SharedPages::for_each_difference(measured_, phi.pages, [&](std::int64_t page) {
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
