#include "imaging/regions/smoothing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <span>
#include <vector>

#include "core/thread_pool.h"
#include "imaging/regions/ball.h"

namespace tidemark::imaging {
namespace {

constexpr int kLevels = 65536;

// Calls slab(first slice, end) for slabs of the slices of a box, on all processors. False: cancelled.
template <class Slab>
bool for_each_slab(ThreadPool& pool, const VoxelRange& box, std::int64_t thickness, const Progress& progress,
                   const Slab& slab) {
  const std::int64_t slices = box.high.z - box.low.z;
  std::int64_t done = 0;
  std::mutex reporting;
  pool.for_each(slices, thickness, [&](std::int64_t begin, std::int64_t end, int /*member*/) {
    if (progress.cancelled()) return;
    slab(box.low.z + begin, box.low.z + end);
    const std::lock_guard lock(reporting);
    done += end - begin;
    progress(static_cast<double>(done) / static_cast<double>(slices), "smoothing");
  });
  return !progress.cancelled();
}

// Slabs share few slices with their neighbours when they are thicker than what reaches into them.
std::int64_t thickness_of(const VoxelRange& box, std::int64_t reach, const ThreadPool& pool) {
  const std::int64_t slices = box.high.z - box.low.z;
  return std::clamp<std::int64_t>(slices / pool.threads(), 1, std::max<std::int64_t>(4 * reach, 8));
}

// The voxel at i of a row of a region: 0 or 1.
std::uint32_t bit_at(std::span<const std::uint64_t> row, std::int64_t bit) {
  if (bit < 0 || bit >= std::ssize(row) * Region::kBits) return 0;
  return static_cast<std::uint32_t>(row[static_cast<std::size_t>(bit / Region::kBits)] >>
                                    (bit % Region::kBits)) &
         1U;
}

// The rows of a box, and beside it by `reach`, with the outermost voxels of the grid going on beyond it.
class Rows {
 public:
  Rows(const Region& region, const VoxelRange& box, Index3 reach, Index3 grid_size)
      : region_(region), box_(box), reach_(reach), grid_size_(grid_size) {}

  // Whether all voxels of the row are outside.
  [[nodiscard]] bool empty(std::int64_t j, std::int64_t k) const {
    j = std::clamp<std::int64_t>(j, 0, grid_size_.y - 1);
    k = std::clamp<std::int64_t>(k, 0, grid_size_.z - 1);
    if (!region_.has_row(j, k)) return true;
    const auto words = region_.row(j, k);
    return std::all_of(words.begin(), words.end(), [](std::uint64_t word) { return word == 0; });
  }
  // Calls voxel(n, 0 or 1) from box.low.x - reach.x on.
  template <class Voxel>
  void read(std::int64_t j, std::int64_t k, const Voxel& voxel) const {
    j = std::clamp<std::int64_t>(j, 0, grid_size_.y - 1);
    k = std::clamp<std::int64_t>(k, 0, grid_size_.z - 1);
    if (!region_.has_row(j, k)) return;
    const auto words = region_.row(j, k);
    const std::int64_t length = box_.high.x - box_.low.x + 2 * reach_.x;
    for (std::int64_t n = 0; n < length; ++n) {
      const std::int64_t i = std::clamp<std::int64_t>(box_.low.x - reach_.x + n, 0, grid_size_.x - 1);
      voxel(n, bit_at(words, i - region_.first().x));
    }
  }

 private:
  const Region& region_;
  VoxelRange box_;
  Index3 reach_;
  Index3 grid_size_;
};

Status check(double mm, const char* what) {
  if (mm > 0.0 && mm <= kWidestSmoothing) return {};
  return fail(ErrorKind::usage, "{} is above 0 and at most {:.0f} mm, not {:.6g}", what, kWidestSmoothing,
              mm);
}

// A slab's rows as running sums: how many voxels of a row up to there are in the region.
class SummedRows {
 public:
  SummedRows(const Rows& rows, const VoxelRange& box, Index3 reach, std::int64_t begin, std::int64_t end)
      : low_{0, box.low.y - reach.y, begin - reach.z},
        rows_(box.high.y - box.low.y + 2 * reach.y),
        length_(static_cast<std::size_t>(box.high.x - box.low.x + 2 * reach.x + 1)) {
    const std::int64_t slices = end - begin + 2 * reach.z;
    empty_.resize(static_cast<std::size_t>(rows_ * slices));
    sums_.assign(empty_.size() * length_, 0);
    for (std::int64_t k = 0; k < slices; ++k) {
      for (std::int64_t j = 0; j < rows_; ++j) {
        const auto row = static_cast<std::size_t>(k * rows_ + j);
        empty_[row] = rows.empty(low_.y + j, low_.z + k);
        if (empty_[row]) continue;
        std::uint16_t* sum = sums_.data() + row * length_;
        rows.read(low_.y + j, low_.z + k, [&](std::int64_t n, std::uint32_t voxel) {
          sum[n + 1] = static_cast<std::uint16_t>(sum[n] + voxel);
        });
      }
    }
  }
  // Null: no voxel of the row is in the region.
  [[nodiscard]] const std::uint16_t* row(std::int64_t j, std::int64_t k) const {
    const auto row = static_cast<std::size_t>((k - low_.z) * rows_ + j - low_.y);
    return empty_[row] ? nullptr : sums_.data() + row * length_;
  }

 private:
  Index3 low_;
  std::int64_t rows_;
  std::size_t length_;
  std::vector<bool> empty_;
  std::vector<std::uint16_t> sums_;  // differences hold, even beyond 65,535
};

}  // namespace

Result<Region> smoothed_by_median(const Region& region, const Geometry& grid, double radius_mm,
                                  const Progress& progress) {
  TIDEMARK_TRY(check(radius_mm, "the radius of a median"));
  const VoxelRange bounds = region.bounds();
  if (bounds.empty()) return Region();
  const Ball ball = ball_of(grid, radius_mm);
  std::int64_t voxels = 0;
  for (const BallRow& row : ball.rows) voxels += 2 * row.half + 1;
  if (voxels > std::numeric_limits<std::uint16_t>::max())
    return fail(ErrorKind::usage, "a ball of {:.6g} mm has {} voxels here; at most 65,535", radius_mm,
                voxels);
  const VoxelRange box = bounds.widened(ball.reach, grid.size);
  const Rows rows(region, box, ball.reach, grid.size);
  const auto length = static_cast<std::size_t>(box.high.x - box.low.x);
  Region result(box);
  ThreadPool pool;
  const bool finished = for_each_slab(
      pool, box, thickness_of(box, ball.reach.z, pool), progress, [&](std::int64_t begin, std::int64_t end) {
        const SummedRows sums(rows, box, ball.reach, begin, end);
        std::vector<std::uint16_t> counts(length);
        for (std::int64_t k = begin; k < end; ++k) {
          for (std::int64_t j = box.low.y; j < box.high.y; ++j) {
            std::fill(counts.begin(), counts.end(), std::uint16_t{0});
            bool any = false;
            for (const BallRow& part : ball.rows) {
              const std::uint16_t* sum = sums.row(j + part.j, k + part.k);
              if (sum == nullptr) continue;
              any = true;
              const std::uint16_t* const low = sum + (ball.reach.x - part.half);
              const std::uint16_t* const high = sum + (ball.reach.x + part.half + 1);
              for (std::size_t i = 0; i < length; ++i)
                counts[i] = static_cast<std::uint16_t>(counts[i] + high[i] - low[i]);
            }
            for (std::size_t i = 0; any && i < length; ++i) {
              if (2 * std::int64_t{counts[i]} > voxels)
                result.add({box.low.x + static_cast<std::int64_t>(i), j, k});
            }
          }
        }
      });
  if (!finished) return cancelled_error();
  return result;
}

namespace {

// Half of a Gaussian from its middle on, normalised with the other half; cut at 3 sigma.
std::vector<float> gaussian(double sigma_voxels) {
  constexpr double kCut = 3.0;
  const auto reach = static_cast<std::size_t>(std::ceil(kCut * sigma_voxels));
  std::vector<double> weights(reach + 1);
  double sum = 0.0;
  for (std::size_t n = 0; n <= reach; ++n) {
    const double at = static_cast<double>(n) / sigma_voxels;
    weights[n] = std::exp(-0.5 * at * at);
    sum += n == 0 ? weights[n] : 2.0 * weights[n];
  }
  std::vector<float> normalised(weights.size());
  for (std::size_t n = 0; n <= reach; ++n) normalised[n] = static_cast<float>(weights[n] / sum);
  return normalised;
}

// Adds the lines that lie `n` before and behind, times a weight.
void add_lines(float weight, const float* before, const float* behind, std::size_t length, float* sum) {
  for (std::size_t i = 0; i < length; ++i) sum[i] += weight * (before[i] + behind[i]);
}

// The region after the Gaussian, slice by slice of a box. All threads work on the same slice: with slices of
// its own each would take as much memory as they do together.
class Blur {
 public:
  Blur(const Region& region, const Geometry& grid, double sigma_mm)
      : weights_{gaussian(sigma_mm / grid.spacing_mm.x), gaussian(sigma_mm / grid.spacing_mm.y),
                 gaussian(sigma_mm / grid.spacing_mm.z)},
        reach_{std::ssize(weights_[0]) - 1, std::ssize(weights_[1]) - 1, std::ssize(weights_[2]) - 1},
        box_(region.bounds().widened(reach_, grid.size)),
        rows_(region, box_, reach_, grid.size),
        size_(box_.high - box_.low),
        length_(static_cast<std::size_t>(size_.x)),
        lines_(length_ * static_cast<std::size_t>(size_.y + 2 * reach_.y)),
        ring_(static_cast<std::size_t>(std::min(2 * reach_.z + 1, size_.z)),
              std::vector<float>(length_ * static_cast<std::size_t>(size_.y))) {}

  [[nodiscard]] const VoxelRange& box() const { return box_; }

  // Calls row(first voxel, values from 0 to 1, member of the pool) for all rows of the box. False: cancelled.
  template <class Row>
  bool blur(ThreadPool& pool, const Progress& progress, const Row& row) {
    std::int64_t next = 0;  // of the slices that the ring has not had
    for (std::int64_t k = 0; k < size_.z; ++k) {
      for (; next < std::min(k + reach_.z + 1, size_.z) && !progress.cancelled(); ++next)
        blur_in_slice(pool, next);
      if (progress.cancelled()) return false;
      pool.for_each(size_.y, kRows, [&](std::int64_t begin, std::int64_t end, int member) {
        std::vector<float> sum(length_);
        for (std::int64_t j = begin; j < end; ++j) {
          const float* const middle = blurred(j, k);
          for (std::size_t i = 0; i < length_; ++i) sum[i] = weights_[2][0] * middle[i];
          for (std::int64_t n = 1; n <= reach_.z; ++n)
            add_lines(weights_[2][static_cast<std::size_t>(n)], blurred(j, k - n), blurred(j, k + n), length_,
                      sum.data());
          row(box_.low + Index3(0, j, k), std::span<const float>(sum), member);
        }
      });
      progress(static_cast<double>(k + 1) / static_cast<double>(size_.z), "smoothing");
    }
    return true;
  }

 private:
  static constexpr std::int64_t kRows = 4;  // at a time

  // Rows and slices are counted from the box's first ones.
  [[nodiscard]] std::vector<float>& slice(std::int64_t k) {
    return ring_[static_cast<std::size_t>(k) % ring_.size()];
  }
  // Beyond the box its outermost slice goes on: the grid ends there, or the region reaches less far.
  [[nodiscard]] const float* blurred(std::int64_t j, std::int64_t k) {
    return slice(std::clamp<std::int64_t>(k, 0, size_.z - 1)).data() + j * size_.x;
  }

  // Along i, then along j.
  void blur_in_slice(ThreadPool& pool, std::int64_t k) {
    pool.for_each(size_.y + 2 * reach_.y, kRows, [&](std::int64_t begin, std::int64_t end, int /*member*/) {
      std::vector<float> wide(length_ + 2 * static_cast<std::size_t>(reach_.x));
      for (std::int64_t row = begin; row < end; ++row) {
        const std::int64_t j = box_.low.y - reach_.y + row;
        float* const line = lines_.data() + row * size_.x;
        if (rows_.empty(j, box_.low.z + k)) {
          std::fill_n(line, length_, 0.0F);
          continue;
        }
        rows_.read(j, box_.low.z + k, [&](std::int64_t n, std::uint32_t voxel) {
          wide[static_cast<std::size_t>(n)] = static_cast<float>(voxel);
        });
        const float* const middle = wide.data() + reach_.x;
        for (std::size_t i = 0; i < length_; ++i) line[i] = weights_[0][0] * middle[i];
        for (std::int64_t n = 1; n <= reach_.x; ++n)
          add_lines(weights_[0][static_cast<std::size_t>(n)], middle - n, middle + n, length_, line);
      }
    });
    float* const values = slice(k).data();
    pool.for_each(size_.y, kRows, [&](std::int64_t begin, std::int64_t end, int /*member*/) {
      for (std::int64_t j = begin; j < end; ++j) {
        float* const sum = values + j * size_.x;
        const float* const middle = lines_.data() + (j + reach_.y) * size_.x;
        for (std::size_t i = 0; i < length_; ++i) sum[i] = weights_[1][0] * middle[i];
        for (std::int64_t n = 1; n <= reach_.y; ++n)
          add_lines(weights_[1][static_cast<std::size_t>(n)], middle - n * size_.x, middle + n * size_.x,
                    length_, sum);
      }
    });
  }

  std::array<std::vector<float>, 3> weights_;
  Index3 reach_;
  VoxelRange box_;
  Rows rows_;
  Index3 size_;
  std::size_t length_;                    // of a row
  std::vector<float> lines_;              // of a slice, blurred along i
  std::vector<std::vector<float>> ring_;  // the last slices, as many as one is made of
};

int level_of(float value) {
  return static_cast<int>(std::clamp(value, 0.0F, 1.0F) * static_cast<float>(kLevels - 1));
}

// The level from which on there are as nearly as possible so many voxels.
int level_with(const std::vector<std::int64_t>& voxels_at, std::int64_t wanted) {
  std::int64_t above = 0;
  for (int level = kLevels - 1; level > 0; --level) {
    const std::int64_t with_it = above + voxels_at[static_cast<std::size_t>(level)];
    if (with_it >= wanted) return with_it - wanted <= wanted - above ? level : level + 1;
    above = with_it;
  }
  return 1;
}

}  // namespace

Result<Region> smoothed_by_gaussian(const Region& region, const Geometry& grid, double sigma_mm,
                                    const Progress& progress) {
  TIDEMARK_TRY(check(sigma_mm, "the standard deviation of smoothing"));
  if (region.empty()) return Region();
  Blur blur(region, grid, sigma_mm);
  ThreadPool pool;
  // Twice, because its values would take more memory than the volume.
  std::vector<std::vector<std::int64_t>> voxels_at(static_cast<std::size_t>(pool.threads()),
                                                   std::vector<std::int64_t>(kLevels));
  const auto count = [&](Index3 /*first*/, std::span<const float> values, int member) {
    auto& counts = voxels_at[static_cast<std::size_t>(member)];
    for (const float value : values) ++counts[static_cast<std::size_t>(level_of(value))];
  };
  if (!blur.blur(pool, progress.part(0, 2), count)) return cancelled_error();
  for (std::size_t member = 1; member < voxels_at.size(); ++member) {
    for (std::size_t level = 0; level < kLevels; ++level) voxels_at[0][level] += voxels_at[member][level];
  }
  const int level = level_with(voxels_at[0], region.count());
  Region result(blur.box());
  const auto take = [&](Index3 voxel, std::span<const float> values, int /*member*/) {
    for (const float value : values) {
      if (level_of(value) >= level) result.add(voxel);
      ++voxel.x;
    }
  };
  if (!blur.blur(pool, progress.part(1, 2), take)) return cancelled_error();
  return result;
}

}  // namespace tidemark::imaging
