#include "ui/panels/history_delegate.h"

#include <QApplication>
#include <QPainter>
#include <algorithm>

#include "ui/look/colour.h"
#include "ui/look/theme.h"
#include "ui/panels/history_model.h"
#include "ui/views/overlay.h"

namespace tidemark::ui {
namespace {

constexpr int kStatePicture = 48;
constexpr int kLaneWidth = 12;
constexpr double kNode = 4.0;  // radius

double lane_middle(const QRect& row, int lane) {
  return row.left() + kSpaceTight + (lane + 0.5) * kLaneWidth;
}

int lanes_width(int lanes) {
  return kSpaceTight + lanes * kLaneWidth;
}

void paint_lanes(QPainter& painter, const QRect& row, const HistoryItem& item, const QPalette& palette) {
  const QPointF node(lane_middle(row, item.lanes.lane), row.center().y() + 0.5);
  const double bottom = row.bottom() + 1.0;
  painter.setPen(QPen(mixed(palette.color(QPalette::Text), palette.color(QPalette::Base), 0.45), 1.5));
  for (const int lane : item.lanes.through) {
    const double x = lane_middle(row, lane);
    painter.drawLine(QPointF(x, row.top()), QPointF(x, bottom));
  }
  for (const int lane : item.lanes.above) {
    const double x = lane_middle(row, lane);
    painter.drawLine(QPointF(x, row.top()), node);
  }
  if (item.lanes.parent_below) painter.drawLine(node, QPointF(node.x(), bottom));
  const QColor text = palette.color(QPalette::Text);
  painter.setPen(QPen(item.compared ? kComparedColour.darker(is_dark(palette) ? 100 : 150) : text, 1.5));
  painter.setBrush(item.present ? text : palette.color(QPalette::Base));
  const double radius = item.present || item.compared ? kNode + 1.0 : kNode;
  if (item.compared) {
    painter.drawRect(QRectF(node.x() - radius, node.y() - radius, 2.0 * radius, 2.0 * radius));
  } else {
    painter.drawEllipse(node, radius, radius);
  }
}

void paint_picture(QPainter& painter, const QRect& where, const HistoryItem& item) {
  if (item.picture.isNull()) return;
  const QSize size = item.picture.size().scaled(where.size(), Qt::KeepAspectRatio);
  QRect centred(QPoint(), size);
  centred.moveCenter(where.center());
  painter.setRenderHint(QPainter::SmoothPixmapTransform);
  painter.drawImage(centred, item.picture);
}

void paint_words(QPainter& painter, const QRect& where, const HistoryItem& item,
                 const QStyleOptionViewItem& option) {
  QFont bold = option.font;
  bold.setBold(item.present);
  bold.setItalic(item.open);
  const bool chosen = option.state & QStyle::State_Selected;
  const QColor text = option.palette.color(chosen ? QPalette::HighlightedText : QPalette::Text);
  const QColor quiet = mixed(text, option.palette.color(chosen ? QPalette::Highlight : QPalette::Base), 0.25);
  QStringList lines{item.change};
  if (!item.figures.isEmpty()) lines << item.figures << item.steering;
  const int height = option.fontMetrics.height();
  int top = where.top() + (where.height() - static_cast<int>(lines.size()) * height) / 2;
  for (qsizetype line = 0; line < lines.size(); ++line) {
    painter.setFont(line == 0 ? bold : option.font);
    painter.setPen(line == 0 ? text : quiet);
    const QFontMetrics metrics(painter.font());
    painter.drawText(QRect(where.left(), top, where.width(), height), Qt::AlignLeft | Qt::AlignVCenter,
                     metrics.elidedText(lines[line], Qt::ElideRight, where.width()));
    top += height;
  }
}

}  // namespace

void HistoryDelegate::paint(QPainter* painter, const QStyleOptionViewItem& option,
                            const QModelIndex& index) const {
  const auto* model = qobject_cast<const HistoryModel*>(index.model());
  const auto item = model ? model->item(index) : std::nullopt;
  if (!item) return;
  QStyleOptionViewItem row = option;
  initStyleOption(&row, index);
  row.text.clear();
  const QWidget* widget = option.widget;
  QStyle* style = widget ? widget->style() : QApplication::style();
  const QRect whole = option.rect;
  const int lanes = lanes_width(model->lanes());
  row.rect.setLeft(whole.left() + lanes);  // lines are seen on the list's own ground
  style->drawControl(QStyle::CE_ItemViewItem, &row, painter, widget);
  painter->save();
  painter->setRenderHint(QPainter::Antialiasing);
  painter->setClipRect(whole);
  paint_lanes(*painter, whole, *item, option.palette);
  const QRect picture(whole.left() + lanes + kSpaceTight, whole.top() + (whole.height() - kStatePicture) / 2,
                      kStatePicture, kStatePicture);
  paint_picture(*painter, picture, *item);
  paint_words(*painter, whole.adjusted(picture.right() + kSpace - whole.left(), 0, -kSpaceTight, 0), *item,
              row);
  painter->restore();
}

QSize HistoryDelegate::sizeHint(const QStyleOptionViewItem& option, const QModelIndex&) const {
  const int words = 3 * option.fontMetrics.height();
  return {kStatePicture + kLaneWidth, std::max(kStatePicture, words) + kSpaceTight};
}

}  // namespace tidemark::ui
