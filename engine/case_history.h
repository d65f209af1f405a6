// The states of a case's history with figures and small pictures of each.
#pragma once

#include <QImage>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "document/case.h"

namespace tidemark::engine {

// Of a state that has a surface.
struct StateFigures {
  double volume_ml = 0.0;
  QImage picture;  // see picture_of_state(); null where nothing is inside

  bool operator==(const StateFigures&) const = default;
};

// A state as lists show it. Figures come later, when the case rests.
struct HistoryRow {
  document::HistoryState state;
  std::optional<StateFigures> figures;

  bool operator==(const HistoryRow&) const = default;
};
using HistoryRows = std::vector<HistoryRow>;
// Null: there is none.
[[nodiscard]] const HistoryRow* find_row(const HistoryRows& rows, std::uint64_t id);

// Belongs to the engine's thread.
class CaseHistory {
 public:
  static constexpr int kPicturePixels = 96;

  explicit CaseHistory(const WindowLevel& window) : window_(window) {}

  // The rows of the document's states, parents before their children.
  std::shared_ptr<const HistoryRows> rows(const document::Case& document);
  // Measures a state whose figures are missing, the youngest first. Returns false when there is none.
  bool measure_next(const document::Case& document);

 private:
  void follow(const document::History& history);

  WindowLevel window_;
  std::map<std::uint64_t, StateFigures> figures_;
  std::shared_ptr<const HistoryRows> rows_;
  std::uint64_t edits_ = 0;  // of the history, when the rows were made
};

}  // namespace tidemark::engine
