#include "solver/voxel_values.h"

#include <algorithm>
#include <cmath>

#include "solver/reference/gather-inl.h"
#include "solver/speed/curvature-inl.h"
#include "solver/speed/tent_speed.h"

namespace tidemark::solver {

double data_speed(const Parameters& parameters, double intensity) {
  const Tent tent = tent_of(parameters);
  return std::max(tent.peak - std::abs(intensity - tent.target) * tent.slope, tent.floor);
}

VoxelValues values_at(const Field& phi, Index3 voxel) {
  VoxelValues values;
  values.phi = phi.at(voxel);
  if (std::abs(values.phi) >= phi.band) return values;
  double inverse_spacing[3];
  const glm::dvec3 spacing = phi.geometry.spacing_mm;
  const double smallest = std::min({spacing.x, spacing.y, spacing.z});
  for (int axis = 0; axis < 3; ++axis) inverse_spacing[axis] = smallest / spacing[axis];
  const auto stencil = HWY_NAMESPACE::gather([&](Index3 n) { return phi.at(n); }, phi.geometry.size, voxel);
  const auto differences = HWY_NAMESPACE::differences<true, double>(stencil, inverse_spacing);
  values.gradient = 0.5 * std::sqrt(differences.two_central[0] * differences.two_central[0] +
                                    differences.two_central[1] * differences.two_central[1] +
                                    differences.two_central[2] * differences.two_central[2]);
  values.curvature = HWY_NAMESPACE::curvature<double>(differences);
  return values;
}

}  // namespace tidemark::solver
