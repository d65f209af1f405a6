// The drawing of a row of the history: the tree's lines, a small picture, and words.
#pragma once

#include <QStyledItemDelegate>

namespace tidemark::ui {

// Of rows of a HistoryModel.
class HistoryDelegate : public QStyledItemDelegate {
  Q_OBJECT
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override;
  [[nodiscard]] QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override;
};

}  // namespace tidemark::ui
