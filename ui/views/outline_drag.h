// The drag that draws around what a label takes, in a slice.
#pragma once

#include <vector>

#include "ui/views/label_stroke.h"

namespace tidemark::ui {

// The way of the mouse, closed by a straight line. Where it crosses itself, what is surrounded twice stays
// out.
class OutlineDrag : public LabelStroke {
 public:
  // The view must be a slice.
  OutlineDrag(DragView view, const Pointer& pressed);
  void move(const Pointer& pointer) override;
  void paint(QPainter& painter) const override;

 private:
  std::vector<glm::dvec3> way_mm_;
};

}  // namespace tidemark::ui
