// The measure of motion by which a surface counts as stopped: see kConvergedSpeed.
#pragma once

#include <cmath>
#include <cstdint>

#include "solver/executor.h"

namespace tidemark {

// The measurements of motion in a window: one every two steps, over both of them.
inline constexpr int kMotionSamples = kConvergenceWindow / 2;

// Summed over samples in a window of steps and the voxels beside the surface (StepConstants::near): the
// squared changes of phi over the last two steps, and how many voxels there were.
struct SurfaceMotion {
  double squared_change = 0.0;
  std::int64_t voxels = 0;
};

// The root mean square of the surface's normal speed, in smallest spacings per unit of time.
inline double surface_speed(const SurfaceMotion& motion, double time_step) {
  if (motion.voxels == 0) return 0.0;
  return std::sqrt(motion.squared_change / static_cast<double>(motion.voxels)) / (2.0 * time_step);
}

}  // namespace tidemark
