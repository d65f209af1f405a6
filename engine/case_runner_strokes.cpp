// Strokes of examples, and the motion that follows them.
#include <algorithm>
#include <iterator>

#include "engine/case_runner.h"
#include "engine/stroke_painting.h"
#include "solver/speed/speed_registry.h"

namespace tidemark::engine {

Status CaseRunner::take_stroke(const document::Drive& drive, const std::vector<std::int64_t>& voxels,
                               std::int64_t steps, std::uint64_t gesture, const Progress& progress) {
  document::LevelSet& level_set = case_->level_set();
  const bool moves = steps > 0 && group_.expired() && can_teach(drive.strokes.get()) &&
                     solver::any_has(drive.setting, &solver::SpeedKind::needs_strokes);
  if (!moves) return report_edit(level_set.set_drive(drive, gesture));
  play_alone(false);
  std::vector<std::int64_t> inside;
  std::ranges::set_intersection(voxels, drive.strokes->inside, std::back_inserter(inside));
  if (level_set.begun()) TIDEMARK_TRY(add_missed(inside, gesture));
  TIDEMARK_TRY(report_edit(level_set.set_drive(drive, gesture)));
  if (!level_set.begun())
    TIDEMARK_TRY(report_edit(level_set.begin(start_in(case_->volume()->geometry, *drive.strokes), progress)));
  stroke_steps_ = steps;
  return {};
}

Status CaseRunner::add_missed(const std::vector<std::int64_t>& inside, std::uint64_t gesture) {
  auto phi = painter_.phi(*case_);
  if (!phi) return pass_on(phi);
  const Geometry& geometry = case_->volume()->geometry;
  std::vector<std::int64_t> missed;
  std::ranges::copy_if(inside, std::back_inserter(missed),
                       [&](std::int64_t voxel) { return (*phi)->at(geometry.voxel_at(voxel)) <= 0.0F; });
  for (const solver::Sphere& sphere : spheres_along(geometry, missed))
    TIDEMARK_TRY(report_edit(case_->level_set().paint(sphere, solver::Brush::add, gesture)));
  return {};
}

}  // namespace tidemark::engine
