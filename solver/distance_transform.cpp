#include "solver/distance_transform.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <limits>

#include "core/thread_pool.h"

namespace tidemark::solver {
namespace {

// The squared distance is separable: from a voxel's centre to the nearest of some boxes it is the least sum
// of the axes' squared distances. Each pass takes the least over one axis, no further than the band reaches.

// The squared distance along an axis, in units of the smallest spacing, from a voxel's centre to the nearest
// point of the box of the voxel that is as many steps away as the index says; infinite beyond the band.
std::vector<float> axis_costs(double spacing, double band) {
  const auto reach = static_cast<std::int64_t>(std::ceil(band / spacing + 0.5));
  std::vector<float> costs = {0.0F};
  for (std::int64_t steps = 1; steps <= reach; ++steps) {
    const double distance = (static_cast<double>(steps) - 0.5) * spacing;
    costs.push_back(static_cast<float>(distance * distance));
  }
  costs.push_back(std::numeric_limits<float>::infinity());
  return costs;
}

// Calls body(offset of its first voxel, y, z) for every row along x, on all threads.
template <class Body>
void for_each_row(const Index3& size, ThreadPool& threads, const Body& body) {
  constexpr std::int64_t kVoxelsPerPiece = 1 << 16;
  const std::int64_t rows_per_piece = std::max<std::int64_t>(1, kVoxelsPerPiece / size.x);
  threads.for_each(size.y * size.z, rows_per_piece, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t row = begin; row < end; ++row) body(row * size.x, row % size.y, row / size.y);
  });
}

// The pass along x: the squared distance in its row from each voxel to the nearest one for which mask != 0
// equals `inside`.
void least_along_x(const Mask& mask, bool inside, const std::vector<float>& costs, ThreadPool& threads,
                   std::vector<float>& to) {
  const std::int64_t length = mask.geometry.size.x;
  const std::size_t none = costs.size() - 1;
  for_each_row(mask.geometry.size, threads, [&](std::int64_t first, std::int64_t, std::int64_t) {
    const std::uint8_t* voxels = mask.voxels.data() + first;
    float* result = to.data() + first;
    std::size_t steps = none;
    const auto next = [&](std::int64_t x) {
      steps = (voxels[x] != 0) == inside ? 0 : std::min(steps + 1, none);
      return costs[steps];
    };
    for (std::int64_t x = 0; x < length; ++x) result[x] = next(x);
    steps = none;
    for (std::int64_t x = length - 1; x >= 0; --x) result[x] = std::min(result[x], next(x));
  });
}

// The pass along y (axis 1) or z (axis 2).
void least_along_axis(const Index3& size, int axis, const std::vector<float>& costs, ThreadPool& threads,
                      const std::vector<float>& from, std::vector<float>& to) {
  const auto reach = static_cast<std::int64_t>(costs.size()) - 2;
  const std::int64_t stride = axis == 1 ? size.x : size.x * size.y;
  for_each_row(size, threads, [&](std::int64_t first, std::int64_t y, std::int64_t z) {
    const std::int64_t position = axis == 1 ? y : z;
    const std::int64_t low = std::max(-position, -reach);
    const std::int64_t high = std::min(size[axis] - 1 - position, reach);
    float* result = to.data() + first;
    std::fill_n(result, size.x, std::numeric_limits<float>::infinity());
    for (std::int64_t steps = low; steps <= high; ++steps) {
      const float cost = costs[static_cast<std::size_t>(std::abs(steps))];
      const float* source = from.data() + first + steps * stride;
      for (std::int64_t x = 0; x < size.x; ++x) result[x] = std::min(result[x], source[x] + cost);
    }
  });
}

// Squared distances from every voxel to the nearest voxel for which mask != 0 equals `inside`. `scratch` is
// as large as the mask.
std::vector<float> squared_distances(const Mask& mask, bool inside, glm::dvec3 spacing, double band,
                                     ThreadPool& threads, std::vector<float>& scratch) {
  const Index3 size = mask.geometry.size;
  std::vector<float> distances(mask.voxels.size());
  least_along_x(mask, inside, axis_costs(spacing.x, band), threads, distances);
  least_along_axis(size, 1, axis_costs(spacing.y, band), threads, distances, scratch);
  least_along_axis(size, 2, axis_costs(spacing.z, band), threads, scratch, distances);
  return distances;
}

}  // namespace

Field distance_transform(const Mask& mask, double band, Index3 page_shape) {
  const glm::dvec3 spacing = mask.geometry.spacing_mm / glm::compMin(mask.geometry.spacing_mm);
  ThreadPool threads;
  std::vector<float> phi;  // > 0 inside
  {
    std::vector<float> scratch(mask.voxels.size());
    phi = squared_distances(mask, false, spacing, band, threads, scratch);
    const std::vector<float> to_inside = squared_distances(mask, true, spacing, band, threads, scratch);
    const auto limit = static_cast<float>(band);
    for_each_row(mask.geometry.size, threads, [&](std::int64_t first, std::int64_t, std::int64_t) {
      for (std::int64_t voxel = first; voxel < first + mask.geometry.size.x; ++voxel) {
        const auto i = static_cast<std::size_t>(voxel);
        const bool inside = mask.voxels[i] != 0;
        const float distance = std::min(std::sqrt(inside ? phi[i] : to_inside[i]), limit);
        phi[i] = inside ? distance : -distance;
      }
    });
  }
  return Field::from_dense(mask.geometry, phi, band, page_shape);
}

}  // namespace tidemark::solver
