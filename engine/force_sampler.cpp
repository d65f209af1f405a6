#include "engine/force_sampler.h"

#include <cmath>

namespace tidemark::engine {
namespace {

constexpr std::size_t kMostPlaces = 240;  // so that a view paints their arrows in some 10 ms

// Farther apart where there would be too many: their number goes with the length of an outline, or the area
// of a surface.
std::vector<glm::dvec3> places_of(const ForceSampler::Question& question, const std::stop_token& stop) {
  const solver::Field& phi = *question.inputs.phi;
  auto places = solver::surface_places(phi, question.slab, question.apart_mm, stop);
  if (places.size() <= kMostPlaces) return places;
  const double too_many = static_cast<double>(places.size()) / static_cast<double>(kMostPlaces);
  const double apart_mm = question.apart_mm * (question.slab ? too_many : std::sqrt(too_many));
  return solver::surface_places(phi, question.slab, apart_mm, stop);
}

std::vector<PlaceForces> forces_of(const ForceSampler::Question& question, const std::stop_token& stop) {
  const solver::StepInputs& inputs = question.inputs;
  const Geometry& geometry = inputs.phi->geometry;
  std::vector<PlaceForces> forces;
  for (const glm::dvec3& place : places_of(question, stop)) {
    if (stop.stop_requested()) break;
    const solver::Balance balance = solver::PlaceBalance(inputs, place).balance();
    forces.push_back({geometry.to_patient(place), geometry.direction * balance.outward, balance.pushes});
  }
  return forces;
}

}  // namespace

ForceSampler::ForceSampler(QObject* parent)
    : QObject(parent), question_(this, forces_of, [this] { emit answered(); }) {}

const std::vector<PlaceForces>& ForceSampler::forces() const {
  static const std::vector<PlaceForces> kNone;
  return question_.answer() ? question_.answer()->answer : kNone;
}

}  // namespace tidemark::engine
