// Drags that measure distances and angles, and draw lines.
#pragma once

#include "ui/views/drag.h"

namespace tidemark::ui {

// A new measurement; or, on a point of one that is there, the move of that point.
std::unique_ptr<Drag> measure_drag(engine::Measurement::Kind kind, DragView view, const Pointer& pressed);

// A point of a measurement goes where it is dragged to. A distance that has no length any more goes.
class PointDrag : public Drag {
 public:
  PointDrag(DragView view, std::size_t measurement, std::size_t point)
      : Drag(std::move(view)), measurement_(measurement), point_(point) {}
  void move(const Pointer& pointer) override;
  void release() override;

 private:
  std::size_t measurement_;
  std::size_t point_;
};

// From one end to the other. A drag of no length leaves nothing.
class DistanceDrag : public Drag {
 public:
  DistanceDrag(DragView view, const Pointer& pressed);
  void move(const Pointer& pointer) override;
  void release() override;

 private:
  engine::Measurement measurement_;
};

// The first drag is one leg, ending in the vertex; the next one, begun anywhere, points to the other end.
class AngleDrag : public Drag {
 public:
  AngleDrag(DragView view, const Pointer& pressed);
  void move(const Pointer& pointer) override;
  void release() override;

 private:
  bool second_leg_ = false;
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
