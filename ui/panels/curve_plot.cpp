#include "ui/panels/curve_plot.h"

#include <QPainter>
#include <algorithm>
#include <cmath>
#include <limits>

#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/plot_axis.h"

namespace tidemark::ui {
namespace {

constexpr int kCurveHeight = 40;
constexpr double kLeastShare = 0.02;  // of the value: changes below it look like none

}  // namespace

CurvePlot::CurvePlot(const QString& title, const QString& unit, bool logarithmic, QWidget* parent)
    : QWidget(parent), title_(title), unit_(unit), logarithmic_(logarithmic) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(title);
}

void CurvePlot::set_mark(double value, const QString& meaning) {
  mark_ = value;
  setToolTip(meaning);
}

void CurvePlot::set_points(std::vector<QPointF> points) {
  if (points == points_) return;
  points_ = std::move(points);
  setAccessibleDescription(last_text());
  update();
}

void CurvePlot::set_predicted(std::vector<QPointF> points) {
  if (points == predicted_) return;
  predicted_ = std::move(points);
  update();
}

void CurvePlot::set_steps(Steps steps) {
  if (steps == steps_) return;
  steps_ = steps;
  update();
}

QPen CurvePlot::measured_pen(const QPalette& palette) {
  return {palette.color(QPalette::Link), 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin};
}

QPen CurvePlot::predicted_pen(const QPalette& palette) {
  QPen pen(palette.color(QPalette::Text), 1.25);
  pen.setCapStyle(Qt::FlatCap);
  pen.setDashPattern({4.0, 3.0});
  return pen;
}

QString CurvePlot::last_text() const {
  if (points_.empty()) return QStringLiteral("–");
  const QString number = short_text(points_.back().y(), logarithmic_ ? 2 : 4);
  return unit_.isEmpty() ? number : number + QChar(QChar::Nbsp) + unit_;
}

QSize CurvePlot::sizeHint() const {
  return {240, fontMetrics().height() + kSpaceTight + kCurveHeight};
}
QSize CurvePlot::minimumSizeHint() const {
  return {100, sizeHint().height()};
}

double CurvePlot::scaled(double value) const {
  return logarithmic_ ? std::log10(value) : value;
}

CurvePlot::Span CurvePlot::span() const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Span span{kInfinity, -kInfinity};
  const auto include = [&](double value) {
    if (!has_place(value)) return;
    span.low = std::min(span.low, scaled(value));
    span.high = std::max(span.high, scaled(value));
  };
  for (const QPointF& point : points_) include(point.y());
  for (const QPointF& point : predicted_) include(point.y());
  if (mark_) include(*mark_);
  if (span.low > span.high) return {};
  // A curve that does not move is a line in the middle, not noise from top to bottom.
  const double least = logarithmic_ ? 0.5 : std::max(kLeastShare * std::abs(span.high), 1e-9);
  const double missing = least - (span.high - span.low);
  if (missing > 0.0) {
    span.low -= missing / 2.0;
    span.high += missing / 2.0;
  }
  return span;
}

void CurvePlot::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF text(0.0, 0.0, width(), fontMetrics().height());
  const auto group = isEnabled() ? QPalette::Active : QPalette::Disabled;
  painter.setPen(palette().color(group, QPalette::WindowText));
  painter.drawText(text, Qt::AlignLeft | Qt::AlignVCenter, title_);
  painter.drawText(text, Qt::AlignRight | Qt::AlignVCenter, last_text());
  const QRectF area = QRectF(rect()).adjusted(0.5, text.height() + kSpaceTight, -0.5, -0.5);
  painter.fillRect(area, palette().color(group, QPalette::Base));
  if (isEnabled() && !points_.empty()) paint_curve(painter, area.adjusted(4.0, 4.0, -4.0, -4.0));
}

void CurvePlot::paint_curve(QPainter& painter, const QRectF& area) const {
  const Span values = span();
  const PlotAxis up{values.low, values.high, area.bottom(), area.top()};
  const PlotAxis along{steps_.first, steps_.last, area.left(), area.right()};
  if (mark_) {
    painter.setPen(QPen(palette().color(QPalette::PlaceholderText), 1.0, Qt::DashLine));
    const double y = up.pixel(scaled(*mark_));
    painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y));
  }
  const auto line_of = [&](const std::vector<QPointF>& points) {
    QPolygonF line;
    line.reserve(static_cast<qsizetype>(points.size()));
    for (const QPointF& point : points) {
      if (has_place(point.y())) line << QPointF(along.pixel(point.x()), up.pixel(scaled(point.y())));
    }
    return line;
  };
  const QPolygonF curve = line_of(points_);
  painter.setPen(measured_pen(palette()));
  painter.drawPolyline(curve);
  if (has_place(points_.back().y())) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(palette().color(QPalette::Link));
    painter.drawEllipse(curve.back(), 2.5, 2.5);
  }
  painter.setPen(predicted_pen(palette()));
  painter.drawPolyline(line_of(predicted_));
}

}  // namespace tidemark::ui
