#include "engine/case_history.h"

#include <algorithm>

#include "engine/state_picture.h"
#include "solver/statistics.h"

namespace tidemark::engine {
namespace {

bool lacks_figures(const HistoryRow& row) {
  return row.state.steering.begun && !row.figures;
}

}  // namespace

const HistoryRow* find_row(const HistoryRows& rows, std::uint64_t id) {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [id](const HistoryRow& one) { return one.state.id == id; });
  return row == rows.end() ? nullptr : &*row;
}

void CaseHistory::follow(const document::History& history) {
  std::erase_if(figures_, [&](const auto& known) { return !history.has(known.first); });
  auto rows = std::make_shared<HistoryRows>();
  for (document::HistoryState& state : history.states()) {
    const auto known = figures_.find(state.id);
    rows->push_back(
        {std::move(state), known == figures_.end() ? std::nullopt : std::optional(known->second)});
  }
  rows_ = std::move(rows);
  edits_ = history.edits();
}

std::shared_ptr<const HistoryRows> CaseHistory::rows(const document::Case& document) {
  if (!rows_ || edits_ != document.history().edits()) follow(document.history());
  return rows_;
}

bool CaseHistory::measure_next(const document::Case& document) {
  const auto known = rows(document);
  const auto row = std::find_if(known->rbegin(), known->rend(), lacks_figures);
  if (row == known->rend()) return false;
  const solver::Field& phi = *row->state.steering.phi;
  figures_[row->state.id] = {solver::measure(phi).volume_ml,
                             picture_of_state(*document.volume(), phi, window_, kPicturePixels)};
  follow(document.history());
  return true;
}

}  // namespace tidemark::engine
