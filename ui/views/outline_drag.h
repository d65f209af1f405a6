// The drag that draws around what a label takes, in a slice.
#pragma once

#include <optional>
#include <vector>

#include "engine/livewire.h"
#include "ui/views/label_stroke.h"

namespace tidemark::ui {

// The way of the mouse, or lines between clicks: a click without a move begins them, each further click is a
// corner, and a click on the last or the first corner ends them. Lines are straight, or follow edges
// (engine::Livewire); one from the last to the first corner closes them. Where the way crosses itself, what
// is surrounded twice stays out.
class OutlineDrag : public LabelStroke {
 public:
  enum class Lines { straight, along_edges };
  // The view must be a slice.
  OutlineDrag(DragView view, const Pointer& pressed, Lines lines);
  void move(const Pointer& pointer) override;
  [[nodiscard]] bool lifted() override;
  [[nodiscard]] bool is_of_clicks() const override { return by_clicks_; }
  void press(const Pointer& pointer) override;
  void release() override;
  void paint(QPainter& painter) const override;

 private:
  [[nodiscard]] std::vector<glm::dvec3> line_to(glm::dvec3 place_mm);
  void add_corner(glm::dvec3 place_mm);
  void show_inside();

  std::vector<glm::dvec3> way_mm_;
  std::vector<glm::dvec3> corners_mm_;
  std::vector<glm::dvec3> next_mm_;  // the line to the corner that a click here would make
  std::optional<engine::Livewire> wire_;
  bool by_clicks_ = false;
  bool closed_ = false;
};

}  // namespace tidemark::ui
