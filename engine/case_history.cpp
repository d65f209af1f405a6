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

solver::Field CaseHistory::phi_of(std::uint64_t state, const document::Case& document) const {
  const document::History& history = document.history();
  if (last_ && history.has(last_->state) &&
      history.distance(last_->state, state) < history.distance(history.last_state(), state))
    return history.phi_at(state, last_->state, last_->phi);
  return document.level_set().phi_at(state);
}

bool CaseHistory::measure_next(const document::Case& document) {
  const auto known = rows(document);
  const auto row = std::find_if(known->rbegin(), known->rend(), lacks_figures);
  if (row == known->rend()) {
    last_.reset();
    return false;
  }
  const std::uint64_t state = row->state.id;
  last_ = Measured{state, phi_of(state, document)};
  figures_[state] = {solver::measure(last_->phi).volume_ml,
                     picture_of_state(*document.volume(), last_->phi, window_, kPicturePixels)};
  follow(document.history());
  return true;
}

}  // namespace tidemark::engine
