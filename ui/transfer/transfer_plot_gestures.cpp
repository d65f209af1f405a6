// TransferPlot's mouse and keys.
#include <QKeyEvent>
#include <QMouseEvent>
#include <algorithm>
#include <cmath>

#include "ui/transfer/transfer_plot.h"

namespace tidemark::ui {
namespace {

constexpr double kHandleReach = 9.0;  // logical pixels around a handle's middle
constexpr double kFineSteps = 500.0;  // of the keys, along an axis
constexpr double kFinest = 500.0;     // widths and ramps are at least this part of the range

double distance_between(QPointF a, QPointF b) {
  return std::hypot(a.x() - b.x(), a.y() - b.y());
}

Qt::CursorShape cursor_of(const HandleKind& handle) {
  const bool along = handle.x != Grip::none;
  const bool up = handle.y != Grip::none || handle.opacity;
  return along && up ? Qt::SizeAllCursor : along ? Qt::SizeHorCursor : Qt::SizeVerCursor;
}

bool is_among(const HandleKind& kind, const std::vector<Handle>& handles) {
  return std::any_of(handles.begin(), handles.end(), [&](const Handle& h) { return h.kind == kind; });
}

}  // namespace

std::optional<Handle> TransferPlot::handle_at(QPointF pointer) const {
  std::optional<Handle> nearest;
  double least = kHandleReach;
  for (const Handle& handle : handles()) {
    const double away = distance_between(pixel_of(handle), pointer);
    if (away > least || (nearest && away == least)) continue;
    least = away;
    nearest = handle;
  }
  return nearest;
}

std::optional<int> TransferPlot::primitive_at(QPointF pointer) const {
  std::optional<int> nearest;
  double least = 0.0;
  if (!area().contains(pointer)) return nearest;
  for (int i = 0; i < static_cast<int>(primitives_.size()); ++i) {
    const auto away = distance(primitives_[static_cast<std::size_t>(i)], pointer);
    if (!away || (nearest && *away >= least)) continue;
    least = *away;
    nearest = i;
  }
  return nearest;
}

void TransferPlot::mousePressEvent(QMouseEvent* event) {
  const QPointF at = event->position();
  if (event->button() == Qt::MiddleButton && !drag_) {
    pan_ = Pan{at.x(), shown_x()};
    setCursor(Qt::ClosedHandCursor);
    return;
  }
  if (event->button() != Qt::LeftButton || pan_) return;
  if (const auto handle = handle_at(at)) {
    selected_ = handle->kind;
    drag_ = Drag{chosen_, handle->kind, at - pixel_of(*handle),
                 at,      true,         primitives_[static_cast<std::size_t>(chosen_)]};
  } else if (const auto index = primitive_at(at)) {
    if (*index != chosen_) emit chosen(*index);
    if (!has(*index)) return;
    // A drag from anywhere on it moves the whole primitive; a click only chooses it.
    for (const Handle& whole : handles_of(primitives_[static_cast<std::size_t>(*index)])) {
      if (whole.kind.x != Grip::whole && whole.kind.y != Grip::whole) continue;
      selected_ = whole.kind;
      drag_ = Drag{*index, whole.kind, at - pixel_of(whole),
                   at,     false,      primitives_[static_cast<std::size_t>(*index)]};
    }
  } else {
    selected_.reset();
  }
  update();
}

void TransferPlot::mouseMoveEvent(QMouseEvent* event) {
  const QPointF at = event->position();
  if (pan_) {
    const Extent whole = whole_x();
    const double extent = pan_->shown.high - pan_->shown.low;
    const double by = (pan_->from - at.x()) * extent / (x_axis_.to - x_axis_.from);
    const double low = std::clamp(pan_->shown.low + by, whole.low, std::max(whole.low, whole.high - extent));
    if (zoomed_) zoomed_ = Extent{low, low + extent};
    fit();
    update();
  } else if (drag_) {
    drag_to(at);
  } else {
    show_cursor(at);
  }
}

void TransferPlot::drag_to(QPointF pointer) {
  // It may have been deleted, or become another kind, meanwhile.
  if (!has(drag_->index) ||
      !is_among(drag_->handle, handles_of(primitives_[static_cast<std::size_t>(drag_->index)]))) {
    drag_.reset();
    fit();
    update();
    return;
  }
  constexpr double kMeant = 3.0;
  if (!drag_->begun && distance_between(pointer, drag_->pressed) < kMeant) return;
  drag_->begun = true;
  const QPointF pixel = pointer - drag_->offset;
  const glm::dvec2 to{std::clamp(x_axis_.value(pixel.x()), x_axis_.low, x_axis_.high),
                      std::clamp(y_axis_.value(pixel.y()), y_axis_.low, y_axis_.high)};
  const glm::dvec2 smallest{x_axis_.extent() / kFinest, y_axis_.extent() / kFinest};
  emit edited(drag_->index,
              moved(primitives_[static_cast<std::size_t>(drag_->index)], drag_->handle, to, smallest));
}

void TransferPlot::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() == Qt::MiddleButton) pan_.reset();
  if (event->button() == Qt::LeftButton) drag_.reset();
  fit();
  show_cursor(event->position());
  update();
}

void TransferPlot::mouseDoubleClickEvent(QMouseEvent* event) {
  if (event->button() == Qt::LeftButton && !handle_at(event->position())) {
    reset_zoom();
  } else {
    mousePressEvent(event);
  }
}

void TransferPlot::leaveEvent(QEvent* /*event*/) {
  hovered_.reset();
  update();
}

void TransferPlot::show_cursor(QPointF pointer) {
  const auto handle = handle_at(pointer);
  const auto kind = handle ? std::optional(handle->kind) : std::nullopt;
  if (kind != hovered_) update();
  hovered_ = kind;
  if (handle) {
    setCursor(cursor_of(handle->kind));
  } else if (primitive_at(pointer)) {
    setCursor(Qt::PointingHandCursor);
  } else {
    unsetCursor();
  }
}

void TransferPlot::wheelEvent(QWheelEvent* event) {
  // Without Ctrl the panel scrolls.
  if (!event->modifiers().testFlag(Qt::ControlModifier) || drag_) {
    event->ignore();
    return;
  }
  zoom(std::pow(0.8, event->angleDelta().y() / 120.0), x_axis_.value(event->position().x()));
  event->accept();
}

void TransferPlot::keyPressEvent(QKeyEvent* event) {
  const bool coarse = event->modifiers().testFlag(Qt::ShiftModifier);
  const double middle = 0.5 * (x_axis_.low + x_axis_.high);
  switch (event->key()) {
    case Qt::Key_Left:
      return move_by_keys({-1.0, 0.0}, coarse);
    case Qt::Key_Right:
      return move_by_keys({1.0, 0.0}, coarse);
    case Qt::Key_Up:
      return move_by_keys({0.0, 1.0}, coarse);
    case Qt::Key_Down:
      return move_by_keys({0.0, -1.0}, coarse);
    case Qt::Key_PageUp:
      if (has(chosen_ - 1)) emit chosen(chosen_ - 1);
      return;
    case Qt::Key_PageDown:
      if (has(chosen_ + 1)) emit chosen(chosen_ + 1);
      return;
    case Qt::Key_Delete:
    case Qt::Key_Backspace:
      if (has(chosen_) && !drag_) emit delete_asked();
      return;
    case Qt::Key_Plus:
    case Qt::Key_Equal:
      return zoom(0.8, middle);
    case Qt::Key_Minus:
      return zoom(1.25, middle);
    case Qt::Key_0:
      return reset_zoom();
    case Qt::Key_Escape:
      if (!drag_) break;
      if (has(drag_->index)) emit edited(drag_->index, drag_->before);
      drag_.reset();
      fit();
      return update();
    default:
      break;
  }
  QWidget::keyPressEvent(event);
}

void TransferPlot::move_by_keys(QPointF direction, bool coarse) {
  const std::vector<Handle> all = handles();
  if (all.empty() || drag_) return;
  const auto is_selected = [&](const Handle& h) { return selected_ && h.kind == *selected_; };
  const auto is_whole = [](const Handle& h) { return h.kind.x == Grip::whole || h.kind.y == Grip::whole; };
  auto at = std::find_if(all.begin(), all.end(), is_selected);
  if (at == all.end()) at = std::find_if(all.begin(), all.end(), is_whole);
  if (at == all.end()) at = all.begin();
  const Handle handle = *at;
  selected_ = handle.kind;
  const double step = coarse ? 10.0 : 1.0;
  const QPointF pixel = pixel_of(handle);
  // As far along the axis on any screen; a step of the opacity's axis is finer where there is little of it.
  const double x = pixel.x() + direction.x() * step * (x_axis_.to - x_axis_.from) / kFineSteps;
  const double y = pixel.y() + direction.y() * step * (y_axis_.to - y_axis_.from) / kFineSteps;
  const glm::dvec2 smallest{x_axis_.extent() / kFinest, y_axis_.extent() / kFinest};
  const glm::dvec2 to{x_axis_.value(x), std::clamp(y_axis_.value(y), y_axis_.low, y_axis_.high)};
  // A move across the handle's direction leaves its other coordinates unchanged, to the last digit.
  const HandleKind kind{direction.x() != 0.0 ? handle.kind.x : Grip::none,
                        direction.y() != 0.0 ? handle.kind.y : Grip::none,
                        direction.y() != 0.0 && handle.kind.opacity};
  update();
  if (kind == HandleKind{}) return;
  emit edited(chosen_, moved(primitives_[static_cast<std::size_t>(chosen_)], kind, to, smallest));
}

void TransferPlot::focusInEvent(QFocusEvent* event) {
  const std::vector<Handle> all = handles();
  if (!all.empty() && event->reason() == Qt::TabFocusReason) selected_ = all.front().kind;
  if (!all.empty() && event->reason() == Qt::BacktabFocusReason) selected_ = all.back().kind;
  QWidget::focusInEvent(event);
}

// Tab goes from handle to handle, and after the last one on to the next widget.
bool TransferPlot::focusNextPrevChild(bool next) {
  const std::vector<Handle> all = handles();
  const auto at = std::find_if(all.begin(), all.end(),
                               [&](const Handle& h) { return selected_ && h.kind == *selected_; });
  if (at != all.end()) {
    if (next && at + 1 != all.end()) {
      selected_ = (at + 1)->kind;
      update();
      return true;
    }
    if (!next && at != all.begin()) {
      selected_ = (at - 1)->kind;
      update();
      return true;
    }
  }
  return QWidget::focusNextPrevChild(next);
}

}  // namespace tidemark::ui
