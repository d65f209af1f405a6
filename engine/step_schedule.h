// The schedule of a case that plays: how many steps come between two pictures, and when.
#pragma once

#include <cstdint>

#include "engine/engine.h"

namespace tidemark::engine {

class StepSchedule {
 public:
  // At most so many steps a second from now on; 0: as many as can be computed.
  void set(double steps_per_second);
  [[nodiscard]] double steps_per_second() const { return steps_per_second_; }
  // 0: as many as the pace, or else the time of a picture, allows.
  void set_steps_per_picture(std::int64_t steps) { steps_per_picture_ = steps; }

  // The surface begins to move, or moves by something else from now on.
  void restart();
  // How far it goes on where it is fastest, as of some steps ago: the first report after restart() may be of
  // before.
  void moved(double voxels_per_step);
  // Around each run of steps. What comes between two runs, pictures above all, leaves the next one the rest
  // of the time until a picture is due.
  void begin_steps();
  void end_steps();

  // A step takes `seconds_per_step`; 0: nobody knows.
  [[nodiscard]] std::int64_t steps_to_next_picture(double seconds_per_step) const;
  // When the steps after so many may begin: what was late is not made up for. One that waits for others in
  // lock-step, after none, looks again soon.
  [[nodiscard]] Engine::Clock::time_point next_due(std::int64_t steps);

 private:
  double steps_per_second_ = 0.0;
  std::int64_t steps_per_picture_ = 0;
  Engine::Clock::time_point due_;    // of the steps up to here
  Engine::Clock::time_point ended_;  // the last run of steps
  double between_s_ = 0.0;           // the last two runs
  int runs_ = 0;                     // of steps, since restart()
  double voxels_per_step_ = 0.0;     // 0: nobody knows
  bool is_old_ = true;               // what is reported next
};

}  // namespace tidemark::engine
