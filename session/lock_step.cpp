#include "session/lock_step.h"

#include <algorithm>
#include <limits>

#include "session/case_runner.h"

namespace tidemark {

void LockStep::add(const std::shared_ptr<CaseRunner>& runner) {
  members_.push_back(runner);
  runner->join(weak_from_this());
}

std::vector<std::shared_ptr<CaseRunner>> LockStep::members() {
  std::vector<std::shared_ptr<CaseRunner>> members;
  for (const auto& member : members_) {
    if (auto runner = member.lock(); runner && runner->opened()) members.push_back(std::move(runner));
  }
  return members;
}

Status LockStep::advance(CaseRunner& runner, const Progress& progress) {
  std::int64_t first = 0;
  std::int64_t last = std::numeric_limits<std::int64_t>::max();
  std::int64_t stride = std::numeric_limits<std::int64_t>::max();
  for (const auto& member : members()) {
    const std::int64_t step = member->document().level_set().step();
    first = std::max(first, step);
    last = std::min(last, step);
    stride = std::min(stride, member->steps_to_next_picture());
  }
  // Where all go: beyond the first once all are there.
  const std::int64_t goal = first == last ? first + stride : first;
  const std::int64_t steps = goal - runner.document().level_set().step();
  return steps > 0 ? runner.advance(steps, progress) : Status();
}

void LockStep::set_playing(bool playing) {
  for (const auto& member : members()) member->set_playing(playing);
}

}  // namespace tidemark
