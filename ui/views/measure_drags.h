// Drags that measure distances and angles, and draw lines.
#pragma once

#include "ui/views/drag.h"

namespace tidemark::ui {

// In a slice: a new measurement; or, on a point of one that is seen there, the move of that point.
std::unique_ptr<Drag> measure_drag(engine::Measurement::Kind kind, DragView view, const Pointer& pressed);

// A point of a measurement goes where it is dragged to. A measurement whose points are put together goes.
class PointDrag : public Drag {
 public:
  PointDrag(DragView view, std::size_t measurement, std::size_t point)
      : Drag(std::move(view)), measurement_(measurement), point_(point) {}
  void move(const Pointer& pointer) override;
  void release() override;

 private:
  [[nodiscard]] bool is_there() const;

  std::size_t measurement_;
  std::size_t point_;
};

// A distance is one drag from end to end. An angle is one to the vertex, and another drag or a click to the
// other end; between them its second leg follows the mouse. One that is not complete is in no list.
class MeasureDrag : public Drag {
 public:
  MeasureDrag(engine::Measurement::Kind kind, DragView view, const Pointer& pressed);
  void move(const Pointer& pointer) override;
  [[nodiscard]] bool lifted() override;
  [[nodiscard]] bool is_of_clicks() const override { return measurement_.points_mm.size() > 2; }
  [[nodiscard]] bool stays_behind() const override { return true; }
  [[nodiscard]] bool acts_at_its_end() const override { return true; }
  void press(const Pointer& pointer) override { move(pointer); }
  void release() override;
  void paint(QPainter& painter) const override;

 private:
  engine::Measurement measurement_;
};

// The line along which values are plotted. A click takes it away.
class ProfileDrag : public Drag {
 public:
  ProfileDrag(DragView view, const Pointer& pressed);
  void move(const Pointer& pointer) override;
  void release() override;

 private:
  engine::Measurement line_;
};

}  // namespace tidemark::ui
