#include "ui/panels/gradient_plot.h"

#include <QPainter>
#include <algorithm>

#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/plot_axis.h"

namespace tidemark::ui {
namespace {

constexpr double kBandSwatch = 9.0;
constexpr double kGradientTickPixels = 44.0;
constexpr int kFaint = 90;  // opacity of the whole band's bars

PlotAxis axis_of(const QRectF& area, double highest) {
  return {0.0, highest, area.left(), area.right()};
}

}  // namespace

GradientPlot::GradientPlot(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(tr("Histogram of the gradient of φ"));
}

void GradientPlot::set_histogram(const std::optional<solver::GradientHistogram>& histogram) {
  if (histogram == histogram_) return;
  histogram_ = histogram;
  update();
}

void GradientPlot::set_target(double gradient) {
  if (gradient == target_) return;
  target_ = gradient;
  update();
}

void GradientPlot::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double line = fontMetrics().height();
  const QRectF area = QRectF(rect()).adjusted(0.5, line + kSpaceTight, -0.5, -line - 2.0);
  painter.fillRect(area, palette().color(QPalette::Base));
  paint_legend(painter);
  paint_axis(painter, area);
  if (histogram_ && histogram_->band.voxels > 0) paint_bars(painter, area);
  const double x = axis_of(area, kTargets * target_).pixel(target_);
  painter.setPen(QPen(palette().color(QPalette::Text), 1.25, Qt::DashLine));
  painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()));
}

// Both parts on one scale, so that one sees how much of the band is near.
void GradientPlot::paint_bars(QPainter& painter, const QRectF& area) const {
  const auto& counts = histogram_->band.counts;
  const auto most = static_cast<double>(*std::max_element(counts.begin(), counts.end()));
  const double wide = area.width() / solver::GradientHistogram::kBins;
  const QColor strong = palette().color(QPalette::Link);
  QColor light = strong;
  light.setAlpha(kFaint);
  const auto paint = [&](const solver::GradientHistogram::Part& part, const QColor& colour) {
    for (std::size_t bin = 0; bin < part.counts.size(); ++bin) {
      const double high = (area.height() - 3.0) * static_cast<double>(part.counts[bin]) / most;
      painter.fillRect(QRectF(area.left() + wide * static_cast<double>(bin), area.bottom() - high,
                              std::max(wide - 0.75, 1.0), high),
                       colour);
    }
  };
  paint(histogram_->band, light);
  paint(histogram_->near, strong);
}

void GradientPlot::paint_axis(QPainter& painter, const QRectF& area) const {
  const PlotAxis axis = axis_of(area, kTargets * target_);
  painter.setPen(palette().color(QPalette::WindowText));
  for (const double tick : ticks(axis, kGradientTickPixels)) {
    const double x = axis.pixel(tick);
    painter.drawLine(QPointF(x, area.bottom()), QPointF(x, area.bottom() + 2.0));
    QRectF place(x - 0.5 * kGradientTickPixels, area.bottom() + 2.0, kGradientTickPixels,
                 fontMetrics().height());
    Qt::Alignment along = Qt::AlignHCenter;
    if (place.left() < 0.0) {
      place.moveLeft(0.0);
      along = Qt::AlignLeft;
    } else if (place.right() > width()) {
      place.moveRight(width());
      along = Qt::AlignRight;
    }
    painter.drawText(place, along | Qt::AlignTop, general_text(tick, 3));
  }
}

void GradientPlot::paint_legend(QPainter& painter) const {
  QColor light = palette().color(QPalette::Link);
  light.setAlpha(kFaint);
  double left = 0.0;
  const auto entry = [&](const QColor& colour, const QString& text) {
    const double line = fontMetrics().height();
    painter.fillRect(QRectF(left, 0.5 * (line - kBandSwatch), kBandSwatch, kBandSwatch), colour);
    left += kBandSwatch + kSpaceTight;
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(QRectF(left, 0.0, width() - left, line), Qt::AlignLeft | Qt::AlignVCenter, text);
    left += fontMetrics().horizontalAdvance(text) + kSpace;
  };
  entry(palette().color(QPalette::Link), tr("near the surface"));
  entry(light, tr("whole band"));
}

}  // namespace tidemark::ui
