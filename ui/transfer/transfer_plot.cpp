#include "ui/transfer/transfer_plot.h"

#include <QPainter>
#include <algorithm>

#include "ui/transfer/plot_painting.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {

TransferPlot::TransferPlot(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

void TransferPlot::set_axes(const PrimitiveAxis& x, const PrimitiveAxis& y) {
  x_ = x;
  y_ = y;
  fit();
  update();
}

void TransferPlot::set_primitives(const std::vector<AxisPrimitive>& primitives, int chosen) {
  if (chosen != chosen_) selected_.reset();
  primitives_ = primitives;
  chosen_ = chosen;
  // An axis that moved under the pointer would drag on by itself.
  if (!drag_) fit();
  update();
}

void TransferPlot::reset_zoom() {
  zoomed_.reset();
  fit();
  update();
}

bool TransferPlot::has(int index) const {
  return index >= 0 && index < static_cast<int>(primitives_.size());
}

std::vector<Handle> TransferPlot::handles() const {
  return has(chosen_) ? handles_of(primitives_[static_cast<std::size_t>(chosen_)]) : std::vector<Handle>();
}

QPointF TransferPlot::pixel_of(const Handle& handle) const {
  return {x_axis_.pixel(handle.at.x), y_axis_.pixel(handle.at.y)};
}

QRectF TransferPlot::area() const {
  const PlotMargins margins = plot_margins(QFontMetrics(axis_font(font())), shows_counts());
  return QRectF(rect()).adjusted(margins.left, margins.top, -margins.right, -margins.bottom);
}

Extent TransferPlot::whole_x() const {
  Extent extent{x_.low, x_.high};
  for (const AxisPrimitive& primitive : primitives_) include(extent, primitive.factors[0]);
  // Beyond what lies outside there is room for a ramp's plateau, and to drag on.
  const double room = 0.1 * (extent.high - extent.low);
  if (extent.low < x_.low) extent.low -= room;
  if (extent.high > x_.high) extent.high += room;
  return extent;
}

void TransferPlot::fit() {
  const QRectF room = area();
  const Extent shown = zoomed_.value_or(whole_x());
  x_axis_ = {shown.low, std::max(shown.high, shown.low + 1e-6), room.left(), room.right()};
  if (!drag_) y_axis_ = fitted_y();
  y_axis_.from = room.bottom();
  y_axis_.to = room.top();
}

void TransferPlot::zoom(double factor, double about) {
  const Extent whole = whole_x();
  const double extent = std::min(x_axis_.extent() * factor, whole.high - whole.low);
  const double share = (about - x_axis_.low) / x_axis_.extent();
  constexpr double kClosest = 1e-3;
  if (extent < kClosest * (whole.high - whole.low)) return;
  const double low = std::clamp(about - share * extent, whole.low, whole.high - extent);
  zoomed_ = Extent{low, low + extent};
  if (extent >= whole.high - whole.low) zoomed_.reset();
  fit();
  update();
}

QString TransferPlot::title_of(const PrimitiveAxis& axis) const {
  return axis.unit.isEmpty() ? axis.name : tr("%1 (%2)").arg(axis.name, axis.unit);
}

QString TransferPlot::handle_text(const HandleKind& handle) const {
  if (!has(chosen_)) return {};
  const AxisPrimitive& primitive = primitives_[static_cast<std::size_t>(chosen_)];
  const auto number = [](double value, const QString& unit) {
    const QString text = general_text(value, 4);
    return unit.isEmpty() ? text : text + QChar(0x00A0) + unit;
  };
  QStringList parts;
  const auto add = [&](Grip grip, const renderer::TransferFactor& factor, const PrimitiveAxis& axis) {
    const bool ramp = factor.kind == renderer::TransferFactor::Kind::ramp;
    const double middle = ramp ? 0.5 * (factor.start + factor.end) : factor.start;
    if (grip == Grip::whole) parts << (ramp ? tr("Middle") : tr("Centre")) + ' ' + number(middle, axis.unit);
    if (grip == Grip::start) parts << tr("Start") + ' ' + number(factor.start, axis.unit);
    if (grip == Grip::end) parts << tr("End") + ' ' + number(factor.end, axis.unit);
    if (grip == Grip::below || grip == Grip::above)
      parts << tr("Width") + ' ' + number(factor.end, axis.unit);
  };
  add(handle.x, primitive.factors[0], x_);
  add(handle.y, primitive.factors[1], y_);
  if (handle.opacity) parts << tr("Opacity %1").arg(number(primitive.opacity, {}));
  return parts.join(QStringLiteral(", "));
}

void TransferPlot::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setFont(axis_font(font()));
  const QRectF room = area();
  painter.fillRect(room, palette().base());
  painter.save();
  painter.setClipRect(room);
  paint_background(painter);
  for (int i = 0; i < static_cast<int>(primitives_.size()); ++i) {
    if (i != chosen_) paint_primitive(painter, primitives_[static_cast<std::size_t>(i)], i + 1, false);
  }
  if (has(chosen_)) {
    paint_primitive(painter, primitives_[static_cast<std::size_t>(chosen_)], chosen_ + 1, true);
  }
  painter.restore();
  painter.setBrush(Qt::NoBrush);
  const bool focused = hasFocus();
  painter.setPen(QPen(palette().color(focused ? QPalette::Highlight : QPalette::Mid), focused ? 2.0 : 1.0));
  painter.drawRect(room);
  paint_axes(painter);
  if (isEnabled()) paint_handles(painter);
}

void TransferPlot::paint_handles(QPainter& painter) {
  const QRectF room = area();
  for (const Handle& handle : handles()) {
    const QPointF at = pixel_of(handle);
    if (!room.adjusted(-1.0, -1.0, 1.0, 1.0).contains(at)) continue;
    const bool selected = selected_ == handle.kind && (hasFocus() || drag_);
    const HandleState state = selected                  ? HandleState::selected
                              : hovered_ == handle.kind ? HandleState::hovered
                                                        : HandleState::plain;
    const bool whole = handle.kind.x == Grip::whole || handle.kind.y == Grip::whole;
    draw_handle(painter, at, whole ? HandleShape::round : HandleShape::square, state, palette());
    if (selected) draw_read_out(painter, room, handle_text(handle.kind), palette());
  }
}

void TransferPlot::resizeEvent(QResizeEvent* /*event*/) {
  fit();
}

}  // namespace tidemark::ui
