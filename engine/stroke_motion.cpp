#include "engine/stroke_motion.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "engine/case_proxy.h"
#include "engine/stroke_painting.h"

namespace tidemark::engine {

StrokeMotion::StrokeMotion(CaseProxy& proxy) : proxy_(proxy) {
  connect(&proxy, &CaseProxy::state_changed, this, &StrokeMotion::follow);
}

void StrokeMotion::take(const document::Drive& drive, const std::vector<std::int64_t>& voxels,
                        std::int64_t steps) {
  const std::uint64_t gesture = CaseProxy::new_gesture();
  strokes_ = drive.strokes;
  const bool moves = can_teach(strokes_.get());
  if (moves) proxy_.pause();
  if (moves && proxy_.state().begun) add_missed(voxels, gesture);
  proxy_.set_drive(drive, gesture);
  if (!moves) return;
  if (!proxy_.state().begun) {
    document::Start start;
    start.seeds = spheres_along(proxy_.volume().geometry, strokes_->inside);
    proxy_.begin(start);
  }
  steps_ = steps;
}

void StrokeMotion::add_missed(const std::vector<std::int64_t>& voxels, std::uint64_t gesture) {
  const auto phi = proxy_.state().phi;
  if (!phi) return;
  const Geometry& geometry = proxy_.volume().geometry;
  std::vector<std::int64_t> missed;
  std::ranges::copy_if(voxels, std::back_inserter(missed), [&](std::int64_t voxel) {
    return std::ranges::binary_search(strokes_->inside, voxel) && phi->at(geometry.voxel_at(voxel)) <= 0.0F;
  });
  for (const solver::Sphere& sphere : spheres_along(geometry, missed))
    proxy_.paint(sphere, solver::Brush::add, gesture);
}

void StrokeMotion::follow() {
  if (steps_ == 0) return;
  const CaseState& state = proxy_.state();
  if (proxy_.drive().strokes != strokes_) {
    steps_ = 0;  // they were taken back meanwhile
  } else if (state.begun && state.drive.strokes == strokes_ && state.speed && !state.speed_waits) {
    proxy_.play_for(std::exchange(steps_, 0), true, [](bool) {});
  }
}

}  // namespace tidemark::engine
