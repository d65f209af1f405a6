#include "solver/speed/growing_region.h"

#include <algorithm>
#include <mutex>
#include <vector>

#include "core/thread_pool.h"
#include "solver/speed/cached_speed.h"

namespace tidemark::solver {
namespace {

constexpr std::int64_t kSlices = 8;  // that are evaluated at a time

}  // namespace

Result<BitMask> growing_region(const SpeedFunction& function, const Geometry& grid,
                               const Progress& progress) {
  // As D is before a cache quantises it.
  const auto* cached = dynamic_cast<const CachedSpeed*>(&function);
  const SpeedFunction& direct = cached != nullptr ? cached->function() : function;
  const Index3 size = grid.size;
  const std::int64_t slabs = (size.z + kSlices - 1) / kSlices;
  BitMask region(grid);
  std::mutex mutex;
  std::int64_t done = 0;
  ThreadPool threads;
  threads.for_each(slabs, 1, [&](std::int64_t first, std::int64_t last, int) {
    std::vector<double> speed;
    for (std::int64_t slab = first; slab < last && !progress.cancelled(); ++slab) {
      const Index3 begin(0, 0, slab * kSlices);
      const VoxelBox box{begin, {size.x, size.y, std::min(kSlices, size.z - begin.z)}};
      speed.resize(static_cast<std::size_t>(box.voxels()));
      direct.evaluate_once(box, speed.data());
      const std::scoped_lock lock(mutex);
      std::int64_t offset = grid.offset(begin);
      for (const double value : speed) {
        if (value > 0.0) region.add(offset);
        ++offset;
      }
      progress(static_cast<double>(++done) / static_cast<double>(slabs), "evaluating the speed");
    }
  });
  if (progress.cancelled()) return cancelled_error();
  return region;
}

}  // namespace tidemark::solver
