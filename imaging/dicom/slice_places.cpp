#include "imaging/dicom/slice_places.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace tidemark::imaging {
namespace {

// A distance that occurs in more than this share of all steps is a usual one.
constexpr double kUsualShare = 0.25;

double tolerance(double distance) {
  return std::max(1e-3 * distance, 0.01) + 1e-9;
}

// The first step that does not go sideways by `slope` mm a mm.
std::optional<std::size_t> first_beside(const SlicePlaces& places, glm::dvec2 slope) {
  for (std::size_t k = 0; k < places.last(); ++k) {
    const glm::dvec2 step = places.sideways[k + 1] - places.sideways[k];
    if (!is_straight(glm::length(step - slope * places.step(k)), places.step(k))) return k;
  }
  return std::nullopt;
}

std::vector<double> sorted_steps(const SlicePlaces& places) {
  std::vector<double> steps;
  for (std::size_t k = 0; k < places.last(); ++k) steps.push_back(places.step(k));
  std::sort(steps.begin(), steps.end());
  return steps;
}

// Of two, the smaller: a gap is the exception.
double middle_distance(const std::vector<double>& sorted) {
  return sorted[(sorted.size() - 1) / 2];
}

// The smallest that is usual; the middle one where none is.
double usual_distance(const std::vector<double>& sorted) {
  const double enough = kUsualShare * static_cast<double>(sorted.size());
  for (auto first = sorted.begin(); first != sorted.end();) {
    const auto other = std::find_if(first, sorted.end(), [&](double d) { return !is_distance(d, *first); });
    if (static_cast<double>(other - first) > enough) return *(first + (other - first - 1) / 2);
    first = other;
  }
  return middle_distance(sorted);
}

// Whether slices lie where the scale has them: small deviations to the same side add up.
bool fits(const SliceScale& scale, const SlicePlaces& places) {
  for (std::size_t k = 0; k < places.along.size(); ++k) {
    const double beside = std::abs(places.along[k] - scale.step_mm * scale.places[k]);
    if (beside > std::max(0.1 * scale.step_mm, tolerance(scale.step_mm))) return false;
  }
  return true;
}

// The slices on an even scale, with gaps or without; nothing where they do not fit it.
std::optional<SliceScale> even_scale(const SlicePlaces& places, double usual) {
  SliceScale scale;
  scale.places.push_back(0.0);
  for (std::size_t k = 0; k < places.last(); ++k) {
    const double multiple = std::max(1.0, std::round(places.step(k) / usual));
    if (std::abs(places.step(k) - multiple * usual) > multiple * tolerance(usual)) return std::nullopt;
    if (multiple > 1.0) scale.kind = SliceScale::Kind::missing;
    scale.places.push_back(scale.places.back() + multiple);
  }
  scale.step_mm = places.along.back() / scale.places.back();
  if (!fits(scale, places)) return std::nullopt;
  return scale;
}

}  // namespace

bool is_distance(double distance, double wanted) {
  return std::abs(distance - wanted) <= tolerance(wanted);
}

bool is_straight(double sideways, double length) {
  return sideways <= tolerance(length);
}

SlicePlaces places_of(const std::vector<glm::dvec3>& positions_mm, const glm::dmat3& axes) {
  SlicePlaces places;
  for (const glm::dvec3& position : positions_mm) {
    const glm::dvec3 from_first = position - positions_mm.front();
    places.along.push_back(glm::dot(from_first, axes[2]));
    places.sideways.emplace_back(glm::dot(from_first, axes[0]), glm::dot(from_first, axes[1]));
  }
  return places;
}

SliceTilt tilt_of(const SlicePlaces& places) {
  const glm::dvec2 sideways = places.sideways.back();
  const double whole = places.along.back();
  // Small steps to the same side add up.
  if (!first_beside(places, glm::dvec2(0.0)) && is_straight(glm::length(sideways), whole)) return {};
  const glm::dvec2 slope = sideways / whole;
  return {std::atan(glm::length(slope)) * 180.0 / std::numbers::pi, first_beside(places, slope)};
}

std::int64_t SliceScale::slices() const {
  return std::llround(places.back()) + 1;
}

std::int64_t SliceScale::missing_after(std::size_t k) const {
  return kind == Kind::missing ? std::llround(places[k + 1] - places[k]) - 1 : 0;
}

SliceScale scale_of(const SlicePlaces& places) {
  const auto steps = sorted_steps(places);
  const double usual = usual_distance(steps);
  for (const double distance : {middle_distance(steps), usual}) {
    if (const auto scale = even_scale(places, distance)) return *scale;
  }
  SliceScale scale;
  scale.kind = SliceScale::Kind::uneven;
  scale.step_mm = usual;
  for (const double along : places.along) scale.places.push_back(along / usual);
  return scale;
}

}  // namespace tidemark::imaging
