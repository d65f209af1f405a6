#include "engine/case_speed.h"

#include <string>

namespace tidemark::engine {
namespace {

std::vector<std::string> functions_of(const SpeedOrigin& origin) {
  std::vector<std::string> names;
  for (const solver::SpeedTerm& term : origin.setting.terms) names.push_back(term.function);
  return names;
}

}  // namespace

void CaseSpeed::follow(const document::Case& document, const SpeedMaker::Report& report,
                       const Deliver& deliver) {
  const document::LevelSet& level_set = document.level_set();
  if (smoothing_ == level_set.smoothed_mm()) smoothing_.reset();
  const SpeedOrigin wanted =
      speed_origin(level_set.drive(), document.volume(), smoothing_.value_or(level_set.smoothed_mm()));
  const bool is_tent = wanted.setting.is_tent();
  const bool is_there = is_tent || (wanted == made_ && level_set.executor().speed() != nullptr);
  if (is_there && !smoothing_) {
    if (waits_) maker_.give_up();
    wish_.reset();
    waits_ = false;
    if (is_tent) made_ = {};
    return;
  }
  if (wish_ == wanted && (waits_ || level_set.parameters().data_form == refused_form_)) return;
  maker_.make(wanted, smoothing_ ? nullptr : level_set.source(), report,
              [deliver, wanted](SpeedMaker::Made made) { deliver(wanted, std::move(made)); });
  wish_ = wanted;
  waits_ = true;
}

Result<bool> CaseSpeed::take(document::Case& document, const SpeedOrigin& origin,
                             const SpeedMaker::Made& made) {
  if (wish_ != origin) return false;
  waits_ = false;
  const bool smooths = smoothing_.has_value();
  smoothing_.reset();
  document::LevelSet& level_set = document.level_set();
  refused_form_ = level_set.parameters().data_form;
  if (!made) return pass_on(made);
  TIDEMARK_TRY(smooths ? level_set.set_source(made->source, origin.smoothed_mm, made->speed)
                       : level_set.set_speed(made->speed));
  made_ = origin;
  wish_.reset();
  return true;
}

bool CaseSpeed::holds_steps(const document::Case& document) const {
  if (!wish_) return false;
  if (document.level_set().lacks_speed()) return true;
  return !wish_->setting.is_tent() && functions_of(*wish_) != functions_of(made_);
}

void CaseSpeed::try_again() {
  if (!waits_) wish_.reset();
}

}  // namespace tidemark::engine
