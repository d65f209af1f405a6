// Steps of a case under a watch for leaks.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "document/leak.h"
#include "document/level_set.h"
#include "engine/case_state.h"

namespace tidemark::engine {

// Looks at the surface every kSteps steps, or as often as a tenth of the time allows.
class LeakWatch {
 public:
  static constexpr std::int64_t kSteps = 8;

  // Unset: it looks no more.
  void set_rule(const std::optional<document::LeakRule>& rule);
  // What is inside now is the body from which a leak can come: after a change of phi that is not a step, and
  // when the user goes on after an alarm.
  void restart() {
    started_ = false;
    alarm_ = nullptr;
  }

  // Computes steps, in parts with looks between them, until there is a leak. Fails as
  // document::LevelSet::advance() and solver::Executor::snapshot() do.
  Result<solver::AdvanceReport> advance(document::LevelSet& level_set, const solver::Advance& run);
  // The leak at which the last steps have ended; null: none.
  [[nodiscard]] const std::shared_ptr<const LeakAlarm>& alarm() const { return alarm_; }
  void forget_alarm() { alarm_ = nullptr; }

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kMostCredit{50};

  // Before steps: of so many, how many come before the next look.
  Result<std::int64_t> begin(const document::LevelSet& level_set, std::int64_t steps);
  // After them. An alarm is raised once; then it starts anew.
  Status look(const document::LevelSet& level_set);
  bool affordable();
  template <class Work>
  Status spend_on(const Work& work);

  std::optional<document::LeakRule> rule_ = document::LeakRule{};
  std::optional<solver::FrontPatches> patches_;
  bool started_ = false;  // the first look was taken
  document::LeakFinder finder_;
  std::shared_ptr<const LeakAlarm> alarm_;
  std::vector<std::int64_t> steps_of_looks_;
  // The time that may be spent on looking: it grows with time, and looking takes from it.
  Clock::duration credit_ = kMostCredit;
  Clock::time_point counted_ = Clock::now();
};

}  // namespace tidemark::engine
