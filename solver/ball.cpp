#include "solver/ball.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "solver/statistics.h"
#include "solver/surface_crossings.h"

namespace tidemark::solver {
namespace {

constexpr std::size_t kFewestCrossings = 24;  // fewer have no shape
constexpr double kStride = 0.02;              // of R^2, that one step of the integration may change
constexpr double kVanished = 1e-6;            // of R^2 at first

}  // namespace

Result<std::optional<Ball>> ball_of(const Field& phi, double tolerance_mm, const Progress& progress) {
  auto crossings = surface_crossings(phi, progress);
  if (!crossings) return pass_on(crossings);
  if (crossings->size() < kFewestCrossings) return std::optional<Ball>();
  glm::dvec3 sum(0.0);
  for (const glm::vec3& point : *crossings) sum += glm::dvec3(point);
  const glm::dvec3 middle = sum / static_cast<double>(crossings->size());
  const double radius_mm = radius_of_ball_mm(measure(phi).volume_ml);
  const bool is_ball = std::all_of(crossings->begin(), crossings->end(), [&](const glm::vec3& point) {
    return std::abs(glm::distance(glm::dvec3(point), middle) - radius_mm) <= tolerance_mm;
  });
  if (!is_ball) return std::optional<Ball>();
  return std::optional(Ball{middle / phi.geometry.spacing_mm, radius_mm});
}

double radius_of_ball_mm(double volume_ml) {
  return std::cbrt(1000.0 * volume_ml * 0.75 * std::numbers::inv_pi);
}

double volume_of_ball_ml(double radius_mm) {
  return 4.0 / 3.0 * std::numbers::pi * radius_mm * radius_mm * radius_mm / 1000.0;
}

double area_of_ball_mm2(double radius_mm) {
  return 4.0 * std::numbers::pi * radius_mm * radius_mm;
}

// With u = R^2: du/dt = 2 growth sqrt(u) - 2 shrinking, which is finite where the ball vanishes. Runge and
// Kutta's method of fourth order, but where the solution is known.
double BallLaw::radius_after(double radius_mm, double time) const {
  if (shrinking == 0.0) return std::max(radius_mm + growth * time, 0.0);
  if (growth == 0.0) return std::sqrt(std::max(radius_mm * radius_mm - 2.0 * shrinking * time, 0.0));
  const auto slope = [this](double u) { return 2.0 * (growth * std::sqrt(std::max(u, 0.0)) - shrinking); };
  double u = radius_mm * radius_mm;
  const double least = kVanished * u;
  while (time > 0.0 && u > least) {
    const double rate = 2.0 * (std::abs(growth) * std::sqrt(u) + shrinking);
    const double stride = std::min(time, kStride * u / rate);
    const double a = slope(u);
    const double b = slope(u + 0.5 * stride * a);
    const double c = slope(u + 0.5 * stride * b);
    const double d = slope(u + stride * c);
    u += stride / 6.0 * (a + 2.0 * b + 2.0 * c + d);
    time -= stride;
  }
  return u > least ? std::sqrt(u) : 0.0;
}

std::optional<double> BallLaw::critical_radius_mm() const {
  if (growth <= 0.0 || shrinking <= 0.0) return std::nullopt;
  return shrinking / growth;
}

BallLaw ball_law(const Parameters& parameters, double data_speed, double smallest_spacing_mm) {
  const double h = smallest_spacing_mm;
  BallLaw law;
  if (parameters.data_term) law.growth = parameters.alpha * data_speed * h;
  if (parameters.curvature_term) law.shrinking = 2.0 * (1.0 - parameters.alpha) * h * h;
  return law;
}

}  // namespace tidemark::solver
