// What is measured on a case while it runs.
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <optional>

#include "session/case_state.h"
#include "study/case.h"

namespace tidemark {

class CaseMeter {
 public:
  // After a run of steps.
  void computed(const AdvanceReport& report, std::int64_t step);
  // After a change of phi that is not a step: curves end at `step`, and nothing has converged.
  void edited(std::int64_t step);
  // Something else has changed that figures depend on.
  void adjusted() {
    converged_ = false;
    thorough_ = false;
  }

  [[nodiscard]] double seconds_per_step() const { return seconds_per_step_; }
  [[nodiscard]] bool converged() const { return converged_; }

  // Whether figures of the surface are due: at most five times a second, and once a second where phi has to
  // be read from a GPU.
  [[nodiscard]] bool due(bool on_gpu) const;
  // Takes those of this phi. `thoroughly`: also what is under the surface and the labels.
  void measure(const std::shared_ptr<const Field>& phi, std::int64_t step, Case& document, bool thoroughly);
  [[nodiscard]] bool thorough() const { return thorough_; }

  // Fills in what was measured.
  void report(CaseState& state) const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Lap {
    Clock::time_point at;
    std::int64_t step;
  };

  std::deque<Lap> laps_;  // of the last second
  double seconds_per_step_ = 0.0;
  double surface_speed_ = 0.0;
  bool converged_ = false;
  Clock::time_point measured_at_;
  bool thorough_ = false;
  std::shared_ptr<const Field> phi_;
  SurfaceStatistics surface_;
  RegionStatistics inside_;
  std::vector<RegionStatistics> labels_;
  // States share it: it is made anew when a point is added, which is seldom, and not for each of them.
  std::shared_ptr<const Curve> curve_ = std::make_shared<const Curve>();
};

}  // namespace tidemark
