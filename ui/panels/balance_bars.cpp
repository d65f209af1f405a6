#include "ui/panels/balance_bars.h"

#include <QPainter>
#include <QStringList>
#include <algorithm>
#include <cmath>

#include "ui/look/term_colours.h"
#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr int kNumberWidth = 52;  // pixels of the unscaled screen

// "+0.123"
QString signed_text(double value) {
  constexpr int kDecimals = 3;
  const double shown = rounded(value, kDecimals);
  return (shown > 0.0 ? QStringLiteral("+") : QString()) + number_text(shown, kDecimals);
}

}  // namespace

BalanceBars::BalanceBars(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(tr("Pushes of the terms"));
  setToolTip(
      tr("How each term pushes the surface here, in mm per unit of time: to the left inward, to the right "
         "outward. Their sum is how φ changes in the next step."));
}

void BalanceBars::set_place(const std::optional<engine::ExplainedPlace>& place) {
  bars_.clear();
  if (place) {
    const solver::Pushes& pushes = place->balance.pushes;
    const auto add = [&](const QString& name, const QColor& colour, double push) {
      bars_.push_back({name, colour, push * place->spacing_mm});
    };
    add(tr("Data"), kDataColour, pushes.data);
    add(tr("Curvature"), kCurvatureColour, pushes.curvature);
    add(tr("Rescaling"), kRescalingColour, pushes.rescaling);
    if (pushes.advection != 0.0) add(tr("Advection"), kAdvectionColour, pushes.advection);
    if (pushes.limits != 0.0) add(tr("Held by limits"), kLimitsColour, pushes.limits);
    add(tr("Sum"), {}, pushes.sum());
  }
  QStringList texts;
  for (const Bar& bar : bars_) texts << bar.name + ' ' + signed_text(bar.push_mm);
  setAccessibleDescription(texts.join(QStringLiteral(", ")));
  updateGeometry();
  update();
}

int BalanceBars::row_height() const {
  return fontMetrics().height() + kSpaceTight;
}

QSize BalanceBars::sizeHint() const {
  return {240, row_height() * (static_cast<int>(bars_.size()) + 1)};
}
QSize BalanceBars::minimumSizeHint() const {
  return {160, sizeHint().height()};
}

void BalanceBars::paintEvent(QPaintEvent* /*event*/) {
  if (bars_.empty()) return;
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  double largest = 1e-6;
  for (const Bar& bar : bars_) largest = std::max(largest, std::abs(bar.push_mm));
  QRectF row(0.0, row_height(), width(), row_height());
  for (const Bar& bar : bars_) {
    paint_bar(painter, bar, row, largest);
    row.translate(0.0, row.height());
  }
}

void BalanceBars::paint_bar(QPainter& painter, const Bar& bar, const QRectF& row, double largest) const {
  double names = 0.0;
  for (const Bar& each : bars_) names = std::max(names, double(fontMetrics().horizontalAdvance(each.name)));
  const QRectF area = row.adjusted(names + kSpace, 2.0, -kNumberWidth, -2.0);
  const double middle = area.center().x();
  const double half = 0.5 * area.width();
  const bool is_sum = &bar == &bars_.back();
  const QColor text = palette().color(QPalette::WindowText);
  QFont font = painter.font();
  font.setBold(is_sum);
  painter.setFont(font);
  painter.setPen(text);
  painter.drawText(row, Qt::AlignLeft | Qt::AlignVCenter, bar.name);
  painter.drawText(row, Qt::AlignRight | Qt::AlignVCenter, signed_text(bar.push_mm));
  painter.fillRect(area, palette().color(QPalette::Base));
  painter.fillRect(QRectF(middle, area.top(), half * bar.push_mm / largest, area.height()).normalized(),
                   bar.colour.isValid() ? bar.colour : text);
  painter.setPen(QPen(palette().color(QPalette::PlaceholderText), 1.0));
  painter.drawLine(QPointF(middle, row.top()), QPointF(middle, row.bottom()));
  if (&bar != &bars_.front()) return;
  font.setBold(false);
  painter.setFont(font);
  const QRectF above = area.translated(0.0, -row.height());
  painter.drawText(above, Qt::AlignLeft | Qt::AlignVCenter, tr("← inward"));
  painter.drawText(above, Qt::AlignRight | Qt::AlignVCenter, tr("outward →"));
  painter.drawText(QRectF(0.0, 0.0, width(), row.height()), Qt::AlignRight | Qt::AlignVCenter, tr("mm"));
}

}  // namespace tidemark::ui
