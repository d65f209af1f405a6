#include "engine/state_comparison.h"

#include "core/without_exceptions.h"

namespace tidemark::engine {

StateComparison::StateComparison(QObject* parent)
    : QObject(parent), question_(this, &StateComparison::agreement_of, [this] { emit changed(); }) {}

void StateComparison::choose(std::optional<std::uint64_t> state) {
  if (state == chosen_) return;
  const HistoryRow* row = state && rows_ ? find_row(*rows_, *state) : nullptr;
  chosen_ = row == nullptr ? std::nullopt : state;
  phi_ = row == nullptr ? nullptr : row->state.steering.phi;
  question_.forget();
  emit changed();
  compare();
}

void StateComparison::follow(const CaseState& state) {
  rows_ = state.history;
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
