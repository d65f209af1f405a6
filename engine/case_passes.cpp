#include "engine/case_passes.h"

#include <glm/common.hpp>
#include <utility>

#include "engine/case_proxy.h"

namespace tidemark::engine {

CasePasses::CasePasses(CaseProxy& proxy)
    : QObject(nullptr),
      proxy_(proxy),
      fastest_(
          this,
          [](const solver::StepInputs& inputs, const std::stop_token& stop) {
            return solver::fastest_place(inputs, stop);
          },
          [this] { look(); }) {
  pause_.setSingleShot(true);
  pause_.setInterval(kPauseMs);
  connect(&pause_, &QTimer::timeout, this, &CasePasses::look);
  connect(&proxy, &CaseProxy::state_changed, this, &CasePasses::look);
  connect(&proxy.display(), &Display::changed, this, &CasePasses::look);
}

bool CasePasses::available() const {
  return proxy_.state().executor == QLatin1String("stream");
}

void CasePasses::set_follow(Follow follow) {
  if (follow_ == follow) return;
  follow_ = follow;
  fastest_.forget();
  look();
  emit changed();
}

void CasePasses::set_watched(bool watched) {
  watched_ = watched;
  if (!watched) fastest_.forget();
  look();
}

void CasePasses::forget() {
  asked_.reset();
  const bool had = recorded_ != nullptr || !problem_.empty();
  recorded_.reset();
  problem_.clear();
  if (had) emit changed();
}

std::optional<glm::dvec3> CasePasses::place() {
  if (follow_ == Follow::motion) {
    const auto inputs = step_inputs(proxy_.state());
    if (!inputs) return std::nullopt;
    fastest_.ask(*inputs);
    return fastest_.answer() ? fastest_.answer()->answer : std::nullopt;
  }
  const auto& cursor = proxy_.display().settings().cursor_mm;
  return proxy_.volume().geometry.to_voxel(cursor);
}

std::optional<CasePasses::Question> CasePasses::question() {
  const CaseState& state = proxy_.state();
  const auto found = place();
  if (!found || state.speed_waits || state.lacks_speed) return std::nullopt;
  const Index3 size = proxy_.volume().geometry.size;
  const Index3 voxel(glm::clamp(glm::round(*found), glm::dvec3(0.0), glm::dvec3(size - Index3(1))));
  const PageLayout layout(size, state.memory.page_shape);
  return Question{layout.translate(voxel).page,
                  state.step,
                  state.edits,
                  state.history_state,
                  state.parameters,
                  state.phi,
                  state.speed,
                  state.constraints,
                  state.source};
}

void CasePasses::look() {
  if (!watched_) return;
  if (!proxy_.state().begun || !available()) return forget();
  auto wanted = question();
  if (!wanted || waits_ || pause_.isActive() || asked_ == wanted) return;
  asked_ = std::move(wanted);
  waits_ = true;
  pause_.start();
  proxy_.record_step(asked_->page, [this](const Result<RecordedStep>& answer) { take(answer); });
}

void CasePasses::take(const Result<RecordedStep>& answer) {
  waits_ = false;
  if (!asked_) return look();  // it was forgotten meanwhile
  recorded_ = answer ? std::make_shared<const RecordedStep>(*answer) : nullptr;
  const bool has_reason = !answer && answer.error().kind != ErrorKind::cancelled;
  problem_ = has_reason ? answer.error().message : std::string();
  emit changed();
  look();
}

}  // namespace tidemark::engine
