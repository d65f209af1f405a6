// The commands of a case by which its surface moves.
#include <utility>

#include "engine/case_proxy.h"
#include "engine/case_runner.h"
#include "engine/last_call.h"
#include "engine/lock_step.h"

namespace tidemark::engine {

void CaseProxy::play() {
  set_playing(true);
}
void CaseProxy::pause() {
  set_playing(false);
}

void CaseProxy::set_playing(bool playing) {
  post([playing](CaseRunner& runner, const Progress&) -> Status {
    runner.set_playing(playing);
    return {};
  });
}

void CaseProxy::play_for(std::int64_t steps, bool until_rest, std::function<void(bool reached)> ended) {
  leave_lock_step();
  const auto unplayed = std::make_shared<LastCall>(weak_receiver_, [ended] { ended(false); });
  post(
      [steps, until_rest, ended = std::move(ended), unplayed](CaseRunner& runner, const Progress&) -> Status {
        unplayed->forget();
        runner.play({steps, until_rest, ended});
        return {};
      });
}

void CaseProxy::measure(std::function<void()> answer) {
  post([](CaseRunner& runner, const Progress&) { return runner.measure_now(); });
  after_commands(std::move(answer));
}

void CaseProxy::step(std::int64_t steps) {
  post([steps](CaseRunner& runner, const Progress& progress) { return runner.step(steps, progress); });
}

void CaseProxy::step_back(std::int64_t steps) {
  post([steps](CaseRunner& runner, const Progress& progress) {
    runner.set_playing(false);
    return runner.report_edit(runner.document().level_set().step_back(steps, progress));
  });
}

void CaseProxy::restart() {
  post([](CaseRunner& runner, const Progress&) {
    runner.set_playing(false);
    return runner.report_edit(runner.document().level_set().restart());
  });
}

void CaseProxy::set_steps_per_picture(std::int64_t steps) {
  steps_per_picture_ = steps;
  post([steps](CaseRunner& runner, const Progress&) -> Status {
    runner.set_steps_per_picture(steps);
    return {};
  });
}

void CaseProxy::set_pace(double steps_per_second) {
  post([steps_per_second](CaseRunner& runner, const Progress&) -> Status {
    runner.set_pace(steps_per_second);
    return {};
  });
}

void CaseProxy::set_pause_at_convergence(bool pause) {
  pause_at_convergence_ = pause;
  post([pause](CaseRunner& runner, const Progress&) -> Status {
    runner.set_pause_at_convergence(pause);
    return {};
  });
}

void CaseProxy::set_leak_rule(const std::optional<document::LeakRule>& rule) {
  leak_rule_ = rule;
  post([rule](CaseRunner& runner, const Progress&) -> Status {
    runner.set_leak_rule(rule);
    return {};
  });
}

void CaseProxy::play_in_lock_step(const std::vector<CaseProxy*>& proxies) {
  const auto group = proxies.empty() ? nullptr : std::make_shared<LockStep>();
  for (CaseProxy* proxy : proxies) {
    proxy->lock_step_ = group;
    proxy->post([group](CaseRunner& runner, const Progress&) -> Status {
      runner.set_playing(false);
      group->add(runner.shared_from_this());
      return {};
    });
  }
}

void CaseProxy::leave_lock_step() {
  lock_step_.reset();
  post([](CaseRunner& runner, const Progress&) -> Status {
    runner.join({});
    return {};
  });
}

}  // namespace tidemark::engine
