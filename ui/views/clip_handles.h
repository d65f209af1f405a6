// The handles of the clip plane in the 3D view: its outline, a grip that moves it along its normal, and one
// at the normal's tip that tilts it.
#pragma once

#include <QPainter>
#include <memory>
#include <optional>

#include "ui/views/drag.h"
#include "ui/views/view_geometry.h"

namespace tidemark::ui {

class ClipHandles {
 public:
  ClipHandles(const renderer::ClipPlane& plane, const VolumeScreen& screen, const Geometry& geometry);

  enum class Grip { move, tilt };
  [[nodiscard]] std::optional<Grip> grip_at(QPointF position) const;
  [[nodiscard]] QPointF position_of(Grip grip) const { return grip == Grip::move ? centre_ : tip_; }
  // `hot`: the grip under the mouse.
  void paint(QPainter& painter, std::optional<Grip> hot) const;

 private:
  QPolygonF outline_;
  QPointF centre_;
  QPointF tip_;
};

// The drag of a grip.
std::unique_ptr<Drag> clip_drag(DragView view, const Pointer& pressed, ClipHandles::Grip grip,
                                const VolumeScreen& screen);

}  // namespace tidemark::ui
