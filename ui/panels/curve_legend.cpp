#include "ui/panels/curve_legend.h"

#include <QPainter>

#include "ui/look/theme.h"
#include "ui/panels/curve_plot.h"

namespace tidemark::ui {
namespace {

constexpr int kLineSwatch = 22;

}  // namespace

CurveLegend::CurveLegend(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void CurveLegend::set_predicted(const QString& name) {
  if (predicted_ == name) return;
  predicted_ = name;
  setAccessibleName(tr("Dashed: predicted by %1").arg(name));
  updateGeometry();
  update();
}

QSize CurveLegend::sizeHint() const {
  return {240, fontMetrics().height() + kSpaceTight};
}

void CurveLegend::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const double middle = 0.5 * height();
  double left = 0.0;
  const auto entry = [&](const QPen& pen, const QString& text) {
    painter.setPen(pen);
    painter.drawLine(QPointF(left, middle), QPointF(left + kLineSwatch, middle));
    left += kLineSwatch + kSpaceTight;
    painter.setPen(palette().color(QPalette::WindowText));
    const QString shown = fontMetrics().elidedText(text, Qt::ElideRight, width() - static_cast<int>(left));
    painter.drawText(QRectF(left, 0.0, width() - left, height()), Qt::AlignLeft | Qt::AlignVCenter, shown);
    left += fontMetrics().horizontalAdvance(shown) + kSpaceGroups;
  };
  entry(CurvePlot::measured_pen(palette()), tr("measured"));
  entry(CurvePlot::predicted_pen(palette()), predicted_);
}

}  // namespace tidemark::ui
