#include "imaging/regions/islands.h"

#include <algorithm>
#include <numeric>

namespace tidemark::imaging {
namespace {

std::size_t root_of(std::size_t run, std::vector<std::size_t>& parents) {
  while (parents[run] != run) run = parents[run] = parents[parents[run]];
  return run;
}

}  // namespace

Islands::Islands(const Region& region, Touching touching) : box_(region.bounds()), touching_(touching) {
  if (box_.empty()) return;
  const Index3 size = box_.high - box_.low;
  row_ends_.assign(static_cast<std::size_t>(size.y * size.z), 0);
  region.for_each_run([&](Index3 voxel, std::int64_t length) {
    runs_.push_back({voxel, length, 0});
    row_ends_[row_of(voxel.y, voxel.z)] = runs_.size();
  });
  // Rows without a run end where the one before them does.
  std::inclusive_scan(row_ends_.begin(), row_ends_.end(), row_ends_.begin(),
                      [](std::size_t a, std::size_t b) { return std::max(a, b); });

  std::vector<std::size_t> parents(runs_.size());
  std::iota(parents.begin(), parents.end(), std::size_t{0});
  for (std::int64_t k = box_.low.z; k < box_.high.z; ++k) {
    for (std::int64_t j = box_.low.y; j < box_.high.y; ++j) {
      if (j > box_.low.y) join(row_of(j, k), row_of(j - 1, k), parents);
      if (k > box_.low.z && touching_ == Touching::in_volume) join(row_of(j, k), row_of(j, k - 1), parents);
    }
  }
  constexpr auto kNone = static_cast<std::size_t>(-1);
  std::vector<std::size_t> islands(runs_.size(), kNone);  // of the roots
  for (std::size_t run = 0; run < runs_.size(); ++run) {
    std::size_t& island = islands[root_of(run, parents)];
    if (island == kNone) {
      island = voxels_.size();
      voxels_.push_back(0);
    }
    runs_[run].island = island;
    voxels_[island] += runs_[run].length;
  }
}

// Joins the islands of runs that touch, of two rows side by side. A root comes before what hangs on it.
void Islands::join(std::size_t row, std::size_t other_row, std::vector<std::size_t>& parents) const {
  std::size_t a = row == 0 ? 0 : row_ends_[row - 1];
  std::size_t b = other_row == 0 ? 0 : row_ends_[other_row - 1];
  while (a < row_ends_[row] && b < row_ends_[other_row]) {
    const std::int64_t end_a = runs_[a].first.x + runs_[a].length;
    const std::int64_t end_b = runs_[b].first.x + runs_[b].length;
    if (runs_[a].first.x < end_b && runs_[b].first.x < end_a) {
      const std::size_t root_a = root_of(a, parents);
      const std::size_t root_b = root_of(b, parents);
      parents[std::max(root_a, root_b)] = std::min(root_a, root_b);
    }
    ++(end_a < end_b ? a : b);
  }
}

std::optional<std::size_t> Islands::at(Index3 voxel) const {
  const Index3 low = box_.low;
  const Index3 high = box_.high;
  if (voxel.y < low.y || voxel.z < low.z || voxel.y >= high.y || voxel.z >= high.z) return std::nullopt;
  const std::size_t row = row_of(voxel.y, voxel.z);
  for (std::size_t run = row == 0 ? 0 : row_ends_[row - 1]; run < row_ends_[row]; ++run) {
    const std::int64_t begin = runs_[run].first.x;
    if (voxel.x >= begin && voxel.x < begin + runs_[run].length) return runs_[run].island;
  }
  return std::nullopt;
}

std::size_t Islands::largest() const {
  return static_cast<std::size_t>(std::max_element(voxels_.begin(), voxels_.end()) - voxels_.begin());
}

std::vector<bool> Islands::touching_sides(const VoxelRange& box) const {
  std::vector<bool> touching(count(), false);
  for (const Run& run : runs_) {
    const auto [x, y, z] = std::array{run.first.x, run.first.y, run.first.z};
    if (x == box.low.x || x + run.length == box.high.x || y == box.low.y || y + 1 == box.high.y ||
        (touching_ == Touching::in_volume && (z == box.low.z || z + 1 == box.high.z)))
      touching[run.island] = true;
  }
  return touching;
}

Region Islands::region_of(const std::function<bool(std::size_t)>& wanted) const {
  std::vector<bool> chosen(count());
  for (std::size_t island = 0; island < count(); ++island) chosen[island] = wanted(island);
  Region region(box_);
  for (const Run& run : runs_) {
    if (chosen[run.island]) region.add_run(run.first, run.length);
  }
  return region;
}

Region without_holes(const Region& region, Index3 grid_size, Touching touching) {
  const VoxelRange box = region.bounds().widened(Index3(1), grid_size);
  if (region.empty()) return region;
  const Islands around(complement(region, box), touching);
  const std::vector<bool> open = around.touching_sides(box);
  return united(region, around.region_of([&](std::size_t island) { return !open[island]; }));
}

}  // namespace tidemark::imaging
