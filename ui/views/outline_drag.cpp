#include "ui/views/outline_drag.h"

#include <glm/geometric.hpp>
#include <utility>

#include "ui/views/overlay.h"

namespace tidemark::ui {

OutlineDrag::OutlineDrag(DragView view, const Pointer& pressed)
    : LabelStroke(std::move(view), pressed), way_mm_{*pressed.patient_mm} {}

void OutlineDrag::move(const Pointer& pointer) {
  if (!pointer.patient_mm || glm::distance(*pointer.patient_mm, way_mm_.back()) < view().mm_per_pixel) return;
  way_mm_.push_back(*pointer.patient_mm);
  show(region_of(view().slab->inside(way_mm_)));
}

void OutlineDrag::paint(QPainter& painter) const {
  QPolygonF line;
  for (const glm::dvec3& point : way_mm_) line << view().position_of(point);
  paint_line(painter, line, kPreviewColour);
}

}  // namespace tidemark::ui
