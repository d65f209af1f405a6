// Drags of spheres that add to the level set or take from it.
#pragma once

#include "ui/views/drag.h"

namespace tidemark::ui {

// From the centre outwards, seen in all views; painted at the release.
class SphereDrag : public Drag {
 public:
  SphereDrag(DragView view, const Pointer& pressed, solver::Brush brush);
  ~SphereDrag() override;
  void move(const Pointer& pointer) override;
  void release() override;
  [[nodiscard]] QString text() const override;

 private:
  void show();

  solver::Brush brush_;
  glm::dvec3 centre_mm_;
  double radius_mm_;
};

// A brush along the way of the mouse: one stroke is one entry of the history. What it erases becomes a wall
// when the display says so.
class StrokeDrag : public Drag {
 public:
  StrokeDrag(DragView view, const Pointer& pressed, solver::Brush brush);
  void move(const Pointer& pointer) override;
  void release() override;

 private:
  void dab(glm::dvec3 at_mm);

  solver::Brush brush_;
  std::uint64_t gesture_;
  double radius_mm_;
  glm::dvec3 last_mm_;
  std::vector<solver::Sphere> spheres_;
};

}  // namespace tidemark::ui
