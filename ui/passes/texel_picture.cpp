#include "ui/passes/texel_picture.h"

#include <QHelpEvent>
#include <QPainter>
#include <QToolTip>
#include <algorithm>
#include <cmath>
#include <utility>

#include "ui/look/colour.h"
#include "ui/look/pass_colours.h"
#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr double kRounding = 1e-6;  // what is smaller is rounding

constexpr double kSmallestCaption = 0.6;  // of captions

// In which a caption is as wide as its picture at most: words of other languages are longer.
QFont fitting(QFont font, const QStringList& pieces, int width) {
  const auto fits = [&](const QString& piece) {
    return QFontMetrics(font).horizontalAdvance(piece) <= width;
  };
  const double smallest = kSmallestCaption * font.pointSizeF();
  // By steps: drawn sizes are whole pixels.
  while (font.pointSizeF() > smallest && !std::all_of(pieces.begin(), pieces.end(), fits))
    font.setPointSizeF(font.pointSizeF() - 0.5);
  return font;
}

}  // namespace

QFont caption_font(QFont font) {
  font.setPointSizeF(0.85 * font.pointSizeF());
  return font;
}

double round_range(const std::vector<float>& values) {
  double largest = 0.0;
  for (const float value : values) {
    if (std::isfinite(value)) largest = std::max(largest, std::abs(double(value)));
  }
  if (largest <= kRounding) return kRounding;
  const double power = std::pow(10.0, std::floor(std::log10(largest)));
  for (const double digit : {1.0, 2.0, 5.0}) {
    if (largest <= digit * power * (1.0 + 1e-6)) return digit * power;
  }
  return 10.0 * power;
}

TexelPicture::TexelPicture(const QString& name, int side, QWidget* parent)
    : QWidget(parent), name_(name), side_(side) {
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  setAccessibleName(name);
}

void TexelPicture::show_content(Content content) {
  content_ = std::move(content);
  setAccessibleDescription(range_text());
  update();
}

void TexelPicture::clear() {
  show_content({});
}

QSize TexelPicture::sizeHint() const {
  const int lines = is_narrow() ? 2 : 1;
  return {side_, side_ + lines * QFontMetrics(caption_font(font())).height() + kSpaceTight};
}

QRect TexelPicture::cell(int x, int y) const {
  const auto edge = [this](int at, int count) { return side_ * at / count; };
  const int left = edge(x, content_.columns);
  const int top = edge(y, content_.rows);
  return {left, top, edge(x + 1, content_.columns) - left, edge(y + 1, content_.rows) - top};
}

bool TexelPicture::is_border(int x, int y) const {
  const int border = content_.border;
  return x < border || y < border || x >= content_.columns - border || y >= content_.rows - border;
}

QColor TexelPicture::colour_of(float value) const {
  if (content_.is_of_substreams) return kSubstreamColours[std::lround(value)];
  const double share = std::clamp(std::abs(value) / content_.range, 0.0, 1.0);
  return mixed(palette().color(QPalette::Base), value < 0.0F ? kNegativeColour : kPositiveColour, share);
}

QString TexelPicture::range_text() const {
  if (content_.values.empty() || content_.is_of_substreams || !content_.names_range) return {};
  return content_.range > kRounding ? QStringLiteral("±") + short_text(content_.range, 2)
                                    : QStringLiteral("0");
}

void TexelPicture::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  const QRect area(0, 0, side_, side_);
  painter.fillRect(area, palette().color(QPalette::Window));
  const QColor window = palette().color(QPalette::Window);
  for (int y = 0; y < content_.rows; ++y) {
    for (int x = 0; x < content_.columns; ++x) {
      if (!std::isfinite(value(x, y))) continue;
      const QColor colour = colour_of(value(x, y));
      painter.fillRect(cell(x, y), is_border(x, y) ? mixed(window, colour, 0.45) : colour);
    }
  }
  if (content_.zero_line) paint_zero_line(painter);
  painter.setPen(palette().color(QPalette::Mid));
  painter.drawRect(area.adjusted(0, 0, -1, -1));
  if (content_.border > 0 && content_.columns > 0) {
    painter.setPen(QPen(palette().color(QPalette::WindowText), 1.0));
    const int last_x = content_.columns - 1 - content_.border;
    const int last_y = content_.rows - 1 - content_.border;
    painter.drawRect(
        cell(content_.border, content_.border).united(cell(last_x, last_y)).adjusted(0, 0, -1, -1));
  }
  painter.setPen(palette().color(QPalette::WindowText));
  const QRect below(0, side_ + kSpaceTight / 2, side_, height() - side_);
  const QString range = range_text();
  const QString text = range.isEmpty() ? name_ : name_ + (is_narrow() ? "\n" : "  ") + range;
  const bool wraps = is_narrow() && range.isEmpty();
  const int flags = Qt::AlignHCenter | Qt::AlignTop | (wraps ? Qt::TextWordWrap : 0);
  painter.setFont(fitting(caption_font(font()), text.split(wraps ? u' ' : u'\n'), side_));
  painter.drawText(below, flags, text);
}

void TexelPicture::paint_zero_line(QPainter& painter) const {
  painter.setPen(QPen(palette().color(QPalette::WindowText), 2.0));
  for (int y = 0; y < content_.rows; ++y) {
    for (int x = 0; x < content_.columns; ++x) {
      const QRect here = cell(x, y);
      const bool inside = value(x, y) > 0.0F;
      const auto crosses = [&](int i, int j) {
        return i < content_.columns && j < content_.rows && std::isfinite(value(x, y)) &&
               std::isfinite(value(i, j)) && (value(i, j) > 0.0F) != inside;
      };
      const QPoint corner(here.x() + here.width(), here.y() + here.height());
      if (crosses(x + 1, y)) painter.drawLine(corner.x(), here.y(), corner.x(), corner.y());
      if (crosses(x, y + 1)) painter.drawLine(here.x(), corner.y(), corner.x(), corner.y());
    }
  }
}

// The value under the mouse.
bool TexelPicture::event(QEvent* event) {
  if (event->type() != QEvent::ToolTip) return QWidget::event(event);
  const auto* help = static_cast<const QHelpEvent*>(event);
  for (int y = 0; y < content_.rows; ++y) {
    for (int x = 0; x < content_.columns; ++x) {
      if (!cell(x, y).contains(help->pos()) || !std::isfinite(value(x, y))) continue;
      const QString where = content_.place ? content_.place(x, y) : QString();
      const QString what =
          content_.is_of_substreams ? name_ : QStringLiteral("%1 %2").arg(name_, short_text(value(x, y), 4));
      QToolTip::showText(help->globalPos(), where.isEmpty() ? what : where + QStringLiteral(": ") + what,
                         this);
      return true;
    }
  }
  QToolTip::hideText();
  return true;
}

}  // namespace tidemark::ui
