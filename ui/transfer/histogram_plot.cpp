#include "ui/transfer/histogram_plot.h"

#include <QPainter>
#include <QPainterPath>
#include <algorithm>
#include <cmath>

#include "ui/transfer/plot_painting.h"

namespace tidemark::ui {

HistogramPlot::HistogramPlot(QWidget* parent) : TransferPlot(parent) {
  setAccessibleName(tr("Opacity by value, over the histogram"));
  setToolTip(
      tr("Drag a curve or its handles. Tab: next handle, arrows: move it (Shift: far), Page Up and "
         "Down: other primitives, Delete: remove.\nCtrl and wheel: zoom, middle button: move, double "
         "click: see all."));
}

void HistogramPlot::set_counts(const std::vector<std::int64_t>& counts, const Extent& range) {
  counts_ = counts;
  range_ = range;
  most_ = counts.empty() ? 1.0 : static_cast<double>(*std::max_element(counts.begin(), counts.end()));
  update();
}

std::vector<Handle> HistogramPlot::handles_of(const AxisPrimitive& primitive) const {
  return curve_handles(primitive, shown_x());
}

PlotAxis HistogramPlot::fitted_y() const {
  double most = 0.0;
  for (const AxisPrimitive& primitive : primitives()) most = std::max(most, primitive.opacity);
  double top = 2.0;
  // Room above, so that there is always somewhere to drag to.
  for (int i = 0; top < 1.25 * most; ++i) top *= i % 3 == 0 ? 2.5 : 2.0;
  return {.high = top, .power = 1.0 / 3.0};
}

std::optional<double> HistogramPlot::distance(const AxisPrimitive& primitive, QPointF pointer) const {
  const auto height_at = [&](double pixel) {
    return y_axis().pixel(primitive.opacity * primitive.factors[0].at(x_axis().value(pixel)));
  };
  constexpr double kNear = 7.0;
  // A curve may be steep, so it is looked for to both sides.
  double least = 1e9;
  for (double by = -kNear; by <= kNear; by += 1.0) {
    least = std::min(least, std::hypot(by, height_at(pointer.x() + by) - pointer.y()));
  }
  if (least <= kNear) return least;
  const double height = height_at(pointer.x());
  if (pointer.y() < height || area().bottom() - height < kNear) return std::nullopt;
  return kNear + pointer.y() - height;
}

void HistogramPlot::paint_background(QPainter& painter) {
  if (counts_.empty() || !(range_.high > range_.low)) return;
  const QRectF room = area();
  const double bin = (range_.high - range_.low) / static_cast<double>(counts_.size());
  QPainterPath path(QPointF(x_axis().pixel(range_.low), room.bottom()));
  for (std::size_t i = 0; i < counts_.size(); ++i) {
    const double share = std::log1p(static_cast<double>(counts_[i])) / std::log1p(most_);
    const double y = room.bottom() - share * room.height();
    path.lineTo(x_axis().pixel(range_.low + bin * static_cast<double>(i)), y);
    path.lineTo(x_axis().pixel(range_.low + bin * static_cast<double>(i + 1)), y);
  }
  path.lineTo(x_axis().pixel(range_.high), room.bottom());
  painter.fillPath(path, mixed(palette().color(QPalette::Base), palette().color(QPalette::Text), 0.18));
}

void HistogramPlot::paint_primitive(QPainter& painter, const AxisPrimitive& primitive, int number,
                                    bool chosen) {
  const QRectF room = area();
  QPolygonF curve;
  for (double x = room.left(); x <= room.right(); x += 1.0) {
    const double opacity = primitive.opacity * primitive.factors[0].at(x_axis().value(x));
    curve << QPointF(x, y_axis().pixel(opacity));
  }
  QPolygonF filled = curve;
  filled << room.bottomRight() << room.bottomLeft();
  QColor colour = to_qcolor(primitive.colour);
  colour.setAlphaF(chosen ? 0.60F : 0.35F);
  painter.setPen(Qt::NoPen);
  painter.setBrush(colour);
  painter.drawPolygon(filled);
  const QColor line =
      mixed(palette().color(QPalette::Base), palette().color(QPalette::Text), chosen ? 1.0 : 0.6);
  painter.setPen(QPen(line, chosen ? 2.5 : 1.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(Qt::NoBrush);
  painter.drawPolyline(curve);
  const QPointF top = pixel_of(handles_of(primitive).back());
  const double half = painter.fontMetrics().height() / 2.0 + 3.0;
  const QRectF inner = room.adjusted(half, half, -half, -half);
  draw_number(painter,
              {std::clamp(top.x(), inner.left(), std::max(inner.left(), inner.right())),
               std::max(top.y() - half - 8.0, inner.top())},
              number, chosen, palette());
}

void HistogramPlot::paint_axes(QPainter& painter) {
  const QColor colour = palette().color(QPalette::WindowText);
  draw_bottom_axis(painter, area(), x_axis(), title_of(x_), colour);
  draw_left_axis(painter, area(), y_axis(), tr("Opacity per mm"), colour);
  if (!counts_.empty()) draw_count_axis(painter, area(), most_, tr("Voxels"), colour);
}

}  // namespace tidemark::ui
