#include "ui/views/outline_drag.h"

#include <QLineF>
#include <glm/geometric.hpp>
#include <utility>

#include "ui/views/overlay.h"

namespace tidemark::ui {
namespace {

constexpr double kCornerReach = 6.0;  // logical pixels: a click so near to a corner is one on it

}  // namespace

OutlineDrag::OutlineDrag(DragView view, const Pointer& pressed)
    : LabelStroke(std::move(view), pressed), way_mm_{*pressed.patient_mm} {}

void OutlineDrag::show_inside() {
  std::vector<glm::dvec3> way = way_mm_;
  if (next_mm_) way.push_back(*next_mm_);
  show(region_of(view().slab->inside(way)));
}

void OutlineDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm) return;
  if (by_clicks_) {
    next_mm_ = pointer.patient_mm;
  } else if (glm::distance(*pointer.patient_mm, way_mm_.back()) >= view().mm_per_pixel) {
    way_mm_.push_back(*pointer.patient_mm);
  } else {
    return;
  }
  show_inside();
}

bool OutlineDrag::lifted() {
  by_clicks_ = by_clicks_ || way_mm_.size() == 1;
  return by_clicks_ && !closed_;
}

void OutlineDrag::press(const Pointer& pointer) {
  if (!pointer.patient_mm) return;
  const auto is_on = [&](const glm::dvec3& corner) {
    return QLineF(view().position_of(corner), pointer.position).length() < kCornerReach;
  };
  closed_ = is_on(way_mm_.back()) || is_on(way_mm_.front());
  if (!closed_) way_mm_.push_back(*pointer.patient_mm);
}

void OutlineDrag::release() {
  next_mm_.reset();
  show_inside();
  LabelStroke::release();
}

void OutlineDrag::paint(QPainter& painter) const {
  QPolygonF line;
  for (const glm::dvec3& point : way_mm_) line << view().position_of(point);
  if (next_mm_) line << view().position_of(*next_mm_);
  paint_line(painter, line, kPreviewColour);
  if (!by_clicks_) return;
  painter.setBrush(kPreviewColour);
  painter.setPen(Qt::NoPen);
  for (const glm::dvec3& corner : way_mm_) painter.drawEllipse(view().position_of(corner), 2.5, 2.5);
}

}  // namespace tidemark::ui
