// What drives a level set: speed functions, walls and anchors, and the source.
#include <utility>

#include "document/level_set.h"
#include "solver/speed/speed_registry.h"

namespace tidemark::document {
namespace {

// What of it was changed. The function that strokes bring with them is no change of its own.
ChangeKind kind_of_change(const Drive& before, const Drive& after) {
  if (before.constraints != after.constraints) return ChangeKind::constraints;
  return before.strokes != after.strokes ? ChangeKind::examples : ChangeKind::speed;
}

// Without what waits for another function.
Drive relevant(Drive drive) {
  if (drive.setting.is_tent()) drive.setting = {};
  if (!solver::any_has(drive.setting, &solver::SpeedKind::needs_strokes)) drive.strokes.reset();
  if (!solver::any_has(drive.setting, &solver::SpeedKind::needs_map)) drive.map.reset();
  if (!uses_images(drive.setting)) drive.images.clear();
  return drive;
}

}  // namespace

Status LevelSet::set_drive(const Drive& drive, std::uint64_t gesture) {
  TIDEMARK_TRY(end_other_change(gesture));
  if (drive == *drive_) return {};
  TIDEMARK_TRY(check(drive.setting));
  const ChangeKind kind = kind_of_change(*drive_, drive);
  const Point before = known_;
  // Another function comes with set_speed(); until then the present one goes on.
  Drive now = drive.setting.is_tent() ? drive : drive_in_use();
  now.constraints = drive.constraints;
  TIDEMARK_TRY(use(now, drive.setting.is_tent() ? nullptr : executor().speed(), Entry::next));
  begin_change(kind, gesture, before);
  drive_ = std::make_shared<const Drive>(drive);
  return gesture == 0 ? history_.close() : Status();
}

Status LevelSet::set_speed(std::shared_ptr<const solver::SpeedFunction> speed) {
  return use(*drive_, std::move(speed), Entry::none);
}

Drive LevelSet::drive_in_use() const {
  return value_of(setup_.drive());
}

// Puts it in place of what drives and holds the surface, and into the recipe.
Status LevelSet::use(const Drive& drive, std::shared_ptr<const solver::SpeedFunction> speed, Entry entry) {
  const Drive used = relevant(drive);
  const Drive present = relevant(drive_in_use());
  // The one in place was made from the same: giving it again would wake pages, which a replay does not.
  const bool in_place = used.setting.is_tent() || executor().speed() != nullptr;
  if (in_place && used == present) return {};
  TIDEMARK_TRY(setup_.set_drive(shared(used), std::move(speed)));
  if (used.constraints != present.constraints) {
    curve_.cut(step());
    dirty_ = true;
  }
  if (used == relevant(value_of(recipe_.final_drive()))) return {};
  if (!begun()) {
    recipe_.drive = shared(used);
  } else if (RecipeEvent event{step(), DriveEvent{std::make_shared<const Drive>(used)}};
             entry == Entry::next || recipe_.events.size() > settled_events_) {
    record(std::move(event));
  } else {
    append(std::move(event));  // other ways to here and on from here count on the last one
  }
  if (!dirty_) known_.recipe = recipe_;
  return {};
}

Status LevelSet::smooth_source(double sigma_mm) {
  if (sigma_mm == smoothed_mm()) return history_.close();
  auto source = smoothed_source(setup_.volume(), sigma_mm);
  if (!source) return pass_on(source);
  return set_source(std::move(*source), sigma_mm, nullptr);
}

Status LevelSet::set_source(std::shared_ptr<const Volume> source, double sigma_mm,
                            std::shared_ptr<const solver::SpeedFunction> speed) {
  TIDEMARK_TRY(history_.close());
  TIDEMARK_TRY(setup_.set_source(std::move(source), sigma_mm, speed));
  Point before = known_;
  if (begun()) {
    record({step(), SmoothEvent{sigma_mm}});
  } else {
    recipe_.smoothed_mm = sigma_mm;
  }
  TIDEMARK_TRY(read_back_phi());
  in_place_ = known_;
  enter(ChangeKind::source, std::move(before));
  return speed == nullptr ? Status() : set_speed(std::move(speed));
}

// Of what waits for another function nothing is lost.
void LevelSet::take_drive_of_recipe() {
  Drive drive = value_of(recipe_.final_drive());
  if (relevant(drive) == relevant(*drive_)) return;
  if (drive.strokes == nullptr) drive.strokes = drive_->strokes;
  if (drive.map == nullptr) drive.map = drive_->map;
  drive_ = std::make_shared<const Drive>(std::move(drive));
}

}  // namespace tidemark::document
