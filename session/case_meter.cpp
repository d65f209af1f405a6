#include "session/case_meter.h"

#include <algorithm>

namespace tidemark {
namespace {

constexpr std::size_t kCurvePoints = 2000;
constexpr auto kLapWindow = std::chrono::seconds(1);
constexpr double kSmoothing = 0.3;  // weight of the newest run in the mean time of a step

// Every other point, the newest included.
void thin(Curve& curve) {
  std::size_t kept = 0;
  for (std::size_t index = curve.size() % 2 == 0 ? 1 : 0; index < curve.size(); index += 2) {
    curve[kept++] = curve[index];
  }
  curve.resize(kept);
}

std::shared_ptr<const Curve> with_point(const Curve& curve, const CurvePoint& point) {
  auto longer = std::make_shared<Curve>(curve);
  longer->push_back(point);
  if (longer->size() > kCurvePoints) thin(*longer);
  return longer;
}

// The points before `step`.
std::shared_ptr<const Curve> before(const Curve& curve, std::int64_t step) {
  const auto end =
      std::find_if(curve.begin(), curve.end(), [=](const CurvePoint& point) { return point.step >= step; });
  return std::make_shared<const Curve>(curve.begin(), end);
}

}  // namespace

void CaseMeter::computed(const AdvanceReport& report, std::int64_t step) {
  thorough_ = false;
  if (report.steps == 0) return;
  const double seconds = report.seconds / static_cast<double>(report.steps);
  seconds_per_step_ =
      seconds_per_step_ == 0.0 ? seconds : (1.0 - kSmoothing) * seconds_per_step_ + kSmoothing * seconds;
  surface_speed_ = report.surface_speed;
  converged_ = report.converged;
  laps_.push_back({Clock::now(), step});
  while (laps_.size() > 2 && laps_.back().at - laps_.front().at > kLapWindow) laps_.pop_front();
}

void CaseMeter::edited(std::int64_t step) {
  laps_.clear();
  converged_ = false;
  thorough_ = false;
  if (!curve_->empty() && curve_->back().step >= step) curve_ = before(*curve_, step);
}

bool CaseMeter::due(bool on_gpu) const {
  return Clock::now() - measured_at_ >=
         (on_gpu ? std::chrono::milliseconds(1000) : std::chrono::milliseconds(200));
}

void CaseMeter::measure(const std::shared_ptr<const Field>& phi, std::int64_t step, Case& document,
                        bool thoroughly) {
  phi_ = phi;
  surface_ = tidemark::measure(*phi);
  if (curve_->empty() || curve_->back().step < step) {
    curve_ = with_point(*curve_, {step, surface_.volume_ml, surface_.surface_mm2, surface_speed_});
  }
  if (thoroughly) {
    inside_ = statistics_in(*document.volume(), phi->mask());
    const auto all = statistics_by_label(*document.volume(), document.labels());
    labels_.clear();
    for (const Label& label : document.labels().list()) labels_.push_back(all[label.id]);
  }
  thorough_ = thoroughly;
  measured_at_ = Clock::now();
}

void CaseMeter::report(CaseState& state) const {
  state.converged = converged_;
  state.phi = phi_;
  state.surface = surface_;
  state.inside = inside_;
  state.label_statistics = labels_;
  state.label_statistics.resize(state.labels.size());
  state.curve = curve_;
  state.solver_steps_per_second = seconds_per_step_ > 0.0 ? 1.0 / seconds_per_step_ : 0.0;
  state.steps_per_second = 0.0;
  if (state.playing && laps_.size() > 1) {
    const std::chrono::duration<double> time = laps_.back().at - laps_.front().at;
    if (time.count() > 0.0) {
      state.steps_per_second = static_cast<double>(laps_.back().step - laps_.front().step) / time.count();
    }
  }
}

}  // namespace tidemark
