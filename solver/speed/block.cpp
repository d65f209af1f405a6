#include "solver/speed/block.h"

#include <algorithm>
#include <cmath>

#include "core/typed_volume.h"

namespace tidemark::solver {
namespace {

// sums[i] = weights[0] * values[i] + the sum over d of weights[d] (values[i - d stride] + values[i + d
// stride])
void weighted_sums(const float* values, std::int64_t stride, const std::vector<float>& weights,
                   std::int64_t count, float* sums) {
  constexpr std::int64_t kPiece = 256;  // stays in registers and the nearest cache
  const auto reach = static_cast<std::int64_t>(weights.size()) - 1;
  for (std::int64_t first = 0; first < count; first += kPiece) {
    const std::int64_t length = std::min(kPiece, count - first);
    const float* centre = values + first;
    float* sum = sums + first;
    for (std::int64_t i = 0; i < length; ++i) sum[i] = weights[0] * centre[i];
    for (std::int64_t d = 1; d <= reach; ++d) {
      const float weight = weights[static_cast<std::size_t>(d)];
      const float* before = centre - d * stride;
      const float* after = centre + d * stride;
      for (std::int64_t i = 0; i < length; ++i) sum[i] += weight * (before[i] + after[i]);
    }
  }
}

// sums[i] = values[i] + values[i + stride] + ... of `length` values, out of sums of 1, 2, 4, 8, ... values,
// which take the place of `values`.
void window_sums(float* values, std::int64_t stride, std::int64_t length, std::int64_t count, float* sums) {
  std::fill_n(sums, count, 0.0F);
  std::int64_t valid = count + (length - 1) * stride;
  std::int64_t begin = 0;
  for (std::int64_t power = 1; power <= length; power *= 2) {
    if ((length & power) != 0) {
      const float* part = values + begin * stride;
      for (std::int64_t i = 0; i < count; ++i) sums[i] += part[i];
      begin += power;
    }
    if (2 * power > length) break;
    valid -= power * stride;
    const float* next = values + power * stride;
    for (std::int64_t i = 0; i < valid; ++i) values[i] += next[i];
  }
}

// Replaces the block by sums along each axis. sum(axis, values, stride, count, sums) writes the sums of a run
// of values; it may change the values.
template <class Sum>
void sum_along_axes(Block& block, Index3 reach, const Sum& sum) {
  // The slowest axis first: its sums run over whole slices.
  for (int axis = 2; axis >= 0; --axis) {
    const Index3 size = block.box.size;
    const std::int64_t stride = axis == 0 ? 1 : axis == 1 ? size.x : size.x * size.y;
    const std::int64_t lines = size.x * size.y * size.z / (stride * size[axis]);
    const std::int64_t count = stride * (size[axis] - 2 * reach[axis]);
    std::vector<float> sums(static_cast<std::size_t>(lines * count));
    for (std::int64_t line = 0; line < lines; ++line) {
      sum(axis, block.values.data() + line * stride * size[axis], stride, count, sums.data() + line * count);
    }
    block.values = std::move(sums);
    block.box.first[axis] += reach[axis];
    block.box.size[axis] -= 2 * reach[axis];
  }
}

}  // namespace

Block values_in(const Volume& volume, const VoxelBox& box) {
  Block block{box, std::vector<float>(static_cast<std::size_t>(box.voxels()))};
  with_type(volume, [&](const auto& typed) {
    const Index3 last = typed.geometry.size - Index3(1);
    // Columns of the box that are inside of the grid: [begin, end).
    const std::int64_t begin = std::clamp<std::int64_t>(-box.first.x, 0, box.size.x);
    const std::int64_t end = std::clamp<std::int64_t>(last.x + 1 - box.first.x, begin, box.size.x);
    float* row = block.values.data();
    for (std::int64_t z = box.first.z; z < box.first.z + box.size.z; ++z) {
      for (std::int64_t y = box.first.y; y < box.first.y + box.size.y; ++y, row += box.size.x) {
        const std::int64_t line = typed.geometry.offset(
            {0, std::clamp<std::int64_t>(y, 0, last.y), std::clamp<std::int64_t>(z, 0, last.z)});
        std::fill(row, row + begin, typed.value(line));
        for (std::int64_t x = begin; x < end; ++x) row[x] = typed.value(line + box.first.x + x);
        std::fill(row + end, row + box.size.x, typed.value(line + last.x));
      }
    }
  });
  return block;
}

Index3 reach_of(const AxisWeights& weights) {
  Index3 reach{0};
  for (int axis = 0; axis < 3; ++axis) {
    reach[axis] = static_cast<std::int64_t>(weights[static_cast<std::size_t>(axis)].size()) - 1;
  }
  return reach;
}

void sum_along_axes(Block& block, const AxisWeights& weights) {
  const Index3 reach = reach_of(weights);
  sum_along_axes(block, reach,
                 [&](int axis, float* values, std::int64_t stride, std::int64_t count, float* sums) {
                   weighted_sums(values + reach[axis] * stride, stride,
                                 weights[static_cast<std::size_t>(axis)], count, sums);
                 });
}

void sum_boxes(Block& block, Index3 reach) {
  sum_along_axes(block, reach,
                 [&](int axis, float* values, std::int64_t stride, std::int64_t count, float* sums) {
                   window_sums(values, stride, 2 * reach[axis] + 1, count, sums);
                 });
}

AxisWeights gaussian_weights(const Geometry& geometry, double sigma_mm) {
  AxisWeights all;
  for (int axis = 0; axis < 3; ++axis) {
    const double sigma = sigma_mm / geometry.spacing_mm[axis];
    // Along an axis of one voxel everything is the same.
    const int reach = geometry.size[axis] == 1 ? 0 : static_cast<int>(std::ceil(3.0 * sigma));
    std::vector<double> weights;
    double sum = 0.0;
    for (int d = 0; d <= reach; ++d) {
      weights.push_back(d == 0 ? 1.0 : std::exp(-0.5 * d * d / (sigma * sigma)));
      sum += d == 0 ? 1.0 : 2.0 * weights.back();
    }
    for (const double weight : weights) {
      all[static_cast<std::size_t>(axis)].push_back(static_cast<float>(weight / sum));
    }
  }
  return all;
}

}  // namespace tidemark::solver
