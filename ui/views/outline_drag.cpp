#include "ui/views/outline_drag.h"

#include <QLineF>
#include <glm/geometric.hpp>
#include <utility>

#include "ui/views/overlay.h"

namespace tidemark::ui {
namespace {

constexpr double kCornerReach = 6.0;  // logical pixels: a click so near to a corner is one on it

}  // namespace

OutlineDrag::OutlineDrag(DragView view, const Pointer& pressed, Lines lines)
    : LabelStroke(std::move(view), pressed), way_mm_{*pressed.patient_mm}, corners_mm_(way_mm_) {
  if (lines == Lines::along_edges) wire_.emplace(*this->view().slab, proxy().source());
}

std::vector<glm::dvec3> OutlineDrag::line_to(glm::dvec3 place_mm) {
  return wire_ ? wire_->way_to(place_mm) : std::vector{place_mm};
}

void OutlineDrag::add_corner(glm::dvec3 place_mm) {
  const std::vector<glm::dvec3> line = line_to(place_mm);
  way_mm_.insert(way_mm_.end(), line.begin(), line.end());
  corners_mm_.push_back(place_mm);
  if (wire_) wire_->begin_at(place_mm);
}

void OutlineDrag::show_inside() {
  std::vector<glm::dvec3> way = way_mm_;
  way.insert(way.end(), next_mm_.begin(), next_mm_.end());
  show(region_of(view().slab->inside(way)));
}

void OutlineDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm) return;
  if (by_clicks_) {
    next_mm_ = line_to(*pointer.patient_mm);
  } else if (glm::distance(*pointer.patient_mm, way_mm_.back()) >= view().mm_per_pixel) {
    way_mm_.push_back(*pointer.patient_mm);
  } else {
    return;
  }
  show_inside();
}

bool OutlineDrag::lifted() {
  const bool is_first_click = !by_clicks_ && way_mm_.size() == 1;
  if (is_first_click && wire_) wire_->begin_at(way_mm_.front());
  by_clicks_ = by_clicks_ || is_first_click;
  return by_clicks_ && !closed_;
}

void OutlineDrag::press(const Pointer& pointer) {
  if (!pointer.patient_mm) return;
  const auto is_on = [&](const glm::dvec3& corner) {
    return QLineF(view().position_of(corner), pointer.position).length() < kCornerReach;
  };
  closed_ = is_on(corners_mm_.back()) || is_on(corners_mm_.front());
  if (!closed_) add_corner(*pointer.patient_mm);
}

void OutlineDrag::release() {
  next_mm_.clear();
  if (by_clicks_) next_mm_ = line_to(corners_mm_.front());
  show_inside();
  LabelStroke::release();
}

void OutlineDrag::paint(QPainter& painter) const {
  QPolygonF line;
  for (const glm::dvec3& point : way_mm_) line << view().position_of(point);
  for (const glm::dvec3& point : next_mm_) line << view().position_of(point);
  paint_line(painter, line, kPreviewColour);
  if (!by_clicks_) return;
  painter.setBrush(kPreviewColour);
  painter.setPen(Qt::NoPen);
  for (const glm::dvec3& corner : corners_mm_) painter.drawEllipse(view().position_of(corner), 2.5, 2.5);
}

}  // namespace tidemark::ui
