#include "renderer/host/speed_terms.h"

#include <algorithm>
#include <cmath>

#include "renderer/host/trilinear.h"
#include "solver/reference/gather-inl.h"
#include "solver/speed/curvature-inl.h"
#include "solver/speed/rescaling-inl.h"

namespace tidemark::renderer {
float SpeedTerms::data_of(float value) const {
  return static_cast<float>(
      std::max(tent.peak - std::abs(static_cast<double>(value) - tent.target) * tent.slope, tent.floor));
}

SpeedTerms::Values SpeedTerms::at(SpeedTerm term, glm::ivec3 voxel) const {
  namespace per_target = solver::HWY_NAMESPACE;
  const auto phi_at = [&](Index3 v) { return phi.at(glm::ivec3(v)); };
  const auto stencil = per_target::gather(phi_at, phi.layout().domain_size(), Index3(voxel));
  double inverse_spacing[3];
  std::copy_n(constants.inverse_spacing, 3, inverse_spacing);
  const auto differences = per_target::differences<true, double>(stencil, inverse_spacing);
  const double kappa = per_target::curvature<double>(differences);
  const double bending = constants.curvature_weight * kappa;
  const auto data = [&] {
    return constants.data_weight * (map != nullptr ? map->at(voxel) : data_of(source.at(voxel)));
  };
  const auto rescaling = [&] {
    return constants.rescaling_weight *
           per_target::rescaling_speed<double>(differences, static_cast<double>(constants.target_gradient));
  };
  const double speed = term == SpeedTerm::data        ? data()
                       : term == SpeedTerm::curvature ? bending
                       : term == SpeedTerm::rescaling ? rescaling()
                                                      : data() + bending + rescaling();
  return {static_cast<float>(speed), static_cast<float>(kappa)};
}

SpeedTerms::Values SpeedTerms::between(SpeedTerm term, glm::vec3 position) const {
  const Trilinear around(position, source.size());
  Values sum;
  for (int i = 0; i < 8; ++i) {
    const Values there = at(term, around.corner(i));
    sum.speed += around.share(i) * there.speed;
    sum.curvature += around.share(i) * there.curvature;
  }
  return sum;
}

}  // namespace tidemark::renderer
