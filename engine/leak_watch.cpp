#include "engine/leak_watch.h"

#include <algorithm>
#include <utility>

namespace tidemark::engine {
namespace {

constexpr int kShare = 10;  // one part in so many of the time may be spent on looking

}  // namespace

void LeakWatch::set_rule(const std::optional<document::LeakRule>& rule) {
  if (rule_ == rule) return;
  if (!rule_) started_ = false;
  if (!rule) patches_.reset();
  rule_ = rule;
}

bool LeakWatch::affordable() {
  const auto now = Clock::now();
  credit_ = std::min<Clock::duration>(kMostCredit, credit_ + (now - counted_) / kShare);
  counted_ = now;
  return credit_ >= Clock::duration::zero();
}

template <class Work>
Status LeakWatch::spend_on(const Work& work) {
  const auto began = Clock::now();
  Status status = work();
  credit_ -= Clock::now() - began;
  return status;
}

Result<std::int64_t> LeakWatch::begin(const document::LevelSet& level_set, std::int64_t steps) {
  if (!rule_ || !affordable()) return steps;
  if (!started_ || !patches_) {
    TIDEMARK_TRY(spend_on([&] {
      if (!patches_) patches_.emplace(level_set.source()->geometry);
      return patches_->restart(level_set.executor());
    }));
    steps_of_looks_.assign(1, level_set.step());
    started_ = true;
  }
  return std::min(steps, kSteps);
}

Status LeakWatch::look(const document::LevelSet& level_set) {
  if (!rule_ || !started_ || !affordable()) return {};
  std::shared_ptr<const LeakAlarm> alarm;
  TIDEMARK_TRY(spend_on([&]() -> Status {
    auto arrived = patches_->look(level_set.executor());
    if (!arrived) return pass_on(arrived);
    steps_of_looks_.resize(static_cast<std::size_t>(patches_->looks()) + 1);
    steps_of_looks_.back() = level_set.step();
    if (*arrived == 0) return {};
    auto leak = finder_.find(*patches_, *rule_);
    if (!leak) return {};
    const auto before = static_cast<std::size_t>(std::max(leak->passed - 1, 0));
    alarm = std::make_shared<const LeakAlarm>(
        LeakAlarm{std::move(*leak), level_set.step(), steps_of_looks_[before]});
    return {};
  }));
  if (!alarm) return {};
  started_ = false;
  alarm_ = std::move(alarm);
  return {};
}

Result<solver::AdvanceReport> LeakWatch::advance(document::LevelSet& level_set, const solver::Advance& run) {
  forget_alarm();
  solver::AdvanceReport all;
  while (all.steps < run.steps && !alarm_) {
    auto steps = begin(level_set, run.steps - all.steps);
    if (!steps) return pass_on(steps);
    auto part = level_set.advance({*steps, run.until_converged, run.progress});
    if (!part) return part;
    all.steps += part->steps;
    all.seconds += part->seconds;
    all.paging_seconds += part->paging_seconds;
    all.voxel_updates += part->voxel_updates;
    all.surface_speed = part->surface_speed;
    all.moving_pages = part->moving_pages;
    all.converged = part->converged;
    if (part->steps < *steps || (part->converged && run.until_converged)) break;
    TIDEMARK_TRY(look(level_set));
  }
  return all;
}

}  // namespace tidemark::engine
