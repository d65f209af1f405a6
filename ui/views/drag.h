// The gesture of a mouse button between press and release.
#pragma once

#include <QPainter>
#include <QPointF>
#include <QSizeF>
#include <QString>
#include <functional>
#include <memory>
#include <optional>

#include "engine/case_proxy.h"
#include "engine/slice_slab.h"

namespace tidemark::ui {

// Where the mouse is.
struct Pointer {
  QPointF position;  // logical pixels from the view's top left
  Qt::MouseButton button = Qt::NoButton;
  Qt::KeyboardModifiers modifiers;
  std::optional<glm::dvec3> patient_mm;  // on the slice, the clip plane or the surface
};

// A view as drags see it.
struct DragView {
  engine::CaseProxy& proxy;
  QSizeF size;
  double mm_per_pixel = 1.0;
  std::function<QPointF(glm::dvec3)> position_of;  // of a point of the patient
  std::optional<engine::SliceSlab> slab;           // the voxels that a slice shows; none in 3D
};

// One gesture, from the press over every move to the release; or from click to click, see lifted().
class Drag {
 public:
  explicit Drag(DragView view) : view_(std::move(view)) {}
  virtual ~Drag() = default;
  Drag(const Drag&) = delete;
  Drag& operator=(const Drag&) = delete;

  virtual void move(const Pointer& pointer) = 0;
  // The button is up. Whether the gesture goes on without it: then moves follow, and with the next press
  // press().
  [[nodiscard]] virtual bool lifted() { return false; }
  [[nodiscard]] virtual bool is_of_clicks() const { return false; }
  // Whether it is given up between clicks when its view or its slice is left. Else the slice stays.
  [[nodiscard]] virtual bool stays_behind() const { return false; }
  // Whether nothing has happened before its end, so that Escape gives it up while the button is down.
  [[nodiscard]] virtual bool acts_at_its_end() const { return false; }
  virtual void press(const Pointer& /*pointer*/) {}
  virtual void release() {}                                  // at its end
  virtual void paint(QPainter& /*painter*/) const {}         // over the view, while it lasts
  [[nodiscard]] virtual QString text() const { return {}; }  // beside the mouse: its result so far

 protected:
  [[nodiscard]] engine::CaseProxy& proxy() const { return view_.proxy; }
  [[nodiscard]] const DragView& view() const { return view_; }
  [[nodiscard]] engine::Display& display() const { return view_.proxy.display(); }

 private:
  DragView view_;
};

// Whether a tool does nothing in 3D.
[[nodiscard]] bool is_for_slices(engine::Tool tool);
// The gesture of a button in any view (handbook/window.md). None where there is nothing to do, as for a
// tool that needs a point of the patient and has none.
std::unique_ptr<Drag> tool_drag(engine::Tool tool, DragView view, const Pointer& pressed);
std::unique_ptr<Drag> window_drag(DragView view, const Pointer& pressed);

}  // namespace tidemark::ui
