#include "engine/case_balance.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/case_proxy.h"
#include "solver/surface_places.h"

namespace tidemark::engine {
namespace {

constexpr double kReach = 8.0;     // voxels from a chosen place to the surface
constexpr double kFollows = 40.0;  // voxels that the front may have gone on

double smallest_spacing_mm(const Geometry& geometry) {
  return std::min({geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z});
}

// A direction of the patient in voxel coordinates, of length 1 there.
glm::dvec3 along_voxels(const Geometry& geometry, glm::dvec3 way) {
  return glm::normalize(geometry.to_voxel(geometry.origin_mm + way));
}

ExplainedPlace explained(const solver::StepInputs& inputs, glm::dvec3 voxel) {
  const Geometry& geometry = inputs.phi->geometry;
  const solver::PlaceBalance here(inputs, voxel);
  ExplainedPlace place;
  place.place_mm = geometry.to_patient(voxel);
  place.balance = here.balance();
  place.outward = geometry.direction * place.balance.outward;
  place.spacing_mm = smallest_spacing_mm(geometry);
  place.time_step = inputs.time_step;
  place.parameters = inputs.parameters;
  place.has_tent = inputs.speed == nullptr;
  const double sum = place.balance.pushes.sum();
  const double moves = solver::kConvergedSpeed;
  if (sum < moves) place.to_outward = {here.alpha_for(moves), here.range_for(moves)};
  if (sum > -moves) place.to_inward = {here.alpha_for(-moves), here.range_for(-moves)};
  return place;
}

}  // namespace

std::optional<solver::StepInputs> step_inputs(const CaseState& state) {
  if (!state.begun || !state.phi || !state.source || state.time_step <= 0.0) return std::nullopt;
  if (state.lacks_speed) return std::nullopt;
  if (state.phi->geometry.size != state.source->geometry.size) return std::nullopt;
  return solver::StepInputs{state.phi,         state.source,    state.parameters,  state.speed,
                            state.constraints, state.time_step, state.moving_pages};
}

bool ExplainedPlace::rests() const {
  return std::abs(balance.pushes.sum()) <= solver::kConvergedSpeed;
}

CaseBalance::CaseBalance(CaseProxy& proxy)
    : QObject(nullptr), proxy_(proxy), question_(this, &CaseBalance::explain, [this] { take(); }) {
  connect(&proxy, &CaseProxy::state_changed, this, &CaseBalance::follow);
}

CaseBalance::~CaseBalance() = default;

void CaseBalance::ask(glm::dvec3 place_mm) {
  Chosen chosen;
  chosen.place_mm = place_mm;
  choose(chosen);
  emit show_wanted();
}

void CaseBalance::ask_in_passing(glm::dvec3 place_mm) {
  Chosen chosen;
  chosen.place_mm = place_mm;
  chosen.in_passing = true;
  choose(chosen);
}

void CaseBalance::passed() {
  if (chosen_ && chosen_->in_passing) forget();
}

void CaseBalance::ask_fastest() {
  Chosen chosen;
  chosen.fastest = true;
  choose(chosen);
  emit show_wanted();
}

void CaseBalance::choose(const Chosen& chosen) {
  chosen_ = chosen;
  chosen_->number = ++choices_;
  follow();
  emit changed();
}

void CaseBalance::forget() {
  if (!chosen_) return;
  chosen_.reset();
  shown_.reset();
  question_.forget();
  emit changed();
}

void CaseBalance::follow() {
  if (!chosen_) return;
  const auto inputs = step_inputs(proxy_.state());
  if (!inputs) {
    question_.forget();
    if (std::exchange(shown_, std::nullopt)) emit changed();
    return;
  }
  question_.ask({*inputs, chosen_->place_mm, chosen_->outward, chosen_->fastest, chosen_->number});
}

CaseBalance::Answer CaseBalance::explain(const Question& question, const std::stop_token& stop) {
  const solver::StepInputs& inputs = question.inputs;
  const Geometry& geometry = inputs.phi->geometry;
  std::optional<glm::dvec3> voxel;
  if (question.fastest) {
    voxel = solver::fastest_place(inputs, stop);
  } else {
    // The front may have gone far since the place was found on it.
    const glm::dvec3 asked = geometry.to_voxel(question.place_mm);
    if (question.outward != glm::dvec3(0.0))
      voxel = solver::surface_along(*inputs.phi, asked, along_voxels(geometry, question.outward), kFollows);
    if (!voxel) voxel = solver::surface_near(*inputs.phi, asked, kReach);
  }
  return voxel ? Answer(explained(inputs, *voxel)) : std::nullopt;
}

// Slices that show a part of the volume are centred on the place, too.
void CaseBalance::go_to(glm::dvec3 place_mm) {
  proxy_.display().change([&](DisplaySettings& settings) {
    settings.cursor_mm = place_mm;
    if (settings.slice_zoom > 1.0) settings.slice_centre_mm = place_mm;
  });
}

void CaseBalance::take() {
  if (!question_.answer()) {
    shown_.reset();
    return emit changed();
  }
  const auto& [question, place] = *question_.answer();
  if (!chosen_ || question.number != chosen_->number) return;
  shown_ = place;
  if (place) {
    chosen_->place_mm = place->place_mm;
    chosen_->outward = place->outward;
    // From now on that place is asked for, whatever moves most later.
    if (std::exchange(chosen_->fastest, false)) {
      follow();
      go_to(chosen_->place_mm);
    }
  }
  emit changed();
}

}  // namespace tidemark::engine
