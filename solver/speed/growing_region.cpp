#include "solver/speed/growing_region.h"

#include <algorithm>
#include <vector>

#include "core/thread_pool.h"
#include "solver/speed/cached_speed.h"

namespace tidemark::solver {
namespace {

constexpr std::int64_t kRows = 8;     // of as many slices, that a thread evaluates at a time
constexpr std::int64_t kSlices = 32;  // that are evaluated before they are added to the region

}  // namespace

Result<BitMask> growing_region(const SpeedFunction& function, const Geometry& grid,
                               const Progress& progress) {
  const auto* cached = dynamic_cast<const CachedSpeed*>(&function);
  const SpeedFunction& direct = cached != nullptr ? cached->function() : function;
  const Index3 size = grid.size;
  const std::int64_t rows = (size.y + kRows - 1) / kRows;
  BitMask region(grid);
  std::vector<std::uint8_t> grows(static_cast<std::size_t>(size.x * size.y * std::min(size.z, kSlices)));
  ThreadPool threads;
  for (std::int64_t z = 0; z < size.z; z += kSlices) {
    const std::int64_t slices = std::min(kSlices, size.z - z);
    threads.for_each(
        rows * ((slices + kRows - 1) / kRows), 1, [&](std::int64_t first, std::int64_t last, int) {
          std::vector<double> speed;
          for (std::int64_t n = first; n < last && !progress.cancelled(); ++n) {
            const Index3 begin(0, n % rows * kRows, n / rows * kRows);
            const Index3 end(size.x, std::min(begin.y + kRows, size.y), std::min(begin.z + kRows, slices));
            const VoxelBox box{begin + Index3(0, 0, z), end - begin};
            speed.resize(static_cast<std::size_t>(box.voxels()));
            direct.evaluate(box, speed.data());
            const double* value = speed.data();
            for (std::int64_t k = begin.z; k < end.z; ++k) {
              for (std::int64_t j = begin.y; j < end.y; ++j) {
                std::uint8_t* row = &grows[static_cast<std::size_t>(size.x * (j + size.y * k))];
                for (std::int64_t i = 0; i < size.x; ++i) {
                  row[i] = static_cast<std::uint8_t>(*value++ > 0.0);
                }
              }
            }
          }
        });
    if (progress.cancelled()) return cancelled_error();
    const std::int64_t offset = size.x * size.y * z;
    for (std::int64_t i = 0; i < size.x * size.y * slices; ++i) {
      if (grows[static_cast<std::size_t>(i)] != 0) region.add(offset + i);
    }
    progress(static_cast<double>(z + slices) / static_cast<double>(size.z), "evaluating the speed");
  }
  return region;
}

}  // namespace tidemark::solver
