#include "engine/value_probe.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "core/index_walk.h"
#include "engine/source_summary.h"
#include "solver/parameters.h"

namespace tidemark::engine {

void ValueProbe::add(glm::dvec3 from_mm, glm::dvec3 to_mm, double radius_mm) {
  const Geometry& geometry = volume_->geometry;
  const glm::dvec3 spacing = geometry.spacing_mm;
  const double stride_mm = 0.5 * std::min({spacing.x, spacing.y, spacing.z});
  const auto strides = static_cast<int>(std::ceil(glm::distance(from_mm, to_mm) / stride_mm));
  const Index3 reach(glm::ceil(radius_mm / spacing));
  for (int stride = 0; stride <= strides; ++stride) {
    const double share = strides > 0 ? static_cast<double>(stride) / strides : 0.0;
    const glm::dvec3 centre = geometry.to_voxel(glm::mix(from_mm, to_mm, share));
    const Index3 nearest(glm::round(centre));
    for_each_index(nearest - reach, nearest + reach + Index3(1), [&](Index3 voxel) {
      const bool near = glm::length((glm::dvec3(voxel) - centre) * spacing) <= radius_mm;
      if (geometry.contains(voxel) && (near || voxel == nearest)) add(voxel);
    });
  }
}

void ValueProbe::add(Index3 voxel) {
  if (!seen_.insert(volume_->geometry.offset(voxel)).second) return;
  count_in(value_, volume_->value(voxel));
  count_in(gradient_, gradient_magnitude(*volume_, voxel));
}

void ValueProbe::count_in(Sums& sums, double value) const {
  const double change = value - sums.mean;
  sums.mean += change / static_cast<double>(seen_.size());
  sums.squares += change * (value - sums.mean);
}

ValueProbe::Spread ValueProbe::spread(const Sums& sums) const {
  if (seen_.empty()) return {};
  return {sums.mean, std::sqrt(std::max(sums.squares, 0.0) / static_cast<double>(seen_.size()))};
}

double least_probed_range(double common_low, double common_high) {
  return std::max(0.01 * (common_high - common_low), solver::kMinimumRange);
}

}  // namespace tidemark::engine
