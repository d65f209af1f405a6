// The common base of executors: the source, the equation's constants, and the frame of a run of steps.
#pragma once

#include <functional>
#include <utility>

#include "solver/convergence.h"
#include "solver/model.h"

namespace tidemark::solver {

class ExecutorBase : public Executor {
 public:
  Status set_parameters(const Parameters& parameters) final { return drive(parameters, given_speed_); }
  Status set_speed(std::shared_ptr<const SpeedFunction> speed) final {
    return drive(parameters(), std::move(speed));
  }
  [[nodiscard]] const Parameters& parameters() const final { return model_.parameters(); }
  [[nodiscard]] double band() const final { return model_.band(); }
  [[nodiscard]] double time_step() const final { return model_.time_step(); }
  [[nodiscard]] std::int64_t steps_of_last_run() const final { return steps_of_last_run_; }
  [[nodiscard]] const std::shared_ptr<const SpeedFunction>& speed() const final { return given_speed_; }
  [[nodiscard]] const std::shared_ptr<const Constraints>& constraints() const final { return constraints_; }

 protected:
  ExecutorBase(std::shared_ptr<const Volume> source, const Parameters& parameters);

  // What drives the surface, with the model that it and the parameters make.
  struct Drive {
    std::shared_ptr<const SpeedFunction> given;  // null: the tent
    std::shared_ptr<const SpeedFunction> used;
    Model model;
  };
  // With other parameters or another speed function (null: the tent). Fails (ErrorKind::usage) on parameters
  // that check() refuses or that change the band.
  [[nodiscard]] Result<Drive> drive_with(const Parameters& parameters,
                                         std::shared_ptr<const SpeedFunction> given) const;
  // Takes drive_with(), and renews what the executor makes of it.
  virtual Status drive(const Parameters& parameters, std::shared_ptr<const SpeedFunction> given) = 0;
  void take(Drive drive);
  // Takes the function that belongs to the present phi, where it follows the surface. The watch goes on.
  Status follow_surface();
  [[nodiscard]] bool is_following() const { return is_following_; }
  [[nodiscard]] Status check_fits(const Constraints& constraints) const;

  // Steps one by one until the run ends. `step` computes one, adds its voxels and its paging to the report,
  // and returns whether a window of steps ended with it, so that watch_ has something new.
  Result<AdvanceReport> run_steps(const Advance& run,
                                  const std::function<Result<bool>(AdvanceReport&)>& step);

  std::shared_ptr<const Volume> source_;
  std::shared_ptr<const SpeedFunction> given_speed_;  // null: the tent
  std::shared_ptr<const SpeedFunction> speed_;        // in use
  std::shared_ptr<const Constraints> constraints_;    // null: none
  Model model_;
  // Of the window over which motion is summed up. The change over two steps is known after the second.
  int steps_in_window_ = 0;
  [[nodiscard]] bool next_step_is_measured() const { return steps_in_window_ % 2 == 1; }
  // For pages of so many voxels.
  [[nodiscard]] RestRule rest_rule(std::int64_t voxels_per_page) const;
  // What moved so far no longer counts; while a function follows the surface it does.
  void restart_watch(std::int64_t voxels_per_page);
  MotionWatch watch_;
  std::int64_t steps_of_last_run_ = 0;

 private:
  bool is_following_ = false;
};

}  // namespace tidemark::solver
