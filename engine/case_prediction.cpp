#include "engine/case_prediction.h"

#include <utility>

namespace tidemark::engine {
namespace {

constexpr int kPredictionRest = 9;  // times as long as a prediction takes: while something is dragged

}  // namespace

CasePrediction::CasePrediction(QObject* parent)
    : QObject(parent),
      question_(
          this, &CasePrediction::compute, [this] { emit answered(); }, kPredictionRest) {}

// Steps alone change phi and step; the first point of a long curve may be left out of it.
bool CasePrediction::still_holds(const Base& now) const {
  if (!base_ || now.step < base_->step) return false;
  if (now.first.step == base_->first.step && !(now.first == base_->first)) return false;
  Base same = now;
  if (now.step > base_->step) same.inputs.phi = base_->inputs.phi;
  same.inputs.moving_pages = base_->inputs.moving_pages;
  same.step = base_->step;
  same.first = base_->first;
  return same == *base_;
}

void CasePrediction::follow(const CaseState& state) {
  auto inputs = step_inputs(state);
  const document::Curve::Points& curve = *state.curve.points();
  if (!inputs || curve.empty()) return forget();
  // phi is that of the newest point.
  if (curve.back().step < state.steered_at) return;
  const Base now{*inputs, curve.back().step, state.steered_at, state.steered, curve.front()};
  if (still_holds(now)) return;
  base_ = now;
  question_.ask(now);
}

void CasePrediction::forget() {
  base_.reset();
  question_.forget();
}

const document::Prediction* CasePrediction::prediction() const {
  if (!base_ || !question_.answer() || !(question_.answer()->question == *base_)) return nullptr;
  const Answer& answer = question_.answer()->answer;
  return answer ? &*answer : nullptr;
}

CasePrediction::Answer CasePrediction::compute(const Base& base, const std::stop_token& stop) {
  auto predicted = document::predict(base.inputs, base.step, {nullptr, stop});
  if (!predicted) return std::nullopt;
  return std::move(*predicted);
}

}  // namespace tidemark::engine
