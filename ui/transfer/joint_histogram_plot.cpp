#include "ui/transfer/joint_histogram_plot.h"

#include <QPainter>
#include <algorithm>
#include <array>
#include <cmath>

#include "ui/transfer/plot_painting.h"

namespace tidemark::ui {
namespace {

using Kind = renderer::TransferFactor::Kind;

bool is_ellipse(const AxisPrimitive& primitive) {
  return primitive.factors[0].kind == Kind::gaussian && primitive.factors[1].kind == Kind::gaussian;
}

}  // namespace

JointHistogramPlot::JointHistogramPlot(const QString& accessible_name, QWidget* parent)
    : TransferPlot(parent) {
  setAccessibleName(accessible_name);
  setToolTip(
      tr("Drag a primitive or its handles. Tab: next handle, arrows: move it (Shift: far), Page Up "
         "and Down: other primitives, Delete: remove.\nCtrl and wheel: zoom, middle button: move, "
         "double click: see all."));
}

void JointHistogramPlot::set_counts(const std::vector<std::int64_t>& counts, int columns, const Extent& x,
                                    const Extent& y) {
  counts_x_ = x;
  counts_y_ = y;
  const int rows = columns > 0 ? static_cast<int>(counts.size()) / columns : 0;
  counts_ = QImage(columns, rows, QImage::Format_Alpha8);
  const double most =
      counts.empty() ? 1.0
                     : std::max(1.0, static_cast<double>(*std::max_element(counts.begin(), counts.end())));
  for (int row = 0; row < rows; ++row) {
    uchar* line = counts_.scanLine(rows - 1 - row);
    for (int column = 0; column < columns; ++column) {
      const auto count = static_cast<double>(counts[static_cast<std::size_t>(row) * columns + column]);
      line[column] = static_cast<uchar>(std::lround(220.0 * std::log1p(count) / std::log1p(most)));
    }
  }
  update();
}

std::vector<Handle> JointHistogramPlot::handles_of(const AxisPrimitive& primitive) const {
  return plane_handles(primitive, shown_x(), shown_y());
}

PlotAxis JointHistogramPlot::fitted_y() const {
  Extent extent{y_.low, y_.high};
  for (const AxisPrimitive& primitive : primitives()) include(extent, primitive.factors[1]);
  return {.low = extent.low, .high = std::max(extent.high, extent.low + 1e-6)};
}

QRectF JointHistogramPlot::reach_in_pixels(const AxisPrimitive& primitive) const {
  const Extent x = reach_of(primitive.factors[0], shown_x());
  const Extent y = reach_of(primitive.factors[1], shown_y());
  return QRectF(QPointF(x_axis().pixel(x.low), y_axis().pixel(y.high)),
                QPointF(x_axis().pixel(x.high), y_axis().pixel(y.low)));
}

std::optional<double> JointHistogramPlot::distance(const AxisPrimitive& primitive, QPointF pointer) const {
  const QRectF reach = reach_in_pixels(primitive);
  constexpr double kNear = 5.0;
  if (!reach.adjusted(-kNear, -kNear, kNear, kNear).contains(pointer)) return std::nullopt;
  if (is_ellipse(primitive)) {
    const double u = (pointer.x() - reach.center().x()) / (reach.width() / 2.0 + kNear);
    const double v = (pointer.y() - reach.center().y()) / (reach.height() / 2.0 + kNear);
    if (u * u + v * v > 1.0) return std::nullopt;
  }
  // Among overlapping ones the smallest is chosen: the others can be clicked beside it.
  const QRectF seen = reach.intersected(area());
  return seen.width() * seen.height();
}

void JointHistogramPlot::paint_background(QPainter& painter) {
  if (counts_.isNull()) return;
  QImage picture(counts_.size(), QImage::Format_ARGB32_Premultiplied);
  picture.fill(mixed(palette().color(QPalette::Base), palette().color(QPalette::Text), 0.75));
  picture.setAlphaChannel(counts_);
  const QPointF top_left(x_axis().pixel(counts_x_.low), y_axis().pixel(counts_y_.high));
  const QPointF bottom_right(x_axis().pixel(counts_x_.high), y_axis().pixel(counts_y_.low));
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(QRectF(top_left, bottom_right), picture);
}

void JointHistogramPlot::paint_primitive(QPainter& painter, const AxisPrimitive& primitive, int number,
                                         bool chosen) {
  const QRectF room = area();
  // The product of both factors, on a coarse grid that is smoothed.
  constexpr int kCells = 96;
  std::array<double, kCells> along{};
  for (int column = 0; column < kCells; ++column) {
    const double x = x_axis().value(room.left() + (column + 0.5) / kCells * room.width());
    along[static_cast<std::size_t>(column)] = primitive.factors[0].at(x);
  }
  const QRgb colour = to_qcolor(primitive.colour).rgb();
  const double strength = chosen ? 0.65 : 0.40;
  QImage shade(kCells, kCells, QImage::Format_ARGB32);
  for (int row = 0; row < kCells; ++row) {
    const double y = y_axis().value(room.top() + (row + 0.5) / kCells * room.height());
    const double up = 255.0 * strength * primitive.factors[1].at(y);
    auto* line = reinterpret_cast<QRgb*>(shade.scanLine(row));
    for (const double share : along)
      *line++ = (colour & 0x00FFFFFFU) | static_cast<QRgb>(up * share + 0.5) << 24U;
  }
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(room, shade);

  const QRectF reach = reach_in_pixels(primitive);
  painter.setBrush(Qt::NoBrush);
  // Two lines, light on dark: there is grey of any kind beneath.
  for (const bool halo : {true, false}) {
    const double width = chosen ? 2.5 : 1.0;
    painter.setPen(QPen(palette().color(halo ? QPalette::Base : QPalette::Text), halo ? width + 2.0 : width));
    if (is_ellipse(primitive)) {
      painter.drawEllipse(reach);
    } else {
      painter.drawRect(reach.intersected(room.adjusted(1.5, 1.5, -1.5, -1.5)));
    }
  }
  const double half = painter.fontMetrics().height() / 2.0 + 4.0;
  const QRectF inner = room.adjusted(half, half, -half, -half);
  const QPointF corner = is_ellipse(primitive)
                             ? reach.center() + QPointF(0.71 * reach.width(), -0.71 * reach.height()) / 2.0
                             : reach.intersected(room).topRight() + QPointF(-half - 2.0, half + 2.0);
  draw_number(painter,
              {std::clamp(corner.x(), inner.left(), std::max(inner.left(), inner.right())),
               std::clamp(corner.y(), inner.top(), std::max(inner.top(), inner.bottom()))},
              number, chosen, palette());
}

void JointHistogramPlot::paint_axes(QPainter& painter) {
  const auto colour = [&](const PrimitiveAxis& axis) {
    return palette().color(axis.greyed.isEmpty() ? palette().currentColorGroup() : QPalette::Disabled,
                           QPalette::WindowText);
  };
  draw_bottom_axis(painter, area(), x_axis(), title_of(x_), colour(x_));
  draw_left_axis(painter, area(), y_axis(), title_of(y_), colour(y_));
}

}  // namespace tidemark::ui
