// The commands of a case about what drives its surface.
#include <vector>

#include "engine/case_proxy.h"
#include "engine/case_runner.h"

namespace tidemark::engine {

void CaseProxy::change_parameters(const ParameterChange& change, std::uint64_t gesture) {
  solver::Parameters wanted = wanted_parameters_;
  change(wanted);
  if (wanted == wanted_parameters_) return;
  wanted_parameters_ = wanted;
  post([change, gesture](CaseRunner& runner, const Progress&) {
    document::LevelSet& level_set = runner.document().level_set();
    solver::Parameters parameters = level_set.parameters();
    change(parameters);
    if (parameters.band == level_set.parameters().band)
      return runner.report_change(level_set.set_parameters(parameters, gesture));
    runner.set_playing(false);
    return runner.report_edit(level_set.set_parameters(parameters, gesture));  // it begins again
  });
  emit state_changed();  // every view and panel shows the wish at once
}

void CaseProxy::set_parameters(const solver::Parameters& parameters, std::uint64_t gesture) {
  change_parameters([parameters](solver::Parameters& wanted) { wanted = parameters; }, gesture);
}

CaseProxy::ChangedDrive CaseProxy::want(const DriveChange& change) {
  const document::Drive before = wanted_drive_;
  document::Drive after = before;
  change(after);
  after.images.clear();
  if (document::uses_images(after.setting)) after.images = used_images(display_.settings().images);
  if (after == before) return {};
  wanted_drive_ = after;
  return [change, before, after](const document::Drive& present) {
    if (present == before) return after;
    document::Drive changed = present;
    change(changed);
    // Where the change left the images alone, those that the case has stay.
    const bool keeps = after.images == before.images && document::uses_images(present.setting);
    changed.images = keeps ? present.images : after.images;
    if (!document::uses_images(changed.setting)) changed.images.clear();
    return changed;
  };
}

void CaseProxy::change_drive(const DriveChange& change, std::uint64_t gesture) {
  const ChangedDrive changed = want(change);
  if (!changed) return;
  post([changed, gesture](CaseRunner& runner, const Progress&) {
    document::LevelSet& level_set = runner.document().level_set();
    return runner.report_edit(level_set.set_drive(changed(level_set.drive()), gesture));
  });
  emit state_changed();
}

void CaseProxy::set_drive(const document::Drive& drive, std::uint64_t gesture) {
  change_drive([drive](document::Drive& wanted) { wanted = drive; }, gesture);
}

void CaseProxy::take_stroke(const DriveChange& change, const std::vector<std::int64_t>& voxels,
                            std::int64_t steps) {
  const ChangedDrive changed = want(change);
  if (!changed) return;
  post([changed, voxels, steps, gesture = new_gesture()](CaseRunner& runner, const Progress& progress) {
    const document::Drive drive = changed(runner.document().level_set().drive());
    return runner.take_stroke(drive, voxels, steps, gesture, progress);
  });
  emit state_changed();
}

// An image was added, moved, taken away, or is to be used or not.
void CaseProxy::use_images_of_display() {
  if (!document::uses_images(wanted_drive_.setting)) return;
  // Every change gets those of the display.
  if (wanted_drive_.images != used_images(display_.settings().images))
    change_drive([](document::Drive&) {}, new_gesture());
}

// Undo, or a session, has brought others.
void CaseProxy::show_images_of_drive() {
  if (!document::uses_images(wanted_drive_.setting)) return;
  if (wanted_drive_.images == used_images(display_.settings().images)) return;
  display_.change([&](DisplaySettings& settings) { use_images(settings.images, wanted_drive_.images); });
}

}  // namespace tidemark::engine
