#include "engine/pace.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace tidemark::engine {
namespace {

constexpr double kUpdateSeconds = 0.048;  // from picture to picture: 20 a second are seen as motion
constexpr double kChunkSeconds = 0.016;   // of steps between two pictures, at least
// Between two pictures, at most: it should be seen how the surface moves. What has played for long may go on
// by a tenth of its steps, up to kMostSteps: those of a surface at rest take no time.
constexpr std::int64_t kFirstSteps = 50;
constexpr std::int64_t kMostSteps = 500;

}  // namespace

void Pace::set(double steps_per_second) {
  steps_per_second_ = steps_per_second;
  due_ = Engine::Clock::now();
}

void Pace::restart() {
  played_ = 0;
}

void Pace::begin_steps() {
  if (ended_ != Engine::Clock::time_point{})
    between_s_ = std::chrono::duration<double>(Engine::Clock::now() - ended_).count();
}

void Pace::end_steps(std::int64_t steps) {
  played_ += steps;
  ended_ = Engine::Clock::now();
}

std::int64_t Pace::steps_to_next_picture(double seconds_per_step) const {
  if (steps_per_picture_ > 0) return steps_per_picture_;
  if (steps_per_second_ > 0.0) return std::max(std::llround(kChunkSeconds * steps_per_second_), 1LL);
  if (seconds_per_step <= 0.0) return 1;
  const double chunk_s = std::max(kUpdateSeconds - between_s_, kChunkSeconds);
  const std::int64_t most = std::clamp(played_ / 10, kFirstSteps, kMostSteps);
  return std::clamp<std::int64_t>(std::llround(chunk_s / seconds_per_step), 1, most);
}

Engine::Clock::time_point Pace::next_due(std::int64_t steps) {
  if (steps_per_second_ <= 0.0) return {};
  const auto now = Engine::Clock::now();
  if (steps == 0) return now + std::chrono::milliseconds(1);
  const std::chrono::duration<double> time(static_cast<double>(steps) / steps_per_second_);
  due_ = std::max(due_ + std::chrono::duration_cast<Engine::Clock::duration>(time), now);
  return due_;
}

}  // namespace tidemark::engine
