#include "solver/balance.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "solver/reference/gather-inl.h"
#include "solver/speed/advection-inl.h"
#include "solver/speed/curvature-inl.h"
#include "solver/speed/rescaling-inl.h"
#include "solver/surface_places.h"
#include "solver/voxel_values.h"

namespace tidemark::solver {
namespace {

using Differences = HWY_NAMESPACE::Differences<double>;

// The model asks for the largest D for the time step alone, which is known.
class UnitSpeed final : public SpeedFunction {
 public:
  void evaluate(const VoxelBox& /*box*/, double* /*speed*/) const override {}
};

StepConstants<double> constants_of(const StepInputs& inputs, Parameters parameters) {
  parameters.band = inputs.phi->band;
  auto constants = Model(inputs.phi->geometry, parameters, UnitSpeed()).constants<double>();
  constants.time_step = inputs.time_step;
  return constants;
}

double speed_at(const StepInputs& inputs, Index3 voxel) {
  if (inputs.speed == nullptr) return data_speed(inputs.parameters, inputs.source->value(voxel));
  double speed = 0.0;
  inputs.speed->evaluate({voxel, Index3(1)}, &speed);
  return speed;
}

// Where the continuous `f` is `wanted` between `near` and `far`, found by halving.
std::optional<double> crossing(const std::function<double(double)>& f, double wanted, double near,
                               double far) {
  constexpr int kHalvings = 48;
  const bool above = f(near) > wanted;
  if ((f(far) > wanted) == above) return std::nullopt;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (near + far);
    ((f(middle) > wanted) == above ? near : far) = middle;
  }
  return far;
}

std::optional<double> nearest_crossing(const std::function<double(double)>& f, double wanted, double now,
                                       double low, double high) {
  const auto below = crossing(f, wanted, now, low);
  const auto above = crossing(f, wanted, now, high);
  if (!below || !above) return below ? below : above;
  return now - *below < *above - now ? below : above;
}

}  // namespace

struct PlaceBalance::Corner {
  double weight = 0.0;
  Differences differences{};
  double intensity = 0.0;
  double speed = 0.0;
  double advection = 0.0;  // per unit of time
  Constraint constraint = Constraint::none;
};

PlaceBalance::PlaceBalance(const StepInputs& inputs, glm::dvec3 place) : inputs_(inputs) {
  const Field& phi = *inputs_.phi;
  const Index3 size = phi.geometry.size;
  const glm::dvec3 inside = glm::clamp(place, glm::dvec3(0.0), glm::dvec3(size - Index3(1)));
  const glm::dvec3 first = glm::floor(inside);
  const glm::dvec3 share = inside - first;
  const StepConstants<double> constants = constants_of(inputs_, inputs_.parameters);
  const bool advects = inputs_.speed != nullptr && inputs_.speed->advects();
  for (int corner = 0; corner < 8; ++corner) {
    const Index3 step(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const glm::dvec3 weights = glm::mix(glm::dvec3(1.0) - share, share, glm::dvec3(step));
    const double weight = weights.x * weights.y * weights.z;
    if (weight <= 0.0) continue;
    const Index3 voxel = Index3(first) + step;
    const auto stencil = HWY_NAMESPACE::gather([&](Index3 n) { return phi.at(n); }, size, voxel);
    Corner& c = corners_.emplace_back();
    c.weight = weight;
    c.differences = HWY_NAMESPACE::differences<true, double>(stencil, constants.inverse_spacing);
    c.intensity = inputs_.source->value(voxel);
    c.speed = speed_at(inputs_, voxel);
    if (advects) {
      glm::vec3 velocity(0.0F);
      inputs_.speed->evaluate_advection({voxel, Index3(1)}, &velocity);
      c.advection = HWY_NAMESPACE::advected<double>(
          stencil, {velocity.x * constants.inverse_spacing[0], velocity.y * constants.inverse_spacing[1],
                    velocity.z * constants.inverse_spacing[2]});
    }
    if (inputs_.constraints != nullptr) c.constraint = inputs_.constraints->at(voxel);
  }
}

PlaceBalance::~PlaceBalance() = default;

// The weights that update-inl.h gives the gradients, taken apart by term. In the paper's scheme data and
// curvature share the gradient that their sum asks for.
Pushes PlaceBalance::pushes_at(const Corner& corner, double speed, const StepConstants<double>& k) const {
  const Differences& d = corner.differences;
  Pushes pushes;
  const double data = k.data_weight * speed;
  if (inputs_.parameters.scheme == Scheme::paper) {
    const double curvature = k.curvature_weight * HWY_NAMESPACE::curvature<double>(d);
    const double gradient = data + curvature > 0.0 ? d.upwind_growing : d.upwind_shrinking;
    pushes.data = data * gradient;
    pushes.curvature = curvature * gradient;
  } else {
    pushes.data = data * (data > 0.0 ? d.upwind_growing : d.upwind_shrinking);
    pushes.curvature = k.curvature_weight * HWY_NAMESPACE::curvature_motion<double>(d);
  }
  pushes.rescaling = k.rescaling_weight * HWY_NAMESPACE::rescaling_speed<double>(d, k.target_gradient);
  pushes.advection = corner.advection;
  const double free = d.phi + k.time_step * pushes.sum();
  const double kept = limited(corner.constraint, std::clamp(free, -k.band, k.band));
  pushes.limits = (kept - free) / k.time_step;
  return pushes;
}

Balance PlaceBalance::balance() const {
  const StepConstants<double> constants = constants_of(inputs_, inputs_.parameters);
  Balance balance;
  glm::dvec3 inward(0.0);
  for (const Corner& corner : corners_) {
    const Pushes pushes = pushes_at(corner, corner.speed, constants);
    balance.pushes.data += corner.weight * pushes.data;
    balance.pushes.curvature += corner.weight * pushes.curvature;
    balance.pushes.rescaling += corner.weight * pushes.rescaling;
    balance.pushes.advection += corner.weight * pushes.advection;
    balance.pushes.limits += corner.weight * pushes.limits;
    balance.phi += corner.weight * corner.differences.phi;
    balance.intensity += corner.weight * corner.intensity;
    balance.speed += corner.weight * corner.speed;
    const double* gradient = corner.differences.two_central;
    inward += corner.weight * glm::dvec3(gradient[0], gradient[1], gradient[2]);
  }
  const double length = glm::length(inward);
  if (length > 0.0) balance.outward = -inward / length;
  return balance;
}

double PlaceBalance::sum_with(const Parameters& parameters) const {
  const StepConstants<double> constants = constants_of(inputs_, parameters);
  double sum = 0.0;
  for (const Corner& corner : corners_) {
    const double speed = is_tent() ? data_speed(parameters, corner.intensity) : corner.speed;
    sum += corner.weight * pushes_at(corner, speed, constants).sum();
  }
  return sum;
}

std::optional<double> PlaceBalance::alpha_for(double sum) const {
  const auto sum_at = [&, parameters = inputs_.parameters](double alpha) mutable {
    parameters.alpha = alpha;
    return sum_with(parameters);
  };
  return nearest_crossing(sum_at, sum, inputs_.parameters.alpha, 0.0, 1.0);
}

std::optional<double> PlaceBalance::range_for(double sum) const {
  if (!is_tent()) return std::nullopt;
  // From this range on D is above 0.95 at every corner.
  constexpr double kWide = 20.0;
  double farthest = inputs_.parameters.range;
  for (const Corner& corner : corners_)
    farthest = std::max(farthest, std::abs(corner.intensity - inputs_.parameters.target));
  const auto sum_at = [&, parameters = inputs_.parameters](double range) mutable {
    parameters.range = range;
    return sum_with(parameters);
  };
  return nearest_crossing(sum_at, sum, inputs_.parameters.range, kMinimumRange, kWide * farthest);
}

std::optional<glm::dvec3> fastest_place(const StepInputs& inputs, const std::stop_token& stop) {
  const glm::dvec3 spacing = inputs.phi->geometry.spacing_mm;
  const double apart_mm = 1.5 * std::min({spacing.x, spacing.y, spacing.z});
  std::vector<glm::dvec3> places;
  if (inputs.moving_pages != nullptr) {
    places = surface_places_in(*inputs.phi, *inputs.moving_pages, apart_mm, stop);
  }
  if (places.empty()) places = surface_places(*inputs.phi, std::nullopt, apart_mm, stop);
  std::optional<glm::dvec3> fastest;
  double most = -1.0;
  for (const glm::dvec3& place : places) {
    if (stop.stop_requested()) return std::nullopt;
    const double moves = std::abs(PlaceBalance(inputs, place).balance().pushes.sum());
    if (moves <= most) continue;
    most = moves;
    fastest = place;
  }
  return fastest;
}

}  // namespace tidemark::solver
