#include "ui/views/clip_handles.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "ui/views/overlay.h"

namespace tidemark::ui {
namespace {

constexpr double kGripRadius = 7.0;  // as drawn, logical pixels
constexpr double kReach = 12.0;      // as hit
constexpr double kArrowLength = 70.0;
const QColor kColour(255, 214, 90);

// Where the grips are: the middle of the cut, and the tip of an arrow along the normal that is never too
// short to be dragged.
glm::dvec3 middle_of_cut(const renderer::ClipPlane& plane, const Geometry& geometry) {
  const auto cut = cut_of_box(geometry, plane);
  glm::dvec3 middle(0.0);
  for (const glm::dvec3& point : cut) middle += point / static_cast<double>(cut.size());
  if (!cut.empty()) return middle;
  const glm::dvec3 centre = renderer::middle_of(geometry);
  return centre + plane.normal * (plane.offset_mm - glm::dot(centre, plane.normal));
}

// Along the normal; where the normal points at the viewer, by up and down.
class MoveDrag : public Drag {
 public:
  MoveDrag(DragView view, const Pointer& pressed, const VolumeScreen& screen)
      : Drag(std::move(view)), from_(pressed.position), plane_(display().settings().clip) {
    const QPointF along = screen.position_of(plane_.normal) - screen.position_of(glm::dvec3(0.0));
    const double square = QPointF::dotProduct(along, along);
    constexpr double kShortest = 0.25;  // of the normal's length: below, the plane faces the viewer
    const double full = 1.0 / screen.mm_per_pixel();
    if (square > kShortest * kShortest * full * full) {
      mm_per_way_ = along / square;
    } else {
      mm_per_way_ =
          QPointF(0.0, -screen.mm_per_pixel()) * (glm::dot(plane_.normal, screen.into()) < 0.0 ? -1.0 : 1.0);
    }
  }
  void move(const Pointer& pointer) override {
    const double way_mm = QPointF::dotProduct(pointer.position - from_, mm_per_way_);
    display().change(
        [&](engine::DisplaySettings& settings) { settings.clip.offset_mm = plane_.offset_mm + way_mm; });
  }

 private:
  QPointF from_;
  renderer::ClipPlane plane_;
  QPointF mm_per_way_;
};

// Turns the normal as if its tip were held, around the middle of the cut.
class TiltDrag : public Drag {
 public:
  TiltDrag(DragView view, const Pointer& pressed, const VolumeScreen& screen)
      : Drag(std::move(view)),
        from_(pressed.position),
        plane_(display().settings().clip),
        into_(screen.into()) {
    right_ = screen.ray_at({1.0, 0.0}).origin_mm - screen.ray_at({0.0, 0.0}).origin_mm;
    down_ = screen.ray_at({0.0, 1.0}).origin_mm - screen.ray_at({0.0, 0.0}).origin_mm;
    pivot_mm_ = middle_of_cut(plane_, proxy().volume().geometry);
  }
  void move(const Pointer& pointer) override {
    const QPointF way = pointer.position - from_;
    const double length_mm = kArrowLength * glm::length(right_);
    const glm::dvec3 tip = plane_.normal * length_mm + right_ * way.x() + down_ * way.y();
    if (glm::length(tip) < 1e-6) return;
    const glm::dvec3 normal = glm::normalize(tip);
    display().change([&](engine::DisplaySettings& settings) {
      settings.clip.normal = normal;
      settings.clip.offset_mm = glm::dot(pivot_mm_, normal);
    });
  }

 private:
  QPointF from_;
  renderer::ClipPlane plane_;
  glm::dvec3 into_;
  glm::dvec3 right_;  // a pixel to the right and one down, in mm
  glm::dvec3 down_;
  glm::dvec3 pivot_mm_;
};

void paint_grip(QPainter& painter, QPointF at, bool hot, bool round) {
  painter.setPen(QPen(QColor(20, 20, 20), 1.5));
  painter.setBrush(hot ? kColour.lighter(130) : kColour);
  const double radius = hot ? kGripRadius + 1.5 : kGripRadius;
  if (round) {
    painter.drawEllipse(at, radius, radius);
  } else {
    painter.drawRect(QRectF(at.x() - radius, at.y() - radius, 2.0 * radius, 2.0 * radius));
  }
}

}  // namespace

ClipHandles::ClipHandles(const renderer::ClipPlane& plane, const VolumeScreen& screen,
                         const Geometry& geometry) {
  for (const glm::dvec3& point : cut_of_box(geometry, plane)) outline_ << screen.position_of(point);
  if (!outline_.isEmpty()) outline_ << outline_.first();
  const glm::dvec3 middle = middle_of_cut(plane, geometry);
  centre_ = screen.position_of(middle);
  tip_ = screen.position_of(middle + plane.normal * (kArrowLength * screen.mm_per_pixel()));
  // An arrow that points at the viewer still has a tip that can be dragged.
  const QPointF way = tip_ - centre_;
  const double length = std::hypot(way.x(), way.y());
  constexpr double kShortest = 26.0;
  if (length < kShortest)
    tip_ = centre_ + (length > 1.0 ? way * (kShortest / length) : QPointF(0.0, -kShortest));
}

std::optional<ClipHandles::Grip> ClipHandles::grip_at(QPointF position) const {
  for (const Grip grip : {Grip::tilt, Grip::move}) {
    const QPointF way = position - position_of(grip);
    if (std::hypot(way.x(), way.y()) <= kReach) return grip;
  }
  return std::nullopt;
}

void ClipHandles::paint(QPainter& painter, std::optional<Grip> hot) const {
  paint_line(painter, outline_, kColour, 1.2);
  paint_line(painter, QPolygonF({centre_, tip_}), kColour, 1.8);
  paint_grip(painter, centre_, hot == Grip::move, false);
  paint_grip(painter, tip_, hot == Grip::tilt, true);
}

std::unique_ptr<Drag> clip_drag(DragView view, const Pointer& pressed, ClipHandles::Grip grip,
                                const VolumeScreen& screen) {
  if (grip == ClipHandles::Grip::move) return std::make_unique<MoveDrag>(std::move(view), pressed, screen);
  return std::make_unique<TiltDrag>(std::move(view), pressed, screen);
}

}  // namespace tidemark::ui
