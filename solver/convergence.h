// The measure of motion by which a surface counts as stopped: see kConvergedSpeed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "solver/executor.h"

namespace tidemark::solver {

// The measurements of motion in a window: one every two steps, over both of them.
inline constexpr int kMotionSamples = kConvergenceWindow / 2;

// The motion of a surface in a window of steps, from that of its pages: over the voxels beside the surface
// (StepConstants::near), the squared changes of phi over two steps, and how many voxels there were. Both are
// summed over the samples.
class SurfaceMotion {
 public:
  void add_page(double squared_change, std::int64_t voxels) {
    add_resting(voxels);
    squared_change_ += squared_change;
    if (voxels > 0) fastest_page_ = std::max(fastest_page_, squared_change / static_cast<double>(voxels));
  }
  // Voxels of pages that did not move.
  void add_resting(std::int64_t voxels) { voxels_ += voxels; }

  // As kConvergedSpeed says, in smallest spacings per unit of time.
  [[nodiscard]] double speed(double time_step) const {
    if (voxels_ == 0) return 0.0;
    const double mean = squared_change_ / static_cast<double>(voxels_);
    return std::sqrt(std::max(mean, kFastestPageWeight * kFastestPageWeight * fastest_page_)) /
           (2.0 * time_step);
  }

 private:
  double squared_change_ = 0.0;
  double fastest_page_ = 0.0;  // the mean squared change of the page where it is largest
  std::int64_t voxels_ = 0;
};

}  // namespace tidemark::solver
