#include "ui/passes/page_map.h"

#include <QPainter>
#include <algorithm>
#include <utility>

#include "ui/look/colour.h"
#include "ui/look/pass_colours.h"
#include "ui/look/theme.h"

namespace tidemark::ui {

PageMap::PageMap(const QString& name, QWidget* parent) : QWidget(parent), name_(name) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  setAccessibleName(name);
}

void PageMap::show_content(Content content) {
  content_ = std::move(content);
  update();
}

void PageMap::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  const int line = fontMetrics().height();
  painter.drawText(QRect(0, 0, width(), line), Qt::AlignHCenter | Qt::AlignVCenter,
                   fontMetrics().elidedText(name_, Qt::ElideRight, width()));
  if (content_.columns == 0) return;
  const int count = static_cast<int>(content_.pages.size());
  const int rows = (count + content_.columns - 1) / content_.columns;
  const QRect area(0, line + kSpaceTight, width(), height() - line - kSpaceTight);
  const double side = std::min({double(area.width()) / content_.columns, double(area.height()) / rows, 16.0});
  const double left = area.x() + 0.5 * (area.width() - side * content_.columns);
  const QColor base = palette().color(QPalette::Base);
  const QColor text = palette().color(QPalette::WindowText);
  const auto square = [&](int page) {
    const int x = page % content_.columns;
    const int y = page / content_.columns;
    const QPoint from(qRound(left + side * x), qRound(area.y() + side * y));
    const QPoint to(qRound(left + side * (x + 1)), qRound(area.y() + side * (y + 1)));
    return QRect(from, to - QPoint(1, 1));
  };
  const int gap = side >= 4.0 ? 1 : 0;
  for (int page = 0; page < count; ++page) {
    QColor colour = base;
    if (content_.pages[static_cast<std::size_t>(page)] == Page::outside)
      colour = mixed(base, kNegativeColour, 0.35);
    if (content_.pages[static_cast<std::size_t>(page)] == Page::inside)
      colour = mixed(base, kPositiveColour, 0.45);
    if (content_.pages[static_cast<std::size_t>(page)] == Page::resident) colour = mixed(base, text, 0.55);
    painter.fillRect(square(page).adjusted(0, 0, -gap, -gap), colour);
  }
  if (content_.chosen < 0) return;
  // Seen among small squares, too.
  painter.setPen(QPen(kPositiveColour, 2.0));
  painter.setBrush(Qt::NoBrush);
  const int grown = side < 8.0 ? 2 : 0;
  painter.drawRect(square(content_.chosen).adjusted(-grown, -grown, grown, grown));
}

}  // namespace tidemark::ui
