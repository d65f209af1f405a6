// The history of a level set as values: what led to each state, and phi there.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "document/change.h"
#include "document/curve.h"
#include "document/recipe.h"
#include "document/shared_pages.h"

namespace tidemark::document {

// A state of a level set. Changes of labels alone make none.
struct SavedState {
  std::optional<std::size_t> parent;  // one of those before it; unset: it is the first
  ChangeDescription change;           // from there
  Recipe recipe;
  Curve curve;
  std::shared_ptr<const Change> from_parent;  // of a case; null: it is the first, or from a file
  std::size_t phi = 0;                        // of SavedHistory::phi
};

// The states of a case. Empty where they are not known.
struct SavedHistory {
  // In files.
  static constexpr std::size_t kMostStates = 1000;
  static constexpr std::size_t kMostEvents = 1'000'000;  // of all recipes together

  std::vector<SavedState> states;  // parents before their children
  std::size_t present = 0;         // of them
  SharedPages phi;                 // empty: see from_parent

  [[nodiscard]] bool empty() const { return states.empty(); }
};

// The states from the present one outwards, so that each is behind one of its neighbours; with that one.
struct Visit {
  std::size_t state = 0;
  std::size_t from = 0;  // the present one: itself
};
[[nodiscard]] std::vector<Visit> outwards(const SavedHistory& history);
// A part of the history: those states and the present one, which must be connected.
[[nodiscard]] SavedHistory part_of(const SavedHistory& history, const std::vector<bool>& kept);

// With phi of all states, of which the present one's is given. More states than a session file has room for
// are left out, the farthest from the present one first; so are states with another band, and what lies
// behind them.
SavedHistory for_file(const SavedHistory& history, const solver::Field& present);

}  // namespace tidemark::document
