#include "document/saved_history.h"

#include <algorithm>
#include <utility>

namespace tidemark::document {
namespace {

constexpr std::int64_t kMostPhiBytes = std::int64_t{256} << 20;  // of phi in a file, before it is deflated

}  // namespace

std::vector<Visit> outwards(const SavedHistory& history) {
  if (history.empty()) return {};
  std::vector<std::vector<std::size_t>> neighbours(history.states.size());
  for (std::size_t i = 0; i < history.states.size(); ++i) {
    const auto& parent = history.states[i].parent;
    if (!parent) continue;
    neighbours[i].push_back(*parent);
    neighbours[*parent].push_back(i);
  }
  std::vector<bool> seen(history.states.size(), false);
  std::vector<Visit> visits{{history.present, history.present}};
  seen[history.present] = true;
  for (std::size_t next = 0; next < visits.size(); ++next) {
    const std::size_t here = visits[next].state;
    for (const std::size_t other : neighbours[here]) {
      if (seen[other]) continue;
      seen[other] = true;
      visits.push_back({other, here});
    }
  }
  return visits;
}

SavedHistory part_of(const SavedHistory& history, const std::vector<bool>& kept) {
  SavedHistory part;
  std::vector<std::size_t> places(history.states.size());
  for (std::size_t i = 0; i < history.states.size(); ++i) {
    if (!kept[i]) continue;
    places[i] = part.states.size();
    SavedState state = history.states[i];
    if (state.parent && kept[*state.parent]) {
      state.parent = places[*state.parent];
    } else {
      state.parent.reset();
    }
    part.states.push_back(std::move(state));
  }
  part.present = places[history.present];
  return part;
}

HistoryForFile for_file(const SavedHistory& history) {
  const solver::Field& present = *history.states[history.present].phi;
  std::vector<bool> kept(history.states.size(), false);
  SavedHistory whole = history;
  std::size_t events = 0;
  HistoryForFile file;
  std::vector<std::size_t> numbers(history.states.size());
  for (const Visit& visit : outwards(history)) {
    SavedState& state = whole.states[visit.state];
    if (!kept[visit.from] && visit.state != visit.from) continue;
    events += state.recipe.events.size();
    if (events > SavedHistory::kMostEvents || file.phi.fields() == SavedHistory::kMostStates ||
        file.phi.bytes() > kMostPhiBytes)
      break;
    if (state.phi->band != present.band) continue;
    if (!(state.phi->layout == present.layout))
      state.phi = std::make_shared<const solver::Field>(
          state.phi->repaged(present.band, present.layout.page_shape()));
    numbers[visit.state] = file.phi.fields();
    file.phi.add(*state.phi);
    kept[visit.state] = true;
  }
  file.history = part_of(whole, kept);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    if (kept[i]) file.phi_of.push_back(numbers[i]);
  }
  return file;
}

}  // namespace tidemark::document
