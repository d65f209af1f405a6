#include "engine/step_schedule.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

namespace tidemark::engine {
namespace {

constexpr double kUpdateSeconds = 0.048;  // from picture to picture: 20 a second are seen as motion
constexpr double kChunkSeconds = 0.016;   // of steps between two pictures, at least
// Between two pictures it should be seen how the surface moves: so far at most, but always so many steps.
// Those of a surface at rest take no time.
constexpr double kMostVoxels = 8.0;
constexpr std::int64_t kFewestSteps = 50;
constexpr std::int64_t kMostSteps = 500;
// So it is while the surface sets out. From then on each run may take more than the one before, up to so many
// times as much: pictures come as seldom as is still seen as motion, and the solver has the rest.
constexpr int kRunsOfTheStart = 5;
constexpr double kGrowth = 1.5;
constexpr double kMostGrowth = 10.0;

}  // namespace

void StepSchedule::set(double steps_per_second) {
  steps_per_second_ = steps_per_second;
  due_ = Engine::Clock::now();
}

void StepSchedule::restart() {
  runs_ = 0;
  voxels_per_step_ = 0.0;
  is_old_ = true;
}

void StepSchedule::moved(double voxels_per_step) {
  if (!std::exchange(is_old_, false)) voxels_per_step_ = voxels_per_step;
}

void StepSchedule::begin_steps() {
  if (ended_ != Engine::Clock::time_point{})
    between_s_ = std::chrono::duration<double>(Engine::Clock::now() - ended_).count();
}

void StepSchedule::end_steps() {
  ++runs_;
  ended_ = Engine::Clock::now();
}

std::int64_t StepSchedule::steps_to_next_picture(double seconds_per_step) const {
  if (steps_per_picture_ > 0) return steps_per_picture_;
  if (steps_per_second_ > 0.0) return std::max(std::llround(kChunkSeconds * steps_per_second_), 1LL);
  if (seconds_per_step <= 0.0) return 1;
  const double chunk_s = std::max(kUpdateSeconds - between_s_, kChunkSeconds);
  const double growth = std::min(std::pow(kGrowth, std::max(runs_ - kRunsOfTheStart, 0)), kMostGrowth);
  const double in_sight = voxels_per_step_ > 0.0 ? kMostVoxels / voxels_per_step_ : kFewestSteps;
  const double most = std::min(std::max(in_sight, 1.0 * kFewestSteps) * growth, 1.0 * kMostSteps);
  return std::llround(std::clamp(chunk_s / seconds_per_step, 1.0, most));
}

Engine::Clock::time_point StepSchedule::next_due(std::int64_t steps) {
  if (steps_per_second_ <= 0.0) return {};
  const auto now = Engine::Clock::now();
  if (steps == 0) return now + std::chrono::milliseconds(1);
  const std::chrono::duration<double> time(static_cast<double>(steps) / steps_per_second_);
  due_ = std::max(due_ + std::chrono::duration_cast<Engine::Clock::duration>(time), now);
  return due_;
}

}  // namespace tidemark::engine
