#include "ui/panels/profile_plot.h"

#include <QPainter>
#include <algorithm>

#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr double kPhiHeight = 84.0;
constexpr double kValueHeight = 64.0;
constexpr double kProfileTickPixels = 24.0;
constexpr double kAlongPixels = 52.0;
constexpr double kCurveRoom = 0.08;  // above and below curves, of their extent

}  // namespace

ProfilePlot::ProfilePlot(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(tr("φ and brightness along the line"));
}

void ProfilePlot::set_content(Content content) {
  content_ = std::move(content);
  update();
}

QSize ProfilePlot::sizeHint() const {
  return {240,
          static_cast<int>(kPhiHeight + kValueHeight) + 3 * fontMetrics().height() + 2 * kSpaceTight + 4};
}

// Between the numbers at both sides.
QRectF ProfilePlot::pane_area(double top, double high) const {
  const double left = fontMetrics().horizontalAdvance(QStringLiteral("−1000")) + kSpaceTight;
  const double right = fontMetrics().horizontalAdvance(QStringLiteral("−2.5")) + kSpaceTight;
  return {left, top, width() - left - right, high};
}

ProfilePlot::Pane ProfilePlot::phi_pane() const {
  const QRectF area = pane_area(fontMetrics().height(), kPhiHeight);
  const double most = content_.band * (1.0 + kCurveRoom);
  return {area,
          {0.0, std::max(content_.length_mm, 1e-6), area.left(), area.right()},
          {-most, most, area.bottom(), area.top()}};
}

// All values and T are seen; epsilon where it is not far wider than they are.
ProfilePlot::Pane ProfilePlot::value_pane() const {
  const QRectF area = pane_area(kPhiHeight + 2.0 * fontMetrics().height() + kSpaceTight, kValueHeight);
  double low = content_.target;
  double high = content_.target;
  if (content_.range == 0.0 && !content_.profile.points.empty()) {
    low = content_.profile.points.front().value;
    high = low;
  }
  for (const solver::ProfilePoint& point : content_.profile.points) {
    low = std::min(low, point.value);
    high = std::max(high, point.value);
  }
  const double extent = std::max(high - low, 1e-6);
  low = std::max(std::min(low, content_.target - content_.range), low - extent);
  high = std::min(std::max(high, content_.target + content_.range), high + extent);
  const double room = kCurveRoom * std::max(high - low, 1e-6);
  return {area,
          {0.0, std::max(content_.length_mm, 1e-6), area.left(), area.right()},
          {low - room, high + room, area.bottom(), area.top()}};
}

void ProfilePlot::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Pane phi = phi_pane();
  paint_pane(painter, phi, tr("φ, voxels"), tr("mm"));
  paint_ticks(painter, phi, content_.spacing_mm);
  painter.setClipRect(phi.area);
  paint_inside(painter, phi);
  painter.setPen(QPen(palette().color(QPalette::PlaceholderText), 1.0, Qt::DashLine));
  const double zero = phi.up.pixel(0.0);
  painter.drawLine(QPointF(phi.area.left(), zero), QPointF(phi.area.right(), zero));
  paint_curve(painter, phi, &solver::ProfilePoint::phi);
  painter.setClipping(false);

  const Pane value = value_pane();
  const QString unit = content_.unit.isEmpty() ? QString() : QStringLiteral(", ") + content_.unit;
  paint_pane(painter, value, tr("Brightness%1").arg(unit),
             content_.range > 0.0 ? tr("band: T ± ε") : QString());
  paint_ticks(painter, value, 0.0);
  painter.setClipRect(value.area);
  if (content_.range > 0.0) {
    QColor band = palette().color(QPalette::Link);
    band.setAlpha(60);
    const double high = value.up.pixel(content_.target + content_.range);
    const double low = value.up.pixel(content_.target - content_.range);
    painter.fillRect(QRectF(value.area.left(), high, value.area.width(), low - high), band);
    const double middle = value.up.pixel(content_.target);
    painter.setPen(QPen(palette().color(QPalette::Link), 1.0, Qt::DashLine));
    painter.drawLine(QPointF(value.area.left(), middle), QPointF(value.area.right(), middle));
  }
  paint_curve(painter, value, &solver::ProfilePoint::value);
  painter.setClipping(false);
  paint_along(painter, value);
  // The surface, through both.
  painter.setPen(QPen(palette().color(QPalette::Text), 1.0, Qt::DotLine));
  for (const double crossing : content_.profile.crossings_mm) {
    const double x = phi.along.pixel(crossing);
    painter.drawLine(QPointF(x, phi.area.top()), QPointF(x, phi.area.bottom()));
    painter.drawLine(QPointF(x, value.area.top()), QPointF(x, value.area.bottom()));
  }
}

void ProfilePlot::paint_pane(QPainter& painter, const Pane& pane, const QString& left,
                             const QString& right) const {
  painter.fillRect(pane.area, palette().color(QPalette::Base));
  painter.setPen(palette().color(QPalette::WindowText));
  const QRectF title(0.0, pane.area.top() - fontMetrics().height(), width(), fontMetrics().height());
  painter.drawText(title, Qt::AlignLeft | Qt::AlignVCenter, left);
  painter.drawText(title, Qt::AlignRight | Qt::AlignVCenter, right);
}

void ProfilePlot::paint_inside(QPainter& painter, const Pane& pane) const {
  QColor inside = palette().color(QPalette::Link);
  inside.setAlpha(32);
  const auto& points = content_.profile.points;
  if (points.empty()) return;
  double from = points.front().at_mm;
  bool is_inside = points.front().phi > 0.0;
  const auto end_at = [&](double at_mm) {
    const double left = pane.along.pixel(from);
    if (is_inside)
      painter.fillRect(QRectF(left, pane.area.top(), pane.along.pixel(at_mm) - left, pane.area.height()),
                       inside);
    from = at_mm;
    is_inside = !is_inside;
  };
  for (const double crossing : content_.profile.crossings_mm) end_at(crossing);
  end_at(points.back().at_mm);
}

void ProfilePlot::paint_curve(QPainter& painter, const Pane& pane,
                              double solver::ProfilePoint::*quantity) const {
  QPolygonF curve;
  for (const solver::ProfilePoint& point : content_.profile.points)
    curve << QPointF(pane.along.pixel(point.at_mm), pane.up.pixel(point.*quantity));
  const auto role = quantity == &solver::ProfilePoint::phi ? QPalette::Link : QPalette::Text;
  painter.setPen(QPen(palette().color(role), 1.5, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPolyline(curve);
}

// At the left in the curve's unit, at the right in mm; 0: there is nothing at the right.
void ProfilePlot::paint_ticks(QPainter& painter, const Pane& pane, double mm_per_unit) const {
  painter.setPen(palette().color(QPalette::WindowText));
  const double line = fontMetrics().height();
  for (const double tick : ticks(pane.up, kProfileTickPixels)) {
    const double y = pane.up.pixel(tick);
    const QRectF left(0.0, y - 0.5 * line, pane.area.left() - kSpaceTight, line);
    painter.drawText(left, Qt::AlignRight | Qt::AlignVCenter, general_text(tick, 4));
    if (mm_per_unit <= 0.0) continue;
    const QRectF right(pane.area.right() + kSpaceTight, y - 0.5 * line, width() - pane.area.right(), line);
    painter.drawText(right, Qt::AlignLeft | Qt::AlignVCenter, general_text(tick * mm_per_unit, 2));
  }
}

void ProfilePlot::paint_along(QPainter& painter, const Pane& pane) const {
  painter.setPen(palette().color(QPalette::WindowText));
  for (const double tick : ticks(pane.along, kAlongPixels)) {
    const double x = pane.along.pixel(tick);
    painter.drawLine(QPointF(x, pane.area.bottom()), QPointF(x, pane.area.bottom() + 2.0));
    const QRectF place(x - 0.5 * kAlongPixels, pane.area.bottom() + 3.0, kAlongPixels,
                       fontMetrics().height());
    painter.drawText(place, Qt::AlignHCenter | Qt::AlignTop, general_text(tick, 4));
  }
  const QRectF unit(0.0, pane.area.bottom() + 3.0, width(), fontMetrics().height());
  painter.drawText(unit, Qt::AlignRight | Qt::AlignTop, tr("mm"));
}

}  // namespace tidemark::ui
