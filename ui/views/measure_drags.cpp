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

constexpr double kGrabPixels = 8.0;

// The point of a complete measurement that is under the mouse: that measurement and the point, by their
// numbers.
std::optional<std::pair<std::size_t, std::size_t>> point_under(const DragView& view, const Pointer& pressed) {
  std::optional<std::pair<std::size_t, std::size_t>> nearest;
  double distance_mm = kGrabPixels * view.mm_per_pixel;
  const auto& all = view.proxy.display().settings().measurements;
  for (std::size_t n = 0; n < all.size(); ++n) {
    for (std::size_t p = 0; all[n].complete() && p < all[n].points_mm.size(); ++p) {
      const double away_mm = glm::distance(all[n].points_mm[p], *pressed.patient_mm);
      if (away_mm > distance_mm) continue;
      distance_mm = away_mm;
      nearest = {n, p};
    }
  }
  return nearest;
}

// An angle of which only the first leg is there.
bool has_open_angle(const engine::Display& display) {
  const auto& measurements = display.settings().measurements;
  return !measurements.empty() && measurements.back().kind == engine::Measurement::Kind::angle &&
         !measurements.back().complete();
}

}  // namespace

std::unique_ptr<Drag> measure_drag(engine::Measurement::Kind kind, DragView view, const Pointer& pressed) {
  const bool is_angle = kind == engine::Measurement::Kind::angle;
  const bool goes_on = is_angle && has_open_angle(view.proxy.display());
  if (const auto point = point_under(view, pressed); point && !goes_on)
    return std::make_unique<PointDrag>(std::move(view), point->first, point->second);
  if (is_angle) return std::make_unique<AngleDrag>(std::move(view), pressed);
  return std::make_unique<DistanceDrag>(std::move(view), pressed);
}

void PointDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm || display().settings().measurements.size() <= measurement_) return;
  display().change([&](engine::DisplaySettings& settings) {
    settings.measurements[measurement_].points_mm[point_] = *pointer.patient_mm;
  });
}

void PointDrag::release() {
  const auto& measurements = display().settings().measurements;
  if (measurements.size() <= measurement_) return;
  const engine::Measurement& moved = measurements[measurement_];
  if (moved.kind != engine::Measurement::Kind::distance || moved.value() >= 2.0 * view().mm_per_pixel) return;
  display().change([&](engine::DisplaySettings& settings) {
    settings.measurements.erase(settings.measurements.begin() + static_cast<std::ptrdiff_t>(measurement_));
  });
}

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
  second_leg_ = has_open_angle(display());
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
