// Drags that paint examples, walls and anchors. They change what drives the surface when the button is
// released; until then all views show what it will be.
#pragma once

#include "engine/stroke_painting.h"
#include "ui/views/drag.h"

namespace tidemark::ui {

// Discs in one slice: the left button inside, the right one outside, with Ctrl either takes strokes away.
class ExampleDrag : public Drag {
 public:
  ExampleDrag(DragView view, const Pointer& pressed);
  ~ExampleDrag() override;
  void move(const Pointer& pointer) override;
  [[nodiscard]] bool acts_at_its_end() const override { return true; }
  void release() override;
  [[nodiscard]] QString text() const override;

 private:
  void dab(glm::dvec3 from_mm, glm::dvec3 to_mm);

  engine::Mark mark_;
  double radius_mm_;
  glm::dvec3 last_mm_;
  std::vector<std::int64_t> voxels_;  // ascending
  std::shared_ptr<const solver::Strokes> strokes_;
};

// Spheres of the brush: the left button walls, with Shift anchors, the right one takes both away.
class ConstraintDrag : public Drag {
 public:
  ConstraintDrag(DragView view, const Pointer& pressed);
  ~ConstraintDrag() override;
  void move(const Pointer& pointer) override;
  [[nodiscard]] bool acts_at_its_end() const override { return true; }
  void release() override;

 private:
  void dab(glm::dvec3 from_mm, glm::dvec3 to_mm);

  solver::Constraint what_;
  double radius_mm_;
  glm::dvec3 last_mm_;
  std::vector<solver::Sphere> spheres_;
  std::shared_ptr<const solver::Constraints> before_;
  std::shared_ptr<const solver::Constraints> constraints_;  // with the spheres
};

// `drive` with the strokes. With the first ones of both kinds they drive the surface from then on.
[[nodiscard]] document::Drive taught(document::Drive drive, std::shared_ptr<const solver::Strokes> strokes);
// The constraints of a drive (null: none) with a sphere more; null when nothing is left.
[[nodiscard]] std::shared_ptr<const solver::Constraints> with_spheres(
    const solver::Constraints* constraints, const Geometry& geometry,
    const std::vector<solver::Sphere>& spheres, solver::Constraint what);

// From one point to another, so near to each other that discs or spheres make one stroke. The first point is
// left out unless it is the only one.
[[nodiscard]] std::vector<glm::dvec3> way_between(glm::dvec3 from_mm, glm::dvec3 to_mm, double stride_mm);

// What is still missing before examples can drive the surface; empty: nothing.
[[nodiscard]] QString missing_examples(const solver::Strokes* strokes);

}  // namespace tidemark::ui
