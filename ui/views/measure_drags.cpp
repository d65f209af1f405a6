#include "ui/views/measure_drags.h"

#include <glm/geometric.hpp>

namespace tidemark::ui {
namespace {

void set_last(engine::Display& display, const engine::Measurement& measurement) {
  display.change([&](engine::DisplaySettings& settings) { settings.measurements.back() = measurement; });
}

void remove_last(engine::Display& display) {
  display.change([](engine::DisplaySettings& settings) { settings.measurements.pop_back(); });
}

}  // namespace

DistanceDrag::DistanceDrag(DragView view, const Pointer& pressed) : Drag(std::move(view)) {
  measurement_.points_mm = {*pressed.patient_mm, *pressed.patient_mm};
  display().change([&](engine::DisplaySettings& settings) { settings.measurements.push_back(measurement_); });
}

void DistanceDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm || display().settings().measurements.empty()) return;
  measurement_.points_mm[1] = *pointer.patient_mm;
  set_last(display(), measurement_);
}

void DistanceDrag::release() {
  if (display().settings().measurements.empty()) return;
  if (measurement_.value() < 2.0 * view().mm_per_pixel) remove_last(display());
}

AngleDrag::AngleDrag(DragView view, const Pointer& pressed) : Drag(std::move(view)) {
  const auto& measurements = display().settings().measurements;
  second_leg_ = !measurements.empty() && measurements.back().kind == engine::Measurement::Kind::angle &&
                !measurements.back().complete();
  display().change([&](engine::DisplaySettings& settings) {
    if (!second_leg_)
      settings.measurements.push_back({engine::Measurement::Kind::angle, {*pressed.patient_mm}});
    settings.measurements.back().points_mm.push_back(*pressed.patient_mm);
  });
}

void AngleDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm || display().settings().measurements.empty()) return;
  engine::Measurement measurement = display().settings().measurements.back();
  measurement.points_mm.back() = *pointer.patient_mm;
  set_last(display(), measurement);
}

void AngleDrag::release() {
  if (display().settings().measurements.empty()) return;
  const auto& points = display().settings().measurements.back().points_mm;
  const double leg_mm = glm::distance(points[points.size() - 1], points[points.size() - 2]);
  if (leg_mm < 2.0 * view().mm_per_pixel) remove_last(display());
}

ProfileDrag::ProfileDrag(DragView view, const Pointer& pressed) : Drag(std::move(view)) {
  line_.points_mm = {*pressed.patient_mm, *pressed.patient_mm};
}

void ProfileDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm) return;
  line_.points_mm[1] = *pointer.patient_mm;
  display().change([&](engine::DisplaySettings& settings) { settings.profile = line_; });
}

void ProfileDrag::release() {
  if (line_.value() >= 2.0 * view().mm_per_pixel) return;
  display().change([](engine::DisplaySettings& settings) { settings.profile.reset(); });
}

}  // namespace tidemark::ui
