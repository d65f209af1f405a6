#include "solver/voxel_values.h"

#include <algorithm>
#include <cmath>

#include "solver/reference/gather-inl.h"
#include "solver/speed/curvature-inl.h"

namespace tidemark::solver {

double data_speed(const Parameters& parameters, double intensity) {
  const double distance = std::abs(intensity - parameters.target);
  if (parameters.data_form == DataForm::raw) return parameters.range - distance;
  return std::max(-1.0, 1.0 - distance / parameters.range);
}

VoxelValues values_at(const Field& phi, const Volume& source, const Parameters& parameters, Index3 voxel) {
  VoxelValues values;
  values.intensity = source.value(voxel);
  values.data = data_speed(parameters, values.intensity);
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
