#include "engine/force_sampler.h"

namespace tidemark::engine {
namespace {

std::vector<PlaceForces> forces_of(const ForceSampler::Question& question, const std::stop_token& stop) {
  const solver::StepInputs& inputs = question.inputs;
  const Geometry& geometry = inputs.phi->geometry;
  std::vector<PlaceForces> forces;
  for (const glm::dvec3& place :
       solver::surface_places(*inputs.phi, question.slab, question.apart_mm, stop)) {
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
