// Convergence by place: which pages have moved of late, and whether the whole surface is at rest.
#pragma once

#include <cstdint>

#include "solver/executor.h"

namespace tidemark::solver {

// The measurements of a page in a window: one every two steps, so that a voxel which flips between two values
// shows the same one each time.
inline constexpr int kMotionSamples = kConvergenceWindow / 2;

// What a page holds of the inside, summed over the samples of a window: 2 near times its volume inside, in
// voxels. A front that goes on by d changes it by d for each voxel beside the surface; what flickers comes
// back, whatever its period is.
struct PageContent {
  double content = 0.0;      // clamp(phi, -near, near) + near of all voxels (StepConstants::near)
  double near_voxels = 0.0;  // voxels beside the surface: |phi| <= near
  int samples = 0;
};

// What is remembered of a page from window to window. A page that becomes resident begins anew.
struct PageRest {
  float anchor = 0.0F;      // the mean content when it had last moved, or was first seen
  std::int32_t since = -1;  // the window of the anchor; -1: none
  std::int32_t moved = -1;  // the last window in which it had moved; -1: none
};

// When a page counts as moving (kRestVolume).
struct RestRule {
  double window_time = 1.0;          // units of time
  double rest_content = 1.0;         // it has moved when its content has changed by more
  std::int32_t windows_to_rest = 2;  // when it has not moved for so many it is at rest

  // `data_weight`: alpha where the data term is on, else 0. `near`: StepConstants::near.
  static RestRule of(double time_step, double data_weight, double near, std::int64_t voxels_per_page);

  // At the end of window `now`, of a page that last moved in `moved`; `first`: the first window that counts.
  [[nodiscard]] bool is_moving(std::int32_t moved, std::int32_t first, std::int32_t now) const {
    return moved >= first && now - moved < windows_to_rest;
  }
};

// A page's speed is a mean over the voxels beside the surface; fewer count as so many.
inline constexpr double kLeastNearVoxels = 16.0;

// Follows all pages from window to window.
class MotionWatch {
 public:
  // What was seen so far no longer counts.
  void restart(const RestRule& rule);

  // Of a page, at the end of a window. Quiet pages need not be shown.
  void add_page(const PageContent& page, PageRest& rest);
  // After the last page of a window.
  void end_window();

  // Of the last window.
  [[nodiscard]] bool rests() const { return rests_; }
  [[nodiscard]] std::int64_t moving_pages() const { return moving_pages_; }
  // Of the page where it is largest: how far its part of the surface has gone on since the anchor, by time,
  // in smallest spacings a unit of time.
  [[nodiscard]] double speed() const { return speed_; }
  // Whether it was moving in the last window that it was shown in.
  [[nodiscard]] bool is_moving(const PageRest& rest) const;

 private:
  RestRule rule_;
  std::int32_t window_ = 0;  // the present one
  std::int32_t first_ = 0;   // the first that counts
  double speed_so_far_ = 0.0;
  std::int64_t moving_so_far_ = 0;
  double speed_ = 0.0;
  std::int64_t moving_pages_ = 0;
  bool rests_ = false;
};

}  // namespace tidemark::solver
