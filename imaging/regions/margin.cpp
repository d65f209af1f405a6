#include "imaging/regions/margin.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

#include "core/thread_pool.h"
#include "imaging/regions/ball.h"

namespace tidemark::imaging {
namespace {

constexpr std::int64_t kBits = Region::kBits;

// Shifts bits towards larger or smaller i, in place.
void shift_up(std::vector<std::uint64_t>& words, std::int64_t by) {
  const auto whole = static_cast<std::size_t>(by / kBits);
  const auto part = by % kBits;
  for (std::size_t w = words.size(); w-- > 0;) {
    const std::uint64_t here = w >= whole ? words[w - whole] : 0;
    const std::uint64_t before = w >= whole + 1 ? words[w - whole - 1] : 0;
    words[w] = part == 0 ? here : here << part | before >> (kBits - part);
  }
}

void shift_down(std::vector<std::uint64_t>& words, std::int64_t by) {
  const auto whole = static_cast<std::size_t>(by / kBits);
  const auto part = by % kBits;
  for (std::size_t w = 0; w < words.size(); ++w) {
    const std::uint64_t here = w + whole < words.size() ? words[w + whole] : 0;
    const std::uint64_t after = w + whole + 1 < words.size() ? words[w + whole + 1] : 0;
    words[w] = part == 0 ? here : here >> part | after << (kBits - part);
  }
}

// A row of voxels that grows along i.
class GrowingRow {
 public:
  // `room`: words of the rows that it becomes.
  GrowingRow(std::size_t room, std::int64_t largest_half)
      : room_(room), from_(room + static_cast<std::size_t>(2 * largest_half / kBits + 1)) {}

  // `skip`: where the words begin in the room.
  void begin(std::span<const std::uint64_t> words, std::size_t skip) {
    std::fill(from_.begin(), from_.end(), 0);
    std::copy_n(words.begin(), std::min(words.size(), room_ - skip),
                from_.begin() + static_cast<std::ptrdiff_t>(skip));
    half_ = -1;
  }
  // By so many voxels to either side.
  std::span<const std::uint64_t> by(std::int64_t half) {
    if (half != half_) {
      grown_ = from_;
      // Each turn doubles how far it reaches upwards.
      for (std::int64_t reach = 0; reach < 2 * half;) {
        const std::int64_t step = std::min(reach + 1, 2 * half - reach);
        shifted_ = grown_;
        shift_up(shifted_, step);
        for (std::size_t w = 0; w < grown_.size(); ++w) grown_[w] |= shifted_[w];
        reach += step;
      }
      shift_down(grown_, half);
      half_ = half;
    }
    return std::span(grown_).first(room_);
  }

 private:
  std::size_t room_;
  std::int64_t half_ = -1;
  std::vector<std::uint64_t> from_;
  std::vector<std::uint64_t> grown_;
  std::vector<std::uint64_t> shifted_;
};

// The region within the ball's reach of the slices [begin, end) of `result`, of which they become part.
void grow_into(Region& result, const Region& region, const Ball& ball, std::int64_t begin, std::int64_t end) {
  const auto room = static_cast<std::size_t>(result.size().x / kBits);
  const auto skip = static_cast<std::size_t>((region.first().x - result.first().x) / kBits);
  GrowingRow row(room, ball.rows.back().half);
  const std::int64_t first_k = std::max(begin - ball.reach.z, region.first().z);
  const std::int64_t end_k = std::min(end + ball.reach.z, region.first().z + region.size().z);
  for (std::int64_t k = first_k; k < end_k; ++k) {
    for (std::int64_t j = region.first().y; j < region.first().y + region.size().y; ++j) {
      const auto words = std::as_const(region).row(j, k);
      if (std::all_of(words.begin(), words.end(), [](std::uint64_t word) { return word == 0; })) continue;
      row.begin(words, skip);
      for (const BallRow& part : ball.rows) {
        if (k + part.k < begin || k + part.k >= end || !result.has_row(j + part.j, k + part.k)) continue;
        const auto to = result.row(j + part.j, k + part.k);
        const auto from = row.by(part.half);
        for (std::size_t w = 0; w < room; ++w) to[w] |= from[w];
      }
    }
  }
}

}  // namespace

Result<Region> grown(const Region& region, const Geometry& grid, double mm, const Progress& progress) {
  if (!(mm >= 0.0) || mm > kWidestMargin)
    return fail(ErrorKind::usage, "a margin is from 0 to {:.0f} mm, not {:.6g}", kWidestMargin, mm);
  const VoxelRange bounds = region.bounds();
  if (bounds.empty()) return Region();
  const Ball ball = ball_of(grid, mm);
  const Region tight = intersection(region, whole(bounds));  // without empty rows around it
  Region result(bounds.widened(ball.reach, grid.size));
  ThreadPool pool;
  // Slices of the region are read by every piece that they reach into.
  const std::int64_t slices = result.size().z;
  const std::int64_t grain = std::clamp<std::int64_t>(slices / (4 * pool.threads()), 1, 16);
  std::int64_t done = 0;
  std::mutex reporting;
  pool.for_each(slices, grain, [&](std::int64_t begin, std::int64_t end, int /*member*/) {
    if (progress.cancelled()) return;
    grow_into(result, tight, ball, result.first().z + begin, result.first().z + end);
    const std::lock_guard lock(reporting);
    done += end - begin;
    progress(static_cast<double>(done) / static_cast<double>(slices), "margin");
  });
  if (progress.cancelled()) return cancelled_error();
  return intersection(result, whole({Index3(0), grid.size}));
}

Result<Region> shrunk(const Region& region, const Geometry& grid, double mm, const Progress& progress) {
  // Beside every voxel of the region, the nearest one that is not in it lies in its box or right beside that.
  const VoxelRange box = region.bounds().widened(Index3(1), grid.size);
  auto taken = grown(complement(region, box), grid, mm, progress);
  if (!taken) return taken;
  return difference(region, *taken);
}

}  // namespace tidemark::imaging
