// The history of a level set as values: what led to each state, and phi there.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "document/change.h"
#include "document/curve.h"
#include "document/field_bytes.h"
#include "document/recipe.h"

namespace tidemark::document {

// A state of a level set. Changes of labels alone make none.
struct SavedState {
  std::optional<std::size_t> parent;  // one of those before it; unset: it is the first
  ChangeDescription change;           // from there
  Recipe recipe;
  std::shared_ptr<const Drive> wanted_drive;  // beside the recipe, see LevelSet::wanted_drive()
  Curve curve;
  std::shared_ptr<const solver::Field> phi;
};

// The states of a case. Empty where they are not known.
struct SavedHistory {
  // In files.
  static constexpr std::size_t kMostStates = 1000;
  static constexpr std::size_t kMostEvents = 1'000'000;  // of all recipes together

  std::vector<SavedState> states;  // parents before their children
  std::size_t present = 0;         // of them

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

// What of a history a session file has room for. The states farthest from the present one are left out first;
// so are those with another band than that one, and what lies behind them.
struct HistoryForFile {
  SavedHistory history;
  FieldBytes phi;                   // of its states; pages have the shape of the present one's
  std::vector<std::size_t> phi_of;  // for each state, which of these it has
};
HistoryForFile for_file(const SavedHistory& history);

}  // namespace tidemark::document
