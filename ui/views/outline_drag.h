// The drag that draws around what a label takes, in a slice.
#pragma once

#include <optional>
#include <vector>

#include "ui/views/label_stroke.h"

namespace tidemark::ui {

// The way of the mouse, or a polygon: a click without a move begins one, each further click is a corner, and
// a click on the last or the first corner ends it. A straight line closes both. Where the way crosses itself,
// what is surrounded twice stays out.
class OutlineDrag : public LabelStroke {
 public:
  // The view must be a slice.
  OutlineDrag(DragView view, const Pointer& pressed);
  void move(const Pointer& pointer) override;
  [[nodiscard]] bool lifted() override;
  [[nodiscard]] bool is_of_clicks() const override { return by_clicks_; }
  void press(const Pointer& pointer) override;
  void release() override;
  void paint(QPainter& painter) const override;

 private:
  void show_inside();

  std::vector<glm::dvec3> way_mm_;
  std::optional<glm::dvec3> next_mm_;  // the corner that a click here would make
  bool by_clicks_ = false;
  bool closed_ = false;
};

}  // namespace tidemark::ui
