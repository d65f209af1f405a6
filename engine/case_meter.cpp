#include "engine/case_meter.h"

#include <algorithm>

namespace tidemark::engine {
namespace {

constexpr auto kLapWindow = std::chrono::seconds(1);
// Between two measurements, in terms of the last one's time.
constexpr int kMeterRest = 20;
constexpr auto kShortestRest = std::chrono::milliseconds(50);
constexpr auto kLongestRest = std::chrono::seconds(1);
constexpr double kSmoothing = 0.3;  // weight of the newest run in the mean time of a step

}  // namespace

void CaseMeter::computed(const solver::AdvanceReport& report, std::int64_t step) {
  thorough_ = false;
  if (report.steps == 0) return;
  const double seconds = report.seconds / static_cast<double>(report.steps);
  seconds_per_step_ =
      seconds_per_step_ == 0.0 ? seconds : (1.0 - kSmoothing) * seconds_per_step_ + kSmoothing * seconds;
  surface_speed_ = report.surface_speed;
  converged_ = report.converged;
  wider_range_.reset();
  laps_.push_back({Clock::now(), step});
  while (laps_.size() > 2 && laps_.back().at - laps_.front().at > kLapWindow) laps_.pop_front();
}

void CaseMeter::edited() {
  laps_.clear();
  adjusted();
}

void CaseMeter::adjusted() {
  converged_ = false;
  outcome_ = document::Outcome::unfinished;
  wider_range_.reset();
  thorough_ = false;
}

Status CaseMeter::measure(const ReadPhi& read_phi, document::Case& document, bool thoroughly) {
  const auto began = Clock::now();
  const auto phi = read_phi();
  if (!phi) return pass_on(phi);
  auto moving = document.level_set().executor().moving_pages();
  if (!moving) return pass_on(moving);
  phi_ = *phi;
  moving_pages_ = std::make_shared<const std::vector<std::int64_t>>(std::move(*moving));
  surface_ = surface_meter_.measure(*phi_);
  if (overlap_) dice_ = overlap_->dice(*phi_);
  const auto ended = Clock::now();
  due_at_ = ended + std::clamp<Clock::duration>(kMeterRest * (ended - began), kShortestRest, kLongestRest);
  // A case that was read from a file has not moved since its last point.
  document::LevelSet& level_set = document.level_set();
  const document::Curve::Points& before = *level_set.curve().points();
  const double last_speed = before.empty() ? 0.0 : before.back().surface_speed;
  level_set.note({level_set.step(), surface_.volume_ml, surface_.surface_mm2,
                  surface_speed_.value_or(last_speed), dice_});
  const document::EvolvedSurface evolved{*phi_,
                                         surface_.voxels_inside,
                                         level_set.step(),
                                         converged_,
                                         level_set.start().get(),
                                         *level_set.source(),
                                         level_set.parameters(),
                                         level_set.executor().speed().get(),
                                         level_set.executor().constraints().get()};
  outcome_ = document::outcome_of(evolved);
  if (thoroughly) {
    wider_range_ = wider_range(evolved);
    inside_ = inside_meter_.measure(document.volume(), *phi_);
  }
  thorough_ = thoroughly;
  return {};
}

void CaseMeter::follow_labels(const document::Case& document) {
  const document::Labels& labels = document.labels();
  if (label_revision_ == labels.revision()) return;
  labels_ = label_meter_.measure(document.volume(), labels.voxels());
  label_revision_ = labels.revision();
}

void CaseMeter::report(CaseState& state) const {
  state.converged = converged_;
  state.outcome = outcome_;
  state.wider_range = wider_range_;
  state.phi = phi_;
  state.moving_pages = moving_pages_;
  state.surface = surface_;
  state.dice = dice_;
  state.inside = inside_;
  for (const document::Label& label : state.labels) state.label_statistics.push_back(labels_[label.id]);
  state.solver_steps_per_second = seconds_per_step_ > 0.0 ? 1.0 / seconds_per_step_ : 0.0;
  state.steps_per_second = 0.0;
  if (state.playing && laps_.size() > 1) {
    const std::chrono::duration<double> time = laps_.back().at - laps_.front().at;
    if (time.count() > 0.0) {
      state.steps_per_second = static_cast<double>(laps_.back().step - laps_.front().step) / time.count();
    }
  }
}

}  // namespace tidemark::engine
