#include "solver/convergence.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tidemark::solver {

RestRule RestRule::of(double time_step, double data_weight, double near, std::int64_t voxels_per_page) {
  // With a small alpha every front is slow, and none of them is at rest for that.
  constexpr double kLeastWeight = 0.25;
  RestRule rule;
  rule.window_time = kConvergenceWindow * time_step;
  rule.rest_content = 2.0 * near * kRestVolume * static_cast<double>(voxels_per_page);
  const double time = kRestTime / std::max(data_weight, kLeastWeight);
  rule.windows_to_rest = static_cast<std::int32_t>(std::clamp(std::ceil(time / rule.window_time), 2.0, 1e6));
  return rule;
}

void MotionWatch::restart(const RestRule& rule) {
  rule_ = rule;
  first_ = window_;
  speed_so_far_ = 0.0;
  moving_so_far_ = 0;
  rests_ = false;
}

void MotionWatch::add_page(const PageContent& page, PageRest& rest) {
  if (page.samples < kMotionSamples) return;  // it was not computed for the whole window
  const double content = page.content / page.samples;
  if (rest.since < first_) {
    rest = {static_cast<float>(content), window_, -1};
    return;
  }
  const double change = std::abs(content - static_cast<double>(rest.anchor));
  const double voxels = std::max(page.near_voxels / page.samples, kLeastNearVoxels);
  speed_so_far_ = std::max(speed_so_far_,
                           change / (voxels * static_cast<double>(window_ - rest.since) * rule_.window_time));
  if (change > rule_.rest_content) rest = {static_cast<float>(content), window_, window_};
  if (rule_.is_moving(rest.moved, first_, window_)) ++moving_so_far_;
}

void MotionWatch::end_window() {
  ++window_;
  speed_ = std::exchange(speed_so_far_, 0.0);
  moving_pages_ = std::exchange(moving_so_far_, 0);
  rests_ = moving_pages_ == 0 && window_ - first_ > rule_.windows_to_rest;
}

bool MotionWatch::is_moving(const PageRest& rest) const {
  return rule_.is_moving(rest.moved, first_, window_ - 1);
}

}  // namespace tidemark::solver
