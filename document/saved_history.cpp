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
  part.phi = history.phi;
  std::vector<std::size_t> places(history.states.size());
  for (std::size_t i = 0; i < history.states.size(); ++i) {
    if (!kept[i]) continue;
    places[i] = part.states.size();
    SavedState state = history.states[i];
    if (state.parent && kept[*state.parent]) {
      state.parent = places[*state.parent];
    } else {
      state.parent.reset();
      state.from_parent.reset();
    }
    part.states.push_back(std::move(state));
  }
  part.present = places[history.present];
  return part;
}

SavedHistory for_file(const SavedHistory& history, const solver::Field& present) {
  SavedHistory whole = history;
  whole.phi = SharedPages(present.geometry, present.band, present.layout.page_shape());
  std::vector<bool> kept(history.states.size(), false);
  std::size_t events = 0;
  for (const Visit& visit : outwards(history)) {
    SavedState& state = whole.states[visit.state];
    if (visit.state != visit.from && !kept[visit.from]) continue;
    events += state.recipe.events.size();
    if (events > SavedHistory::kMostEvents || whole.phi.size() == SavedHistory::kMostStates ||
        whole.phi.bytes() > kMostPhiBytes)
      break;
    state.phi = whole.phi.size();
    if (visit.state == visit.from) {
      whole.phi.add(present, 0);
    } else {
      const std::size_t near = whole.states[visit.from].phi;
      solver::Field phi = whole.phi.field(near);
      phi = state.parent == visit.from ? state.from_parent->after(std::move(phi))
                                       : whole.states[visit.from].from_parent->before(std::move(phi));
      if (phi.band != present.band) continue;
      whole.phi.add(phi, near);
    }
    kept[visit.state] = true;
  }
  return part_of(whole, kept);
}

}  // namespace tidemark::document
