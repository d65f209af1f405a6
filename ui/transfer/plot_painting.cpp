#include "ui/transfer/plot_painting.h"

#include <algorithm>
#include <cmath>

#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr double kTick = 4.0;
constexpr double kTickGap = 3.0;

// Sharp at any scale: a line in the middle of a pixel.
double crisp(double pixel) {
  return std::floor(pixel) + 0.5;
}

QString tick_text(double value) {
  return general_text(value, 6);
}

// `text` in superscript digits.
QString power_of_ten(int exponent) {
  if (exponent == 0) return QStringLiteral("1");
  if (exponent == 1) return QStringLiteral("10");
  static const char16_t kDigits[] = u"⁰¹²³⁴⁵⁶⁷⁸⁹";
  QString text = QStringLiteral("10");
  for (const QChar digit : QString::number(exponent)) text += QChar(kDigits[digit.digitValue()]);
  return text;
}

void draw_side_title(QPainter& painter, double x, const QRectF& area, const QString& title) {
  painter.save();
  painter.translate(x, area.center().y());
  painter.rotate(-90.0);
  const double height = painter.fontMetrics().height();
  painter.drawText(QRectF(-area.height() / 2.0, 0.0, area.height(), height), Qt::AlignCenter, title);
  painter.restore();
}

}  // namespace

QFont axis_font(const QFont& font) {
  QFont smaller = font;
  if (font.pointSizeF() > 0.0) {
    smaller.setPointSizeF(font.pointSizeF() * 0.85);
  } else {
    smaller.setPixelSize(std::max(9, static_cast<int>(font.pixelSize() * 0.85)));
  }
  return smaller;
}

PlotMargins plot_margins(const QFontMetrics& metrics, bool with_counts) {
  const int side = static_cast<int>(kTick + kTickGap) + metrics.height() + 2;
  return {side + metrics.horizontalAdvance(QStringLiteral("0.001")),
          with_counts ? side + metrics.horizontalAdvance(QStringLiteral("10⁸")) : metrics.height(),
          metrics.height() / 2 + 2, static_cast<int>(kTick + kTickGap) + 2 * metrics.height() + 2};
}

void draw_bottom_axis(QPainter& painter, const QRectF& area, const PlotAxis& axis, const QString& title,
                      const QColor& colour) {
  painter.setPen(QPen(colour, 1.0));
  const QFontMetricsF metrics(painter.font());
  for (const double value : ticks(axis, 4.5 * metrics.averageCharWidth() + 24.0)) {
    const double x = crisp(axis.pixel(value));
    painter.drawLine(QPointF(x, area.bottom()), QPointF(x, area.bottom() + kTick));
    const QString text = tick_text(value);
    const double width = metrics.horizontalAdvance(text) + 2.0;
    const double left = std::clamp(x - width / 2.0, 0.0, painter.window().width() - width);
    painter.drawText(QRectF(left, area.bottom() + kTick, width, metrics.height()), Qt::AlignCenter, text);
  }
  const QRectF line(area.left(), area.bottom() + kTick + metrics.height(), area.width(), metrics.height());
  painter.drawText(line, Qt::AlignCenter, title);
}

void draw_left_axis(QPainter& painter, const QRectF& area, const PlotAxis& axis, const QString& title,
                    const QColor& colour) {
  painter.setPen(QPen(colour, 1.0));
  const QFontMetricsF metrics(painter.font());
  for (const double value :
       ticks(axis, axis.power == 1.0 ? 2.5 * metrics.height() : metrics.height() + 4.0)) {
    const double y = crisp(axis.pixel(value));
    painter.drawLine(QPointF(area.left() - kTick, y), QPointF(area.left(), y));
    const QRectF room(0.0, y - metrics.height() / 2.0, area.left() - kTick - kTickGap, metrics.height());
    painter.drawText(room, Qt::AlignRight | Qt::AlignVCenter, tick_text(value));
  }
  draw_side_title(painter, 0.0, area, title);
}

void draw_count_axis(QPainter& painter, const QRectF& area, double most, const QString& title,
                     const QColor& colour) {
  painter.setPen(QPen(colour, 1.0));
  const QFontMetricsF metrics(painter.font());
  const int highest = static_cast<int>(std::floor(std::log10(std::max(1.0, most))));
  const double decade = area.height() * std::log(10.0) / std::log1p(std::max(1.0, most));
  const int every = std::max(1, static_cast<int>(std::ceil((metrics.height() + 6.0) / decade)));
  for (int exponent = 0; exponent <= highest; exponent += every) {
    const double share = std::log1p(std::pow(10.0, exponent)) / std::log1p(std::max(1.0, most));
    const double y = crisp(area.bottom() - share * area.height());
    painter.drawLine(QPointF(area.right(), y), QPointF(area.right() + kTick, y));
    const QRectF room(area.right() + kTick + kTickGap, y - metrics.height() / 2.0, 100.0, metrics.height());
    painter.drawText(room, Qt::AlignLeft | Qt::AlignVCenter, power_of_ten(exponent));
  }
  draw_side_title(painter, painter.window().width() - metrics.height(), area, title);
}

void draw_handle(QPainter& painter, QPointF at, HandleShape shape, HandleState state,
                 const QPalette& palette) {
  const double radius = state == HandleState::plain ? 4.5 : 6.0;
  const bool selected = state == HandleState::selected;
  painter.setPen(QPen(palette.color(QPalette::Text), selected ? 2.5 : 1.5));
  painter.setBrush(palette.color(selected ? QPalette::Highlight : QPalette::Base));
  const QRectF box(at.x() - radius, at.y() - radius, 2.0 * radius, 2.0 * radius);
  if (shape == HandleShape::round) {
    painter.drawEllipse(box);
  } else {
    painter.drawRect(box);
  }
}

void draw_number(QPainter& painter, QPointF at, int number, bool chosen, const QPalette& palette) {
  const QString text = QString::number(number);
  const QFontMetricsF metrics(painter.font());
  const double height = metrics.height() + 2.0;
  const QRectF box(at.x() - height / 2.0, at.y() - height / 2.0, height, height);
  painter.setPen(QPen(palette.color(QPalette::Text), chosen ? 2.0 : 1.0));
  painter.setBrush(palette.color(QPalette::Base));
  painter.drawRoundedRect(box, 3.0, 3.0);
  painter.drawText(box, Qt::AlignCenter, text);
}

void draw_read_out(QPainter& painter, const QRectF& area, const QString& text, const QPalette& palette) {
  const QFontMetricsF metrics(painter.font());
  const double width = metrics.horizontalAdvance(text) + 12.0;
  const QRectF box(area.right() - width - 4.0, area.top() + 4.0, width, metrics.height() + 4.0);
  painter.setPen(QPen(palette.color(QPalette::Mid), 1.0));
  painter.setBrush(palette.color(QPalette::Window));
  painter.drawRoundedRect(box, 3.0, 3.0);
  painter.setPen(palette.color(QPalette::WindowText));
  painter.drawText(box, Qt::AlignCenter, text);
}

}  // namespace tidemark::ui
