// A level set on its ways through the history, and the history as values.
#include <map>
#include <utility>

#include "document/level_set.h"
#include "document/level_set_change.h"
#include "document/saved_history.h"

namespace tidemark::document {

Steering LevelSet::steering_of(const Recipe& recipe, const Drive& drive,
                               std::shared_ptr<const solver::Field> phi) {
  return {recipe.begun(), recipe.steps, recipe.final_parameters(), summary_of(drive), std::move(phi)};
}

std::shared_ptr<const Drive> LevelSet::unless_last(const Recipe& recipe,
                                                   const std::shared_ptr<const Drive>& drive) {
  return *drive == value_of(recipe.final_drive()) ? nullptr : drive;
}

// The drive of which that is what unless_last() has left.
std::shared_ptr<const Drive> LevelSet::drive_of(const Recipe& recipe,
                                                const std::shared_ptr<const Drive>& wanted_drive) {
  if (wanted_drive != nullptr) return wanted_drive;
  return std::make_shared<const Drive>(value_of(recipe.final_drive()));
}

// One of the points on a way through the history: the executor gets the last one only.
void LevelSet::pass(Point point) {
  settle_executor(point.recipe);
  point.recipe.source = recipe_.source;
  put_in_place(std::move(point));
  resumed_ = true;
  on_its_way_ = true;
}

Status LevelSet::arrive() {
  return std::exchange(on_its_way_, false) ? hand_over(known_) : Status();
}

SavedHistory LevelSet::saved_history() const {
  if (history_.open_state()) return {};
  SavedHistory saved;
  std::map<std::uint64_t, std::size_t> places;  // by number
  std::vector<std::shared_ptr<const LevelSetChange>> from_parents;
  for (const HistoryState& state : history_.states()) {
    const auto change = std::dynamic_pointer_cast<const LevelSetChange>(history_.change(state.id));
    if (state.parent && change == nullptr) {
      places[state.id] = places.at(*state.parent);  // of labels: the level set is as before it
      continue;
    }
    places[state.id] = saved.states.size();
    SavedState& last = saved.states.emplace_back();
    if (state.parent) last.parent = places.at(*state.parent);
    last.change = state.change;
    last.phi = state.steering.phi;
    from_parents.push_back(change);
  }
  saved.present = places.at(history_.last_state());
  for (const Visit& visit : outwards(saved)) {
    SavedState& state = saved.states[visit.state];
    const SavedState& near = saved.states[visit.from];
    if (visit.state == visit.from) {
      state.recipe = recipe_;
      state.wanted_drive = wanted_drive();
      state.curve = curve_;
    } else if (state.parent == visit.from) {
      const LevelSetChange& change = *from_parents[visit.state];
      state.recipe = change.recipe_after(near.recipe);
      state.wanted_drive = unless_last(state.recipe, change.drive_after());
      state.curve = change.curve_after();
    } else {
      const LevelSetChange& change = *from_parents[visit.from];
      state.recipe = change.recipe_before(near.recipe);
      state.wanted_drive = unless_last(state.recipe, change.drive_before());
      state.curve = change.curve_before();
    }
    state.curve.compare_with(answer_);
  }
  return saved;
}

// As resume_from() makes it.
LevelSet::Point LevelSet::point_of(const SavedHistory& history, std::size_t state) const {
  if (state == history.present) return known_;
  const SavedState& saved = history.states[state];
  Point point;
  point.recipe = saved.recipe;
  point.phi = saved.phi;
  if (saved.recipe.steps == 0) point.start = point.phi;
  point.curve = saved.curve;
  point.drive = drive_of(saved.recipe, saved.wanted_drive);
  return point;
}

void LevelSet::restore_history(const SavedHistory& history) {
  // From the present state outwards, as far as memory is meant for it.
  std::vector<std::shared_ptr<Change>> changes(history.states.size());
  std::vector<bool> kept(history.states.size(), false);
  std::int64_t bytes = 0;
  for (const Visit& visit : outwards(history)) {
    if (visit.state != visit.from) {
      const bool down = history.states[visit.state].parent == visit.from;
      const Point before = point_of(history, down ? visit.from : visit.state);
      const Point after = point_of(history, down ? visit.state : visit.from);
      settled_events_ = before.recipe.events.size();
      auto change = std::make_shared<LevelSetChange>(*this, before, after);
      bytes += change->bytes();
      if (bytes > History::kDefaultLimit) break;
      changes[down ? visit.state : visit.from] = std::move(change);
    }
    kept[visit.state] = true;
  }
  settled_events_ = recipe_.events.size();
  std::vector<HistoryState> states;
  std::vector<std::shared_ptr<Change>> from_parents;
  for (std::size_t i = 0; i < history.states.size(); ++i) {
    if (!kept[i]) continue;
    const SavedState& saved = history.states[i];
    HistoryState state{i, std::nullopt, saved.change, {}};
    if (saved.parent && kept[*saved.parent]) state.parent = *saved.parent;
    state.steering = steering_of(point_of(history, i));
    states.push_back(std::move(state));
    from_parents.push_back(std::move(changes[i]));
  }
  history_.restore(states, std::move(from_parents), history.present);
}

}  // namespace tidemark::document
