#include "ui/views/drag.h"

#include <algorithm>

#include "ui/views/edit_drags.h"
#include "ui/views/measure_drags.h"
#include "ui/views/mouse_scheme.h"
#include "ui/views/probe_drags.h"

namespace tidemark {
namespace {

// Right and left: wider and narrower; down and up: the centre to higher and lower values, darker and
// brighter.
class WindowDrag : public Drag {
 public:
  WindowDrag(DragView view, const Pointer& pressed)
      : Drag(std::move(view)), from_(pressed.position), window_(display().settings().window) {
    const SourceSummary& summary = proxy().summary();
    per_pixel_ = std::max<double>(summary.high - summary.low, 1e-6) / 400.0;
  }

  void move(const Pointer& pointer) override {
    const QPointF way = pointer.position - from_;
    WindowLevel window = window_;
    window.width = std::max(window_.width + way.x() * per_pixel_, per_pixel_);
    window.centre = window_.centre + way.y() * per_pixel_;
    display().change([&](DisplaySettings& settings) { settings.window = window; });
  }

 private:
  QPointF from_;
  WindowLevel window_;
  double per_pixel_ = 1.0;
};

class CrosshairDrag : public Drag {
 public:
  CrosshairDrag(DragView view, const Pointer& pressed) : Drag(std::move(view)) { move(pressed); }

  void move(const Pointer& pointer) override {
    if (!pointer.patient_mm) return;
    display().change([&](DisplaySettings& settings) { settings.cursor_mm = *pointer.patient_mm; });
  }
};

}  // namespace

std::unique_ptr<Drag> window_drag(DragView view, const Pointer& pressed) {
  return std::make_unique<WindowDrag>(std::move(view), pressed);
}

std::unique_ptr<Drag> tool_drag(Tool tool, DragView view, const Pointer& pressed) {
  if (tool == Tool::window) {
    const bool moves = mouse_scheme() == MouseScheme::itk_snap && pressed.patient_mm;
    return moves ? std::make_unique<CrosshairDrag>(std::move(view), pressed)
                 : window_drag(std::move(view), pressed);
  }
  if (!pressed.patient_mm) return nullptr;
  const bool other_button = pressed.button == Qt::RightButton;
  switch (tool) {
    case Tool::window:
      break;
    case Tool::crosshair:
      return std::make_unique<CrosshairDrag>(std::move(view), pressed);
    case Tool::probe_speed:
      return std::make_unique<SpeedProbeDrag>(std::move(view), pressed);
    case Tool::probe_transfer:
      return std::make_unique<TransferProbeDrag>(std::move(view), pressed);
    case Tool::seed:
      return std::make_unique<SphereDrag>(std::move(view), pressed, other_button ? Brush::erase : Brush::add);
    case Tool::paint:
      return std::make_unique<StrokeDrag>(std::move(view), pressed, other_button ? Brush::erase : Brush::add);
    case Tool::erase:
      return std::make_unique<StrokeDrag>(std::move(view), pressed, other_button ? Brush::add : Brush::erase);
    case Tool::measure_distance:
      return std::make_unique<DistanceDrag>(std::move(view), pressed);
    case Tool::measure_angle:
      return std::make_unique<AngleDrag>(std::move(view), pressed);
  }
  return nullptr;
}

}  // namespace tidemark
