#include "solver/speed/region_sums.h"

#include <cmath>

#include "core/paging/page_rows.h"
#include "core/thread_pool.h"
#include "core/typed_volume.h"

namespace tidemark::solver {

double RegionMeans::distance() const {
  return std::abs(inside - outside);
}

RegionSums::RegionSums(std::shared_ptr<const Volume> source, const PageLayout& layout)
    : source_(std::move(source)), layout_(layout), sums_(static_cast<std::size_t>(layout.page_count())) {
  constexpr std::int64_t kPagesAtOnce = 256;
  ThreadPool threads;
  with_type(*source_, [&](const auto& typed) {
    threads.for_each(layout_.page_count(), kPagesAtOnce, [&](std::int64_t begin, std::int64_t end, int) {
      for (std::int64_t page = begin; page < end; ++page) {
        double sum = 0.0;
        for_each_row(typed.geometry, layout_, page,
                     [&](std::int64_t offset, std::int64_t length, std::int64_t) {
                       for (std::int64_t x = 0; x < length; ++x)
                         sum += static_cast<double>(typed.value(offset + x));
                     });
        sums_[static_cast<std::size_t>(page)] = sum;
      }
    });
  });
  for (const double sum : sums_) total_ += sum;
}

std::optional<RegionMeans> RegionSums::means(const Field& phi) const {
  double sum = 0.0;
  std::int64_t count = 0;
  with_type(*source_, [&](const auto& typed) {
    for (std::int64_t page = 0; page < layout_.page_count(); ++page) {
      const Field::Kind kind = phi.pages.kind(page);
      if (kind == Field::Kind::outside) continue;
      if (kind == Field::Kind::inside) {
        const Index3 shape = layout_.valid_shape(page);
        sum += sums_[static_cast<std::size_t>(page)];
        count += shape.x * shape.y * shape.z;
        continue;
      }
      const float* const values = phi.pages.values(page);
      for_each_row(typed.geometry, layout_, page,
                   [&](std::int64_t offset, std::int64_t length, std::int64_t index) {
                     for (std::int64_t x = 0; x < length; ++x) {
                       if (!(values[index + x] > 0.0F)) continue;
                       sum += static_cast<double>(typed.value(offset + x));
                       ++count;
                     }
                   });
    }
  });
  const std::int64_t all = phi.geometry.voxel_count();
  if (count == 0 || count == all) return std::nullopt;
  return RegionMeans{sum / static_cast<double>(count), (total_ - sum) / static_cast<double>(all - count)};
}

}  // namespace tidemark::solver
