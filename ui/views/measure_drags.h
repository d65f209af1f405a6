// Drags that measure distances and angles, and draw lines.
#pragma once

#include "ui/views/drag.h"

namespace tidemark::ui {

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
