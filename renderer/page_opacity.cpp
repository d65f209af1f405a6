#include "renderer/page_opacity.h"

#include <algorithm>

#include "core/thread_pool.h"
#include "core/typed_volume.h"

namespace tidemark::renderer {
namespace {

// Least and greatest value in each page and one voxel around it: what filtering reaches from inside the page.
template <class Stored>
std::vector<glm::vec2> page_ranges(const TypedVolume<Stored>& source, const PageLayout& layout) {
  ThreadPool pool;
  std::vector<glm::vec2> ranges(static_cast<std::size_t>(layout.page_count()));
  const auto measure = [&](std::int64_t page) -> glm::vec2 {
    const Index3 first = layout.first_voxel(page);
    const Index3 low = glm::max(first - Index3(1), Index3(0));
    const Index3 high = glm::min(first + layout.valid_shape(page), source.geometry.size - Index3(1));
    Stored lowest = source.stored[static_cast<std::size_t>(source.geometry.offset(first))];
    Stored highest = lowest;
    for (std::int64_t z = low.z; z <= high.z; ++z) {
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        const Stored* row = source.stored.data() + source.geometry.offset({0, y, z});
        for (std::int64_t x = low.x; x <= high.x; ++x) {
          lowest = std::min(lowest, row[x]);
          highest = std::max(highest, row[x]);
        }
      }
    }
    const auto [least, greatest] = std::minmax({source.rescaled(lowest), source.rescaled(highest)});
    return {least, greatest};
  };
  pool.for_each(layout.page_count(), 64, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t page = begin; page < end; ++page)
      ranges[static_cast<std::size_t>(page)] = measure(page);
  });
  return ranges;
}

}  // namespace

bool PageOpacity::set_transfer_function(const Volume& source, const TransferFunction& function, Region region,
                                        double band) {
  Shown wanted{function, region, band};
  if (shown_ == wanted) return false;
  if (ranges_.empty()) {
    ranges_ = with_type(source, [&](const auto& typed) { return page_ranges(typed, layout_); });
  }
  pages_.resize(ranges_.size());
  ThreadPool pool;
  pool.for_each(std::ssize(ranges_), 4096, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t page = begin; page < end; ++page) {
      const glm::vec2 range = ranges_[static_cast<std::size_t>(page)];
      const auto most = [&](double low_phi, double high_phi) {
        return function.most_opacity(range.x, range.y, low_phi, high_phi);
      };
      pages_[static_cast<std::size_t>(page)] =
          glm::vec4(region == Region::inside ? 0.0 : most(-band, -band),
                    region == Region::outside ? 0.0 : most(band, band), most(-band, band), 0.0);
    }
  });
  shown_ = std::move(wanted);
  return true;
}

}  // namespace tidemark::renderer
