#include "solver/statistics.h"

#include <algorithm>
#include <cmath>
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

// The area is the integral of delta(phi) |grad phi|, with a hat function for delta that reaches 1.5 voxel
// spacings of the coarsest axis to both sides, but never beyond the band.
SurfaceStatistics measure(const Field& phi) {
  SurfaceStatistics result;
  const PageLayout& layout = phi.layout;
  const double smallest = glm::compMin(phi.geometry.spacing_mm);
  const double reach = std::min(1.5 * glm::compMax(phi.geometry.spacing_mm) / smallest, 0.75 * phi.band);
  const double voxel_mm3 = phi.geometry.voxel_volume_ml() * 1000.0;
  double area = 0.0;
  for (std::int64_t page = 0; page < layout.page_count(); ++page) {
    const std::int32_t entry = phi.table[static_cast<std::size_t>(page)];
    if (entry == Field::kOutside) continue;
    const Index3 valid = layout.valid_shape(page);
    if (entry == Field::kInside) {
      result.voxels_inside += valid.x * valid.y * valid.z;
      continue;
    }
    const Index3 first = layout.first_voxel(page);
    for (std::int64_t z = 0; z < valid.z; ++z) {
      for (std::int64_t y = 0; y < valid.y; ++y) {
        for (std::int64_t x = 0; x < valid.x; ++x) {
          const Index3 voxel = first + Index3(x, y, z);
          const double value = phi.at(voxel);
          if (value > 0.0) ++result.voxels_inside;
          if (std::abs(value) >= reach) continue;
          const glm::dvec3 gradient = gradient_per_mm(phi, voxel);
          const double delta = (1.0 - std::abs(value) / reach) / reach;
          area += delta * std::sqrt(gradient.x * gradient.x + gradient.y * gradient.y +
                                    gradient.z * gradient.z);
        }
      }
    }
  }
  result.volume_ml = static_cast<double>(result.voxels_inside) * phi.geometry.voxel_volume_ml();
  result.surface_mm2 = area * voxel_mm3;
  return result;
}

}  // namespace tidemark
