// What is measured on a case while it runs.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "document/case.h"
#include "engine/case_state.h"

namespace tidemark {

class CaseMeter {
 public:
  // After a run of steps.
  void computed(const AdvanceReport& report, std::int64_t step);
  // After a change of phi that is not a step: nothing has converged.
  void edited();
  // Something else has changed that figures depend on.
  void adjusted();
  void labels_changed() { thorough_ = false; }

  [[nodiscard]] double seconds_per_step() const { return seconds_per_step_; }
  [[nodiscard]] bool converged() const { return converged_; }

  // Whether figures of the surface are due: as often as a tenth of the time allows, but at most twenty
  // times a second and at least once.
  [[nodiscard]] bool due() const { return Clock::now() >= due_at_; }
  // Takes those of the phi that `read_phi` gives, which takes time where it is on a GPU, and notes them on
  // the level set's curve. `thoroughly`: also what is under the surface and the labels, and beside it.
  using ReadPhi = std::function<Result<std::shared_ptr<const Field>>()>;
  Status measure(const ReadPhi& read_phi, Case& document, bool thoroughly);
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
  std::optional<double> surface_speed_;  // once steps have been computed
  bool converged_ = false;
  Outcome outcome_ = Outcome::unfinished;
  std::optional<double> wider_range_;
  Clock::time_point due_at_;
  bool thorough_ = false;
  std::shared_ptr<const Field> phi_;
  SurfaceStatistics surface_;
  RegionStatistics inside_;
  std::vector<RegionStatistics> labels_;
};

}  // namespace tidemark
