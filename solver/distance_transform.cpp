#include "solver/distance_transform.h"

#include <algorithm>
#include <cmath>
#include <glm/gtx/component_wise.hpp>
#include <limits>

namespace tidemark {
namespace {

// The squared distance along one axis, in units of the smallest spacing, from a voxel's centre to the
// nearest point of the box of the voxel that is `steps` further.
float axis_distance_squared(std::int64_t steps, double spacing) {
  const double distance = steps == 0 ? 0.0 : (static_cast<double>(steps) - 0.5) * spacing;
  return static_cast<float>(distance * distance);
}

// The squared distance from each voxel to the nearest box of a voxel of the other kind is separable: it is
// the least sum of the axes' squared distances. Each pass takes the least over one axis, no further than the
// band reaches.
void lower_along_axis(const Geometry& geometry, int axis, double spacing, double band,
                      const std::vector<float>& from, std::vector<float>& to) {
  const auto reach = static_cast<std::int64_t>(std::ceil(band / spacing + 0.5));
  std::vector<float> cost;
  for (std::int64_t steps = 0; steps <= reach; ++steps) cost.push_back(axis_distance_squared(steps, spacing));

  const Index3 size = geometry.size;
  const std::int64_t stride = axis == 0 ? 1 : axis == 1 ? size.x : size.x * size.y;
  const std::int64_t length = size[axis];
  // Rows run along the fastest axis that is not `axis`, so that memory is walked in order.
  const std::int64_t inner = axis == 0 ? 1 : stride;
  const std::int64_t outer = geometry.voxel_count() / (length * inner);
  for (std::int64_t block = 0; block < outer; ++block) {
    const std::int64_t base = block * length * inner;
    for (std::int64_t position = 0; position < length; ++position) {
      const std::int64_t low = std::max<std::int64_t>(0, position - reach);
      const std::int64_t high = std::min(length - 1, position + reach);
      float* result = to.data() + base + position * inner;
      std::fill_n(result, inner, std::numeric_limits<float>::infinity());
      for (std::int64_t other = low; other <= high; ++other) {
        const float step_cost = cost[static_cast<std::size_t>(std::abs(other - position))];
        const float* source = from.data() + base + other * inner;
        for (std::int64_t i = 0; i < inner; ++i) result[i] = std::min(result[i], source[i] + step_cost);
      }
    }
  }
}

// Squared distances from every voxel to the nearest voxel for which mask != 0 equals `inside`.
std::vector<float> squared_distances(const Mask& mask, bool inside, glm::dvec3 spacing, double band) {
  std::vector<float> distances(mask.voxels.size());
  std::transform(mask.voxels.begin(), mask.voxels.end(), distances.begin(), [&](std::uint8_t voxel) {
    return (voxel != 0) == inside ? 0.0F : std::numeric_limits<float>::infinity();
  });
  std::vector<float> other(distances.size());
  for (int axis = 0; axis < 3; ++axis) {
    lower_along_axis(mask.geometry, axis, spacing[axis], band, distances, other);
    distances.swap(other);
  }
  return distances;
}

}  // namespace

Field distance_transform(const Mask& mask, double band, Index3 page_shape) {
  const glm::dvec3 spacing = mask.geometry.spacing_mm / glm::compMin(mask.geometry.spacing_mm);
  std::vector<float> phi = squared_distances(mask, false, spacing, band);  // > 0 inside
  {
    const std::vector<float> to_inside = squared_distances(mask, true, spacing, band);
    const auto limit = static_cast<float>(band);
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const bool inside = mask.voxels[i] != 0;
      const float distance = std::min(std::sqrt(inside ? phi[i] : to_inside[i]), limit);
      phi[i] = inside ? distance : -distance;
    }
  }
  return Field::from_dense(mask.geometry, phi, band, page_shape);
}

}  // namespace tidemark
