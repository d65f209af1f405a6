#include "engine/leak_watch.h"

#include <algorithm>
#include <utility>

namespace tidemark::engine {
namespace {

constexpr int kShare = 10;                         // one part in so many of the time may be spent on looking
constexpr std::chrono::milliseconds kAdvance{20};  // of time, for the first looks of a run

}  // namespace

void LeakWatch::set_rule(const std::optional<document::LeakRule>& rule) {
  if (rule_ == rule) return;
  if (!rule_ || !rule) restart();
  rule_ = rule;
}

bool LeakWatch::affordable() const {
  return spent_ * kShare <= Clock::now() - begun_ + kAdvance * kShare;
}

Result<std::int64_t> LeakWatch::begin(const document::LevelSet& level_set, std::int64_t steps) {
  if (!rule_) return steps;
  if (!patches_) {
    patches_.emplace(level_set.source()->geometry);
    TIDEMARK_TRY(patches_->restart(level_set.executor()));
    steps_of_looks_.assign(1, level_set.step());
    begun_ = Clock::now();
    spent_ = {};
  }
  return affordable() ? std::min(steps, kSteps) : steps;
}

Result<std::optional<LeakAlarm>> LeakWatch::look(const document::LevelSet& level_set) {
  if (!rule_ || !patches_ || !affordable()) return std::optional<LeakAlarm>();
  const auto began = Clock::now();
  auto arrived = patches_->look(level_set.executor());
  if (!arrived) return pass_on(arrived);
  steps_of_looks_.resize(static_cast<std::size_t>(patches_->looks()) + 1, level_set.step());
  steps_of_looks_.back() = level_set.step();
  std::optional<LeakAlarm> alarm;
  if (*arrived > 0) {
    if (auto leak = finder_.find(*patches_, *rule_)) {
      const auto before = static_cast<std::size_t>(std::max(leak->passed - 1, 0));
      alarm = LeakAlarm{std::move(*leak), level_set.step(), steps_of_looks_[before]};
    }
  }
  spent_ += Clock::now() - began;
  if (alarm) restart();
  return alarm;
}

}  // namespace tidemark::engine
