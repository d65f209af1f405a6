#include "engine/lock_step.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "engine/case_runner.h"

namespace tidemark::engine {
namespace {

std::int64_t step_of(CaseRunner& runner) {
  return runner.document().level_set().step();
}

// The steps of the last and of the first.
std::pair<std::int64_t, std::int64_t> ends_of(const std::vector<std::shared_ptr<CaseRunner>>& all) {
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t first = 0;
  for (const auto& member : all) {
    last = std::min(last, step_of(*member));
    first = std::max(first, step_of(*member));
  }
  return {last, first};
}

}  // namespace

void LockStep::add(const std::shared_ptr<CaseRunner>& runner) {
  if (const Members others = members(); !others.empty()) runner->set_pace_alone(others.front()->pace());
  runner->join(weak_from_this());
  members_.push_back(runner);
}

void LockStep::remove(const CaseRunner& runner) {
  std::erase_if(members_, [&](const auto& member) { return member.lock().get() == &runner; });
}

LockStep::Members LockStep::members() {
  Members members;
  for (const auto& member : members_) {
    if (auto runner = member.lock(); runner && runner->opened()) members.push_back(std::move(runner));
  }
  return members;
}

// One without a surface, or that a fault has stopped, is not waited for.
LockStep::Members LockStep::players() {
  Members players = members();
  std::erase_if(players, [](const auto& member) { return !member->playing(); });
  return players;
}

Status LockStep::advance(CaseRunner& runner, const Progress& progress) {
  const Members moving = players();
  const auto [last, first] = ends_of(moving);
  // Where all go: beyond the first once all are there.
  std::int64_t goal = first;
  if (first == last) {
    if (std::all_of(moving.begin(), moving.end(), [](const auto& member) { return member->may_rest(); })) {
      set_playing(false);
      return {};
    }
    leap_ = std::numeric_limits<std::int64_t>::max();
    for (const auto& member : moving) leap_ = std::min(leap_, member->steps_to_next_picture());
    goal = first + leap_;
  }
  const std::int64_t steps = goal - step_of(runner);
  return steps > 0 ? runner.advance(steps, progress) : Status();
}

void LockStep::set_playing(bool playing) {
  if (!playing) complete_leap();
  for (const auto& member : members()) {
    member->play_alone(playing);
    member->show();
  }
}

void LockStep::set_pace(double steps_per_second) {
  for (const auto& member : members()) {
    member->set_pace_alone(steps_per_second);
    member->show();
  }
}

bool LockStep::any_holds_steps() {
  const Members all = members();
  return std::any_of(all.begin(), all.end(), [](const auto& member) {
    return member->document().level_set().begun() && member->holds_steps();
  });
}

// All wait for one whose speed function is being made: the former one would move it.
Status LockStep::step(std::int64_t steps, const Progress& progress) {
  set_playing(false);
  if (any_holds_steps()) return {};
  for (const auto& member : members()) {
    if (!member->document().level_set().begun()) continue;
    TIDEMARK_TRY(member->advance(steps, progress));
    member->show();
  }
  return {};
}

// One that has joined far behind the others stays there until they play again.
void LockStep::complete_leap() {
  const Members moving = players();
  const std::int64_t first = ends_of(moving).second;
  for (const auto& member : moving) {
    const std::int64_t steps = first - step_of(*member);
    if (steps == 0 || steps > leap_ || member->holds_steps()) continue;
    if (auto status = member->advance(steps, {}); !status) member->report_failure(status.error());
  }
}

}  // namespace tidemark::engine
