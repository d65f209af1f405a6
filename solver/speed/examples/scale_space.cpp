#include "solver/speed/examples/scale_space.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/thread_pool.h"
#include "core/typed_volume.h"
#include "solver/speed/examples/index.h"
#include "solver/speed/examples/shared_by_volume.h"

namespace tidemark::solver {
namespace {

// Of the common range of values: how far beyond it values keep apart. A few that are far out, as padding is,
// would leave no steps to all others.
constexpr float kFarOut = 32.0F;
constexpr float kMostSteps = 65535.0F;
// The distance of nodes in units of the scale, at most.
constexpr double kNodesPerScale = 1.25;
constexpr std::int64_t kSlicesAtOnce = 8;

// Writes a row of what is to be reduced.
using ReadRow = std::function<void(std::int64_t y, std::int64_t z, float* row)>;

struct Reduction {
  Index3 from;    // nodes
  Index3 size;    // nodes that are left
  Index3 factor;  // from one to the other
  AxisWeights weights;
};

// sums[i] = the weighted sum of line(centre - reach .. centre + reach)[i]. Beyond the ends a volume goes on
// with its last lines.
template <class Line>
void sum_lines(const Line& line, std::int64_t centre, std::int64_t lines, const std::vector<float>& weights,
               std::int64_t length, float* sums) {
  const auto within = [&](std::int64_t n) { return line(std::clamp<std::int64_t>(n, 0, lines - 1)); };
  const float* middle = within(centre);
  for (std::int64_t i = 0; i < length; ++i) sums[i] = weights[0] * middle[i];
  for (std::size_t d = 1; d < weights.size(); ++d) {
    const float* before = within(centre - static_cast<std::int64_t>(d));
    const float* after = within(centre + static_cast<std::int64_t>(d));
    const float weight = weights[d];
    for (std::int64_t i = 0; i < length; ++i) sums[i] += weight * (before[i] + after[i]);
  }
}

// Slices [first, last) of the result.
void reduce_slices(const Reduction& r, const ReadRow& read, std::int64_t first, std::int64_t last,
                   float* result) {
  const std::int64_t reach = reach_of(r.weights).z;
  const std::int64_t low = std::clamp<std::int64_t>(first * r.factor.z - reach, 0, r.from.z - 1);
  const std::int64_t high = std::min((last - 1) * r.factor.z + reach, r.from.z - 1);
  const std::int64_t area = r.from.x * r.from.y;
  std::vector<float> slices(at((high - low + 1) * area));
  for (std::int64_t z = low; z <= high; ++z) {
    for (std::int64_t y = 0; y < r.from.y; ++y) read(y, z, &slices[at((z - low) * area + y * r.from.x)]);
  }
  std::vector<float> slice(at(area));
  std::vector<float> row(at(r.from.x));
  for (std::int64_t z = first; z < last; ++z) {
    const auto slice_at = [&](std::int64_t k) { return &slices[at((k - low) * area)]; };
    sum_lines(slice_at, z * r.factor.z, r.from.z, r.weights[2], area, slice.data());
    const auto row_at = [&](std::int64_t j) { return &slice[at(j * r.from.x)]; };
    for (std::int64_t y = 0; y < r.size.y; ++y) {
      sum_lines(row_at, y * r.factor.y, r.from.y, r.weights[1], r.from.x, row.data());
      const auto value_at = [&](std::int64_t i) { return &row[at(i)]; };
      float* out = result + number_in(r.size, Index3(0, y, z));
      for (std::int64_t x = 0; x < r.size.x; ++x) {
        sum_lines(value_at, x * r.factor.x, r.from.x, r.weights[0], 1, out + x);
      }
    }
  }
}

Result<std::vector<float>> reduced(const Reduction& r, const ReadRow& read, ThreadPool& threads,
                                   const Progress& progress) {
  std::vector<float> result(at(r.size.x * r.size.y * r.size.z));
  threads.for_each(r.size.z, kSlicesAtOnce, [&](std::int64_t first, std::int64_t last, int) {
    if (!progress.cancelled()) reduce_slices(r, read, first, last, result.data());
  });
  if (progress.cancelled()) return cancelled_error();
  return result;
}

// From a grid whose nodes were smoothed with `from_mm` to one that is smoothed with `to_mm`.
Reduction reduction(const ScaleGrid& from, double from_mm, double to_mm) {
  Reduction r{from.size, from.size, Index3(1), {}};
  Geometry nodes;
  nodes.size = from.size;
  nodes.spacing_mm = from.step_mm;
  r.weights = gaussian_weights(nodes, std::sqrt(to_mm * to_mm - from_mm * from_mm));
  for (int axis = 0; axis < 3; ++axis) {
    while (from.step_mm[axis] * static_cast<double>(2 * r.factor[axis]) <= kNodesPerScale * to_mm &&
           r.factor[axis] < from.size[axis]) {
      r.factor[axis] *= 2;
    }
    r.size[axis] = (from.size[axis] - 2 + r.factor[axis]) / r.factor[axis] + 1;
  }
  return r;
}

ReadRow rows_of(const ScaleGrid& grid, bool squared) {
  return [&grid, squared](std::int64_t y, std::int64_t z, float* row) {
    const std::size_t line = at(number_in(grid.size, Index3(0, y, z)));
    for (std::size_t x = 0; x < at(grid.size.x); ++x)
      row[x] = squared ? grid.square(line + x) : grid.mean[line + x];
  };
}

ReadRow rows_of(const Volume& volume, float centre, bool squared) {
  return [&volume, centre, squared](std::int64_t y, std::int64_t z, float* row) {
    with_type(volume, [&](const auto& typed) {
      const std::int64_t line = typed.geometry.offset({0, y, z});
      for (std::int64_t x = 0; x < typed.geometry.size.x; ++x) row[x] = typed.value(line + x) - centre;
    });
    for (std::int64_t x = 0; squared && x < volume.geometry.size.x; ++x) row[x] *= row[x];
  };
}

// The moments in two bytes each. `limit` is how far means may be from the centre.
void store(const std::vector<float>& mean, std::vector<float> square, float limit, ScaleGrid& grid) {
  float low = limit;
  float high = -limit;
  float widest = 0.0F;
  for (std::size_t i = 0; i < mean.size(); ++i) {
    square[i] = std::sqrt(std::max(square[i] - mean[i] * mean[i], 0.0F));
    low = std::min(low, mean[i]);
    high = std::max(high, mean[i]);
    widest = std::max(widest, square[i]);
  }
  grid.mean = EvenSteps(mean, std::max(low, -limit), std::min(high, limit));
  grid.deviation = EvenSteps(square, 0.0F, std::min(widest, limit));
}

SharedByVolume<ScaleSpace> pyramids;  // in use

}  // namespace

EvenSteps::EvenSteps(const std::vector<float>& values, float low, float high)
    : low_(low), step_((high - low) / kMostSteps) {
  const float steps_a_unit = high > low ? kMostSteps / (high - low) : 0.0F;
  steps_.reserve(values.size());
  for (const float value : values) {
    const float within = std::min(std::max(low, value), high);  // low, where there is no number
    const float steps = (within - low) * steps_a_unit;
    steps_.push_back(static_cast<std::uint16_t>(steps + 0.5F));
  }
}

Result<std::shared_ptr<const ScaleSpace>> ScaleSpace::of(const std::shared_ptr<const Volume>& volume,
                                                         const Progress& progress) {
  return pyramids.of(volume, progress.stop, [&] { return make(*volume, progress); });
}

Result<std::shared_ptr<const ScaleSpace>> ScaleSpace::make(const Volume& volume, const Progress& progress) {
  auto space = std::make_shared<ScaleSpace>();
  const Geometry& geometry = volume.geometry;
  space->geometry_ = geometry;
  const auto [low, high] = volume.common_range();
  space->centre_ = 0.5F * (low + high);
  const double unit = std::min({geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z});
  space->finest_ = gaussian_weights(geometry, kFinestScale * unit);

  const float limit = high > low ? kFarOut * (high - low) : std::numeric_limits<float>::max();

  ThreadPool threads;
  const ScaleGrid voxels{geometry.size, Index3(1), geometry.spacing_mm, {}, {}};
  double smoothed_mm = 0.0;
  for (const double scale : kPyramidScales) {
    const bool first = space->grids_.empty();
    const ScaleGrid& from = first ? voxels : space->grids_.back();
    const Reduction r = reduction(from, smoothed_mm, scale * unit);
    ScaleGrid grid{r.size, from.step * r.factor, from.step_mm * glm::dvec3(r.factor), {}, {}};
    auto mean =
        reduced(r, first ? rows_of(volume, space->centre_, false) : rows_of(from, false), threads, progress);
    if (!mean) return pass_on(mean);
    auto square =
        reduced(r, first ? rows_of(volume, space->centre_, true) : rows_of(from, true), threads, progress);
    if (!square) return pass_on(square);
    store(*mean, std::move(*square), limit, grid);
    space->grids_.push_back(std::move(grid));
    smoothed_mm = scale * unit;
  }
  return space;
}

Index3 ScaleSpace::step(int scale) const {
  return scale == 0 ? Index3(1) : grids_[at(scale - 1)].step;
}

Index3 ScaleSpace::size(int scale) const {
  return scale == 0 ? geometry_.size : grids_[at(scale - 1)].size;
}

glm::dvec3 ScaleSpace::step_mm(int scale) const {
  return scale == 0 ? geometry_.spacing_mm : grids_[at(scale - 1)].step_mm;
}

Moments ScaleSpace::moments(const Volume& volume, int scale, const VoxelBox& nodes) const {
  if (scale == 0) {
    Block mean = values_in(volume, grown(nodes, reach_of(finest_)));
    for (float& value : mean.values) value -= centre_;
    Block square = mean;
    for (float& value : square.values) value *= value;
    sum_along_axes(mean, finest_);
    sum_along_axes(square, finest_);
    return {nodes, std::move(mean.values), std::move(square.values)};
  }
  const ScaleGrid& grid = grids_[at(scale - 1)];
  Moments result{nodes, {}, {}};
  result.mean.reserve(at(nodes.voxels()));
  result.square.reserve(at(nodes.voxels()));
  const Index3 last = grid.size - Index3(1);
  for (std::int64_t z = nodes.first.z; z < nodes.first.z + nodes.size.z; ++z) {
    for (std::int64_t y = nodes.first.y; y < nodes.first.y + nodes.size.y; ++y) {
      const std::int64_t line = grid.size.x * (std::clamp<std::int64_t>(y, 0, last.y) +
                                               grid.size.y * std::clamp<std::int64_t>(z, 0, last.z));
      for (std::int64_t x = nodes.first.x; x < nodes.first.x + nodes.size.x; ++x) {
        const std::size_t node = at(line + std::clamp<std::int64_t>(x, 0, last.x));
        result.mean.push_back(grid.mean[node]);
        result.square.push_back(grid.square(node));
      }
    }
  }
  return result;
}

std::int64_t ScaleSpace::memory() const {
  std::int64_t bytes = 0;
  for (const ScaleGrid& grid : grids_) {
    bytes += grid.mean.memory() + grid.deviation.memory();
  }
  return bytes;
}

}  // namespace tidemark::solver
