#include "document/region_statistics.h"

#include <algorithm>
#include <cmath>

#include "core/typed_volume.h"
#include "solver/paging/page_rows.h"

namespace tidemark::document {

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

std::vector<RegionStatistics> statistics_by_label(const Volume& volume, const Labels& labels) {
  std::vector<ValueSums> sums(256);
  std::visit(
      [&](const auto& stored) {
        auto value = stored.begin();
        const Index3 size = labels.geometry().size;
        for (std::int64_t k = 0; k < size.z; ++k, value += size.x * size.y) {
          const std::span<const std::uint8_t> ids = labels.voxels().slice(k);
          for (std::size_t i = 0; i < ids.size(); ++i) {
            if (ids[i] != 0) sums[ids[i]].add(static_cast<double>(value[static_cast<std::ptrdiff_t>(i)]));
          }
        }
      },
      volume.voxels);
  std::vector<RegionStatistics> statistics;
  for (const ValueSums& one : sums) statistics.push_back(one.result(volume));
  return statistics;
}

// Nothing is inside yet. The shift is some value of the volume's: sums of pages are added and taken away.
void InsideStatistics::begin(const std::shared_ptr<const Volume>& volume, const solver::Field& phi) {
  volume_ = volume;
  layout_ = phi.layout;
  measured_ = solver::SharedPages(layout_.page_count(), layout_.voxels_per_page());
  sums_ = {};
  std::visit([&](const auto& stored) { sums_.shift = static_cast<double>(stored[stored.size() / 2]); },
             volume->voxels);
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
