#include "engine/state_comparison.h"

#include <utility>

#include "core/without_exceptions.h"

namespace tidemark::engine {

StateComparison::StateComparison(AskForPhi ask, QObject* parent)
    : QObject(parent),
      ask_(std::move(ask)),
      question_(this, &StateComparison::agreement_of, [this] { emit changed(); }) {}

void StateComparison::choose(std::optional<std::uint64_t> state) {
  if (state == chosen_) return;
  chosen_ = state;
  phi_.reset();
  question_.forget();
  emit changed();
  if (!chosen_) return;
  ask_(*chosen_, [this, asked = *chosen_](Phi phi) {
    if (chosen_ != asked) return;
    if (!phi) return choose(std::nullopt);
    phi_ = std::move(phi);
    emit changed();
    compare();
  });
}

void StateComparison::follow(const CaseState& state) {
  if (chosen_ && !find_row(*state.history, *chosen_)) return choose(std::nullopt);  // it was forgotten
  if (state.playing) return;
  present_ = state.phi;
  compare();
}

void StateComparison::compare() {
  if (phi_ && present_) question_.ask({present_, phi_});
}

// What could not be computed, for lack of memory, is not known.
StateComparison::Agreement StateComparison::agreement_of(const Question& question,
                                                         const std::stop_token& stop) {
  const auto found = without_exceptions([&] {
    return solver::agreement(*question.present, *question.other, {nullptr, stop});
  });
  return found ? Agreement(*found) : std::nullopt;
}

const StateComparison::Agreement& StateComparison::agreement() const {
  static const Agreement kUnknown;
  return question_.answer() ? question_.answer()->answer : kUnknown;
}

}  // namespace tidemark::engine
