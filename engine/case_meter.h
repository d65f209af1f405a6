// The measurements on a case while it runs.
#pragma once

#include <chrono>
#include <deque>
#include <functional>
#include <memory>
#include <optional>

#include "core/bit_mask.h"
#include "document/case.h"
#include "document/region_statistics.h"
#include "engine/case_state.h"
#include "engine/truth_overlap.h"

namespace tidemark::engine {

class CaseMeter {
 public:
  // Nothing is compared when it is null.
  void compare_with(std::shared_ptr<const BitMask> truth) {
    overlap_.reset();
    dice_.reset();
    if (truth) overlap_.emplace(std::move(truth));
    thorough_ = false;
  }
  // After a run of steps.
  void computed(const solver::AdvanceReport& report, std::int64_t step);
  // After a change of phi that is not a step: nothing has converged.
  void edited();
  // After edited(), where steps were computed for the edit: whether the surface rests.
  void set_converged(bool converged) { converged_ = converged; }
  // After any other change on which figures depend.
  void adjusted();

  [[nodiscard]] double seconds_per_step() const { return seconds_per_step_; }
  [[nodiscard]] bool converged() const { return converged_; }

  // Whether figures of the surface are due: as often as a twentieth of the time allows, but at most twenty
  // times a second and at least once.
  [[nodiscard]] bool due() const { return Clock::now() >= due_at_; }
  // Measures the phi that `read_phi` gives (slow where it is on a GPU), and adds the figures to the level
  // set's curve. `thoroughly`: also the volume's values under the surface and beside it.
  using ReadPhi = std::function<Result<std::shared_ptr<const solver::Field>>()>;
  Status measure(const ReadPhi& read_phi, document::Case& document, bool thoroughly);
  [[nodiscard]] bool thorough() const { return thorough_; }
  // Measures the labels where they are others than before: old figures beside new labels would mislead.
  void follow_labels(const document::Case& document);

  // Fills in the measured figures.
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
  document::Outcome outcome_ = document::Outcome::unfinished;
  std::optional<double> wider_range_;
  Clock::time_point due_at_;
  bool thorough_ = false;
  std::shared_ptr<const solver::Field> phi_;
  std::shared_ptr<const std::vector<std::int64_t>> moving_pages_;
  solver::SurfaceMeter surface_meter_{0};
  solver::SurfaceStatistics surface_;
  document::InsideStatistics inside_meter_;
  document::RegionStatistics inside_;
  document::LabelStatistics label_meter_;
  std::optional<std::uint64_t> label_revision_;     // of those that are measured
  std::vector<document::RegionStatistics> labels_;  // by their numbers
  std::optional<TruthOverlap> overlap_;             // where there is a truth
  std::optional<double> dice_;
};

}  // namespace tidemark::engine
