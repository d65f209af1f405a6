#include "ui/views/measure_drags.h"

#include <QLineF>
#include <algorithm>

#include "ui/views/overlay.h"

namespace tidemark::ui {
namespace {

// Logical pixels.
constexpr double kGrabReach = 8.0;
constexpr double kShortestLeg = 2.0;

// The point of a measurement that is seen under the mouse: that measurement and the point, by their numbers.
std::optional<std::pair<std::size_t, std::size_t>> point_under(const DragView& view, const Pointer& pressed) {
  std::optional<std::pair<std::size_t, std::size_t>> nearest;
  double reach = kGrabReach;
  const auto& all = view.proxy.display().settings().measurements;
  for (std::size_t n = 0; n < all.size(); ++n) {
    if (!is_seen_in(*view.slab, all[n])) continue;
    for (std::size_t p = 0; p < all[n].points_mm.size(); ++p) {
      const double away = QLineF(view.position_of(all[n].points_mm[p]), pressed.position).length();
      if (away > reach) continue;
      reach = away;
      nearest = {n, p};
    }
  }
  return nearest;
}

bool has_a_point_leg(const DragView& view, const engine::Measurement& measurement) {
  const auto& points = measurement.points_mm;
  const auto is_point = [&view](const glm::dvec3& from, const glm::dvec3& to) {
    return QLineF(view.position_of(from), view.position_of(to)).length() < kShortestLeg;
  };
  return std::ranges::adjacent_find(points, is_point) != points.end();
}

}  // namespace

std::unique_ptr<Drag> measure_drag(engine::Measurement::Kind kind, DragView view, const Pointer& pressed) {
  if (const auto point = point_under(view, pressed))
    return std::make_unique<PointDrag>(std::move(view), point->first, point->second);
  return std::make_unique<MeasureDrag>(kind, std::move(view), pressed);
}

bool PointDrag::is_there() const {
  const auto& all = display().settings().measurements;
  return measurement_ < all.size() && point_ < all[measurement_].points_mm.size();
}

void PointDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm || !is_there()) return;
  display().change([&](engine::DisplaySettings& settings) {
    settings.measurements[measurement_].points_mm[point_] = *pointer.patient_mm;
  });
}

void PointDrag::release() {
  if (!is_there() || !has_a_point_leg(view(), display().settings().measurements[measurement_])) return;
  display().change([&](engine::DisplaySettings& settings) {
    settings.measurements.erase(settings.measurements.begin() + static_cast<std::ptrdiff_t>(measurement_));
  });
}

MeasureDrag::MeasureDrag(engine::Measurement::Kind kind, DragView view, const Pointer& pressed)
    : Drag(std::move(view)), measurement_{kind, {*pressed.patient_mm, *pressed.patient_mm}} {}

void MeasureDrag::move(const Pointer& pointer) {
  if (pointer.patient_mm) measurement_.points_mm.back() = *pointer.patient_mm;
}

// At the vertex of an angle: the second leg begins.
bool MeasureDrag::lifted() {
  if (measurement_.complete() || has_a_point_leg(view(), measurement_)) return false;
  measurement_.points_mm.push_back(measurement_.points_mm.back());
  return true;
}

void MeasureDrag::release() {
  if (!measurement_.complete() || has_a_point_leg(view(), measurement_)) return;
  display().change([&](engine::DisplaySettings& settings) { settings.measurements.push_back(measurement_); });
}

void MeasureDrag::paint(QPainter& painter) const {
  paint_measurement(painter, measurement_, view().position_of);
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
