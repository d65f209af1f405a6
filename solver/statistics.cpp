#include "solver/statistics.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>

namespace tidemark {
namespace {

// The central difference at a voxel, in phi per mm; one-sided at the volume's border.
glm::dvec3 gradient_per_mm(const Field& phi, Index3 voxel) {
  glm::dvec3 gradient(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    Index3 low = voxel;
    Index3 high = voxel;
    low[axis] = std::max<std::int64_t>(0, voxel[axis] - 1);
    high[axis] = std::min(phi.geometry.size[axis] - 1, voxel[axis] + 1);
    if (low == high) continue;
    const double distance = static_cast<double>(high[axis] - low[axis]) * phi.geometry.spacing_mm[axis];
    gradient[axis] = (static_cast<double>(phi.at(high)) - static_cast<double>(phi.at(low))) / distance;
  }
  return gradient;
}

}  // namespace

// A voxel that the surface may cut counts with the share of it that is inside: the surface is taken as a
// plane at distance phi / |grad phi|, and the share as linear in that distance over the voxel's extent along
// the normal. The area is the integral of delta(phi) |grad phi|, with a hat function for delta that
// reaches 1.5 spacings of the coarsest axis to both sides, but never beyond the band.
SurfaceStatistics measure(const Field& phi) {
  SurfaceStatistics result;
  const PageLayout& layout = phi.layout;
  const glm::dvec3 spacing = phi.geometry.spacing_mm;
  const double smallest = glm::compMin(spacing);
  const double reach = std::min(1.5 * glm::compMax(spacing) / smallest, 0.75 * phi.band);
  double area = 0.0;
  double voxels = 0.0;
  for (std::int64_t page = 0; page < layout.page_count(); ++page) {
    const std::int32_t entry = phi.table[static_cast<std::size_t>(page)];
    if (entry == Field::kOutside) continue;
    const Index3 valid = layout.valid_shape(page);
    const std::int64_t count = valid.x * valid.y * valid.z;
    if (entry == Field::kInside) {
      result.voxels_inside += count;
      voxels += static_cast<double>(count);
      continue;
    }
    const Index3 first = layout.first_voxel(page);
    for (std::int64_t i = 0; i < count; ++i) {
      const Index3 voxel = first + Index3(i % valid.x, i / valid.x % valid.y, i / (valid.x * valid.y));
      const double value = phi.at(voxel);
      const bool inside = value > 0.0;
      if (inside) ++result.voxels_inside;
      const glm::dvec3 gradient = std::abs(value) < reach ? gradient_per_mm(phi, voxel) : glm::dvec3(0.0);
      const double steepness = glm::length(gradient);
      if (steepness == 0.0) {
        voxels += inside ? 1.0 : 0.0;
        continue;
      }
      const double extent = glm::dot(glm::abs(gradient), spacing) / steepness;
      voxels += std::clamp(0.5 + value / (steepness * extent), 0.0, 1.0);
      area += (1.0 - std::abs(value) / reach) / reach * steepness;
    }
  }
  result.volume_ml = voxels * phi.geometry.voxel_volume_ml();
  result.surface_mm2 = area * phi.geometry.voxel_volume_ml() * 1000.0;
  return result;
}

}  // namespace tidemark
