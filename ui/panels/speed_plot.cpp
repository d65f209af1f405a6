#include "ui/panels/speed_plot.h"

#include <QKeyEvent>
#include <QMouseEvent>
#include <QPainter>
#include <algorithm>
#include <cmath>

#include "engine/case_proxy.h"
#include "ui/look/term_colours.h"
#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr std::size_t kPlotBars = 64;  // few enough that whole numbers leave no gaps between them
constexpr double kHandle = 5.0;        // radius
constexpr double kGrab = 11.0;         // how near a press must be
constexpr double kStep = 0.005;        // of the shown range, for a key

// Heights of the histogram's bars. A few values (air, padding) are so frequent that the rest would not show:
// bars are square roots of counts, and one in twenty is cut off.
std::vector<double> bars_of(const engine::SourceSummary& summary) {
  std::vector<double> bars(kPlotBars, 0.0);
  for (std::size_t index = 0; index < summary.value_gradient.size(); ++index) {
    const std::size_t bin = index % engine::SourceSummary::kBins;
    // The outermost hold all that lies beyond them.
    if (bin == 0 || bin == engine::SourceSummary::kBins - 1) continue;
    bars[bin * kPlotBars / engine::SourceSummary::kBins] +=
        static_cast<double>(summary.value_gradient[index]);
  }
  for (double& bar : bars) bar = std::sqrt(bar);
  std::vector<double> sorted;
  std::copy_if(bars.begin(), bars.end(), std::back_inserter(sorted), [](double bar) { return bar > 0.0; });
  if (sorted.empty()) return bars;
  std::sort(sorted.begin(), sorted.end());
  const double most = sorted[sorted.size() - 1 - sorted.size() / 20];
  for (double& bar : bars) bar = std::min(1.0, bar / most);
  return bars;
}

}  // namespace

SpeedPlot::SpeedPlot(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(tr("Speed over the values"));
  setToolTip(tr(
      "How the data term moves the surface where the source has a value: between the feet it grows, beyond "
      "them it shrinks. Drag the peak to move T, a foot to change ε; or use the arrow keys."));
}

void SpeedPlot::set_source(const engine::SourceSummary& summary, const QString& unit) {
  bars_ = bars_of(summary);
  low_ = summary.low;
  high_ = std::max(summary.high, std::nextafter(summary.low, INFINITY));
  lowest_ = summary.lowest;
  highest_ = summary.highest;
  unit_ = unit;
  decimals_ = decimals_for(high_ - low_);
  dragged_ = Handle::none;
  show_span();
  update();
}

void SpeedPlot::set_tent(double target, double range) {
  if (target_ == target && range_ == range) return;
  target_ = target;
  range_ = range;
  if (dragged_ == Handle::none) show_span();
  setAccessibleDescription(
      tr("Grows from %1 to %2")
          .arg(number_text(target - range, decimals_, unit_), number_text(target + range, decimals_, unit_)));
  update();
}

void SpeedPlot::set_mark(std::optional<double> value) {
  if (mark_ == value) return;
  mark_ = value;
  update();
}

// The common values and the tent's feet, unless they are far away. Stays during a drag, so that nothing runs
// away under the pointer.
void SpeedPlot::show_span() {
  const double span = high_ - low_;
  shown_low_ = std::min(low_, std::max(low_ - span, target_ - 1.2 * range_));
  shown_high_ = std::max(high_, std::min(high_ + span, target_ + 1.2 * range_));
  shown_low_ = std::min(shown_low_, target_);
  shown_high_ = std::max(shown_high_, target_);
}

QRectF SpeedPlot::plot() const {
  const double text = fontMetrics().height();
  return QRectF(rect()).adjusted(kHandle + 2.0, text + kHandle, -kHandle - 2.0, -text - 2.0);
}

PlotAxis SpeedPlot::values() const {
  return {shown_low_, shown_high_, plot().left(), plot().right()};
}

double SpeedPlot::height_of(double speed) const {
  return PlotAxis{-1.0, 1.0, plot().bottom(), plot().top()}.pixel(speed);
}

QPointF SpeedPlot::peak() const {
  return {values().pixel(target_), height_of(1.0)};
}
QPointF SpeedPlot::left_foot() const {
  return {values().pixel(target_ - range_), height_of(0.0)};
}
QPointF SpeedPlot::right_foot() const {
  return {values().pixel(target_ + range_), height_of(0.0)};
}

SpeedPlot::Handle SpeedPlot::handle_at(QPointF place) const {
  Handle nearest = Handle::none;
  double distance = kGrab;
  const std::pair<Handle, QPointF> handles[] = {
      {Handle::peak, peak()}, {Handle::left_foot, left_foot()}, {Handle::right_foot, right_foot()}};
  for (const auto& [handle, at] : handles) {
    const double away = std::hypot(place.x() - at.x(), place.y() - at.y());
    if (away >= distance) continue;
    distance = away;
    nearest = handle;
  }
  return nearest;
}

// The mouse and the keys.

void SpeedPlot::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  dragged_ = handle_at(event->position());
  if (dragged_ == Handle::none) return;
  gesture_ = engine::CaseProxy::new_gesture();
  const double at = dragged_ == Handle::peak        ? target_
                    : dragged_ == Handle::left_foot ? target_ - range_
                                                    : target_ + range_;
  grip_ = at - values().value(event->position().x());
  update();
}

void SpeedPlot::mouseMoveEvent(QMouseEvent* event) {
  if (dragged_ != Handle::none) {
    drag_to(values().value(event->position().x()) + grip_);
    return;
  }
  const Handle hovered = handle_at(event->position());
  if (hovered == hovered_) return;
  hovered_ = hovered;
  setCursor(hovered == Handle::none ? Qt::ArrowCursor : Qt::SizeHorCursor);
  update();
}

void SpeedPlot::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  dragged_ = Handle::none;
  show_span();
  update();
}

void SpeedPlot::leaveEvent(QEvent* /*event*/) {
  hovered_ = Handle::none;
  update();
}

void SpeedPlot::drag_to(double value) {
  const double smallest = std::max(solver::kMinimumRange, std::pow(10.0, -decimals_));
  switch (dragged_) {
    case Handle::peak:
      return change(rounded(std::clamp(value, shown_low_, shown_high_), decimals_), range_);
    case Handle::left_foot:
      return change(target_, std::max(smallest, rounded(target_ - value, decimals_)));
    case Handle::right_foot:
      return change(target_, std::max(smallest, rounded(value - target_, decimals_)));
    case Handle::none:
      return;
  }
}

void SpeedPlot::keyPressEvent(QKeyEvent* event) {
  const double smallest = std::pow(10.0, -decimals_);
  const double step = std::max(smallest, rounded(kStep * (shown_high_ - shown_low_), decimals_));
  double target = target_;
  double range = range_;
  switch (event->key()) {
    case Qt::Key_Left:
      target -= step;
      break;
    case Qt::Key_Right:
      target += step;
      break;
    case Qt::Key_Up:
      range += step;
      break;
    case Qt::Key_Down:
      range = std::max(smallest, range - step);
      break;
    default:
      return QWidget::keyPressEvent(event);
  }
  if (!event->isAutoRepeat() || gesture_ == 0) gesture_ = engine::CaseProxy::new_gesture();
  change(std::clamp(target, lowest_, highest_), range);
}

void SpeedPlot::change(double target, double range) {
  if (target == target_ && range == range_) return;
  set_tent(target, range);
  emit edited(target, range, gesture_);
}

// Painting.

void SpeedPlot::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.fillRect(rect(), palette().color(QPalette::Base));
  paint_histogram(painter);
  paint_tent(painter);
  if (!isEnabled()) return;
  paint_mark(painter);
  paint_values(painter);
  paint_handles(painter);
  if (!hasFocus()) return;
  painter.setPen(QPen(palette().color(QPalette::Highlight), 1.0));
  painter.setBrush(Qt::NoBrush);
  painter.drawRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5));
}

void SpeedPlot::paint_histogram(QPainter& painter) const {
  QColor colour = palette().color(QPalette::Text);
  colour.setAlphaF(0.28F);
  const PlotAxis axis = values();
  const QRectF area = plot();
  const double width = (high_ - low_) / static_cast<double>(std::max<std::size_t>(bars_.size(), 1));
  QPolygonF outline;
  outline << QPointF(axis.pixel(low_), area.bottom());
  for (std::size_t index = 0; index < bars_.size(); ++index) {
    const double left = low_ + static_cast<double>(index) * width;
    const double top = area.bottom() - bars_[index] * area.height();
    outline << QPointF(axis.pixel(left), top) << QPointF(axis.pixel(left + width), top);
  }
  outline << QPointF(axis.pixel(high_), area.bottom());
  painter.setPen(Qt::NoPen);
  painter.setBrush(colour);
  painter.drawPolygon(outline);
}

void SpeedPlot::paint_tent(QPainter& painter) const {
  const QRectF area = plot();
  const PlotAxis axis = values();
  QColor line = palette().color(isEnabled() ? QPalette::Link : QPalette::Mid);
  painter.save();
  painter.setClipRect(area.adjusted(0.0, -2.0, 0.0, 2.0));
  const QPointF inside[] = {left_foot(), peak(), right_foot()};
  QColor fill = line;
  fill.setAlphaF(0.25F);
  painter.setPen(Qt::NoPen);
  painter.setBrush(fill);
  painter.drawPolygon(inside, 3);

  painter.setPen(QPen(palette().color(QPalette::PlaceholderText), 1.0, Qt::DashLine));
  painter.drawLine(QPointF(area.left(), height_of(0.0)), QPointF(area.right(), height_of(0.0)));

  const QPointF tent[] = {{area.left(), height_of(-1.0)},
                          {axis.pixel(target_ - 2.0 * range_), height_of(-1.0)},
                          peak(),
                          {axis.pixel(target_ + 2.0 * range_), height_of(-1.0)},
                          {area.right(), height_of(-1.0)}};
  painter.setPen(QPen(line, 2.0, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(Qt::NoBrush);
  // A tent wider than the plot has no floor in it.
  const bool floor_left = tent[1].x() > area.left();
  const bool floor_right = tent[3].x() < area.right();
  painter.drawPolyline(tent + (floor_left ? 0 : 1), 3 + (floor_left ? 1 : 0) + (floor_right ? 1 : 0));
  painter.restore();
}

// A line at the value, and D there.
void SpeedPlot::paint_mark(QPainter& painter) const {
  if (!mark_ || !values().holds(*mark_)) return;
  const QRectF area = plot();
  const double x = values().pixel(*mark_);
  const double speed = std::max(-1.0, 1.0 - std::abs(*mark_ - target_) / range_);
  painter.setPen(QPen(palette().color(QPalette::Text), 1.0));
  painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
  painter.setPen(QPen(palette().color(QPalette::Base), 1.0));
  painter.setBrush(kDataColour);
  painter.drawEllipse(QPointF(x, height_of(speed)), kHandle, kHandle);
}

void SpeedPlot::paint_handles(QPainter& painter) const {
  const QColor line = palette().color(QPalette::Link);
  const Handle active = dragged_ != Handle::none ? dragged_ : hovered_;
  painter.setPen(QPen(line, 1.5));
  const auto brush = [&](Handle handle) { return handle == active ? line : palette().color(QPalette::Base); };
  painter.setBrush(brush(Handle::peak));
  painter.drawEllipse(peak(), kHandle, kHandle);
  const std::pair<Handle, QPointF> feet[] = {{Handle::left_foot, left_foot()},
                                             {Handle::right_foot, right_foot()}};
  for (const auto& [handle, at] : feet) {
    if (!plot().adjusted(-1.0, 0.0, 1.0, 0.0).contains(at)) continue;
    const QPointF diamond[] = {at + QPointF(0.0, -kHandle - 1.0), at + QPointF(kHandle + 1.0, 0.0),
                               at + QPointF(0.0, kHandle + 1.0), at + QPointF(-kHandle - 1.0, 0.0)};
    painter.setBrush(brush(handle));
    painter.drawPolygon(diamond, 4);
  }
}

// T above the peak, and below the plot the values at which D = 0.
void SpeedPlot::paint_values(QPainter& painter) const {
  const QFontMetricsF metrics(font());
  const PlotAxis axis = values();
  const auto place = [&](const QString& text, double left, double baseline) {
    const double most = width() - metrics.horizontalAdvance(text) - 2.0;
    painter.drawText(QPointF(std::clamp(left, 2.0, std::max(2.0, most)), baseline), text);
  };
  painter.setPen(palette().color(QPalette::Text));
  const QString top = number_text(target_, decimals_, unit_);
  place(top, peak().x() - metrics.horizontalAdvance(top) / 2.0, metrics.ascent() + 1.0);
  const double baseline = height() - metrics.descent() - 1.0;
  const QString left = number_text(target_ - range_, decimals_);
  const QString right = number_text(target_ + range_, decimals_);
  const double left_width = metrics.horizontalAdvance(left);
  const double right_width = metrics.horizontalAdvance(right);
  if (axis.holds(target_ - range_)) {
    place(left, std::min(left_foot().x() - left_width / 2.0, peak().x() - left_width - kSpaceTight),
          baseline);
  }
  if (axis.holds(target_ + range_)) {
    place(right, std::max(right_foot().x() - right_width / 2.0, peak().x() + kSpaceTight), baseline);
  }
}

}  // namespace tidemark::ui
