// The history of a level set as values, for session files: what led to each state, and phi there.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "document/change.h"
#include "document/curve.h"
#include "document/recipe.h"

namespace tidemark::document {

class Case;

// phi of several states: a page that several have is there once.
class SharedPages {
 public:
  SharedPages() = default;
  // Of fields on that grid with that band.
  SharedPages(const Geometry& geometry, double band, Index3 page_shape);

  // The next state. Its pages are compared with those of the state `like`, unless it is the first.
  void add(const solver::Field& phi, std::size_t like);
  [[nodiscard]] solver::Field field(std::size_t state) const;
  [[nodiscard]] std::size_t size() const { return tables_.size(); }

  // Files.
  [[nodiscard]] const solver::PageLayout& layout() const { return empty_.layout; }
  [[nodiscard]] const std::vector<float>& pages() const { return pages_; }
  [[nodiscard]] const std::vector<std::vector<std::int32_t>>& tables() const { return tables_; }
  // Fails (ErrorKind::input) when a table names a page that is not there, or a value is not finite or beyond
  // the band. `what` is for the message.
  Status assign(std::vector<float> pages, std::vector<std::vector<std::int32_t>> tables,
                const std::string& what);

 private:
  solver::Field empty_;  // grid, band and the shape of pages
  std::vector<float> pages_;
  std::vector<std::vector<std::int32_t>> tables_;  // a state: a virtual page's index in `pages_`, as Field's
};

// A state of a level set. Changes of labels alone make none.
struct SavedState {
  std::optional<std::size_t> parent;  // one of those before it; unset: the first
  ChangeDescription change;
  Recipe recipe;
  Curve curve;
  std::shared_ptr<const Change> from_parent;  // of a case; null: the first, or it was read from a file
};

// The states of a case that a session keeps. Not empty, unless there is no history.
struct SavedHistory {
  std::vector<SavedState> states;  // parents before their children
  std::size_t present = 0;         // of them
  SharedPages phi;                 // of all states, in their order; empty: see `from_parent`
};

// As long as no change is open; else it is empty.
SavedHistory snapshot_of_history(const Case& document);
// The states that are nearest to the present one, and phi of them, as many as find room in a session file:
// each a connected part of the tree.
SavedHistory for_file(const SavedHistory& history, const solver::Field& present);

}  // namespace tidemark::document
