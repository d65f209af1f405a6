#include "ui/views/drag.h"

#include <algorithm>

#include "engine/case_balance.h"
#include "ui/views/edit_drags.h"
#include "ui/views/label_drag.h"
#include "ui/views/mark_drags.h"
#include "ui/views/measure_drags.h"
#include "ui/views/mouse_scheme.h"
#include "ui/views/outline_drag.h"
#include "ui/views/probe_drags.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

// Right and left: wider and narrower; down and up: the centre to higher and lower values, darker and
// brighter.
class WindowDrag : public Drag {
 public:
  WindowDrag(DragView view, const Pointer& pressed)
      : Drag(std::move(view)), from_(pressed.position), window_(display().settings().window) {
    const engine::SourceSummary& summary = proxy().summary();
    per_pixel_ = span_between(summary.low, summary.high) / 400.0;
  }

  void move(const Pointer& pointer) override {
    const QPointF way = pointer.position - from_;
    WindowLevel window = window_;
    window.width = std::max(window_.width + way.x() * per_pixel_, per_pixel_);
    window.centre = window_.centre + way.y() * per_pixel_;
    display().change([&](engine::DisplaySettings& settings) { settings.window = window; });
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
    display().change([&](engine::DisplaySettings& settings) { settings.cursor_mm = *pointer.patient_mm; });
  }
};

class WhyDrag : public Drag {
 public:
  WhyDrag(DragView view, const Pointer& pressed) : Drag(std::move(view)) { move(pressed); }

  void move(const Pointer& pointer) override {
    if (pointer.patient_mm) proxy().balance().ask(*pointer.patient_mm);
  }
};

std::unique_ptr<Drag> label_drag(DragView view, const Pointer& pressed) {
  const engine::LabelWay way = view.proxy.display().label_brush().way;
  if (!view.slab || way == engine::LabelWay::brush)
    return std::make_unique<LabelDrag>(std::move(view), pressed);
  const auto lines =
      way == engine::LabelWay::livewire ? OutlineDrag::Lines::along_edges : OutlineDrag::Lines::straight;
  return std::make_unique<OutlineDrag>(std::move(view), pressed, lines);
}

}  // namespace

std::unique_ptr<Drag> window_drag(DragView view, const Pointer& pressed) {
  return std::make_unique<WindowDrag>(std::move(view), pressed);
}

bool is_for_slices(engine::Tool tool) {
  return tool == engine::Tool::measure_distance || tool == engine::Tool::measure_angle ||
         tool == engine::Tool::profile || tool == engine::Tool::examples;
}

std::unique_ptr<Drag> tool_drag(engine::Tool tool, DragView view, const Pointer& pressed) {
  if (tool == engine::Tool::window) {
    const bool moves = mouse_scheme() == MouseScheme::itk_snap && pressed.patient_mm;
    return moves ? std::make_unique<CrosshairDrag>(std::move(view), pressed)
                 : window_drag(std::move(view), pressed);
  }
  if (!pressed.patient_mm || (is_for_slices(tool) && !view.slab)) return nullptr;
  const bool other_button = pressed.button == Qt::RightButton;
  switch (tool) {
    case engine::Tool::window:
      break;
    case engine::Tool::crosshair:
      return std::make_unique<CrosshairDrag>(std::move(view), pressed);
    case engine::Tool::probe_speed:
      return std::make_unique<SpeedProbeDrag>(std::move(view), pressed);
    case engine::Tool::probe_transfer:
      return std::make_unique<TransferProbeDrag>(std::move(view), pressed);
    case engine::Tool::seed:
      return std::make_unique<SphereDrag>(std::move(view), pressed,
                                          other_button ? solver::Brush::erase : solver::Brush::add);
    case engine::Tool::paint:
      return std::make_unique<StrokeDrag>(std::move(view), pressed,
                                          other_button ? solver::Brush::erase : solver::Brush::add);
    case engine::Tool::erase:
      return std::make_unique<StrokeDrag>(std::move(view), pressed,
                                          other_button ? solver::Brush::add : solver::Brush::erase);
    case engine::Tool::measure_distance:
      return measure_drag(engine::Measurement::Kind::distance, std::move(view), pressed);
    case engine::Tool::measure_angle:
      return measure_drag(engine::Measurement::Kind::angle, std::move(view), pressed);
    case engine::Tool::profile:
      return std::make_unique<ProfileDrag>(std::move(view), pressed);
    case engine::Tool::examples:
      return std::make_unique<ExampleDrag>(std::move(view), pressed);
    case engine::Tool::wall:
      return std::make_unique<ConstraintDrag>(std::move(view), pressed);
    case engine::Tool::label:
      return label_drag(std::move(view), pressed);
    case engine::Tool::why:
      return std::make_unique<WhyDrag>(std::move(view), pressed);
  }
  return nullptr;
}

}  // namespace tidemark::ui
