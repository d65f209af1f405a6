// The outline of something that does not move, as a slice view shows it.
#pragma once

#include <QLineF>
#include <QList>
#include <QPainter>
#include <glm/geometric.hpp>
#include <memory>

#include "core/bit_mask.h"
#include "ui/views/mask_outline.h"
#include "ui/views/overlay.h"

namespace tidemark::ui {

// Lines in mm as outline_in_slice() gives them, on the screen.
void paint_outline(QPainter& painter, const QList<QLineF>& lines, const SliceScreen& screen,
                   const QColor& colour);

// Of a BitMask or a solver::Field; found anew when it, or the slice, is another one.
template <class Shape>
class SliceOutline {
 public:
  void paint(QPainter& painter, const std::shared_ptr<const Shape>& shape,
             const renderer::SliceOrientation& orientation, glm::dvec3 position_mm, const SliceScreen& screen,
             const QColor& colour) {
    if (!shape) {
      shape_.reset();
      return;
    }
    const double along_normal_mm = glm::dot(position_mm, orientation.into());
    if (shape_ != shape || orientation_ != orientation || along_normal_mm_ != along_normal_mm) {
      shape_ = shape;
      orientation_ = orientation;
      along_normal_mm_ = along_normal_mm;
      lines_ = outline_in_slice(*shape, orientation, position_mm);
    }
    paint_outline(painter, lines_, screen, colour);
  }

 private:
  std::shared_ptr<const Shape> shape_;
  renderer::SliceOrientation orientation_;
  double along_normal_mm_ = 0.0;
  QList<QLineF> lines_;
};

}  // namespace tidemark::ui
