// Rows of controls below headings: a small table that is as high as its rows.
#pragma once

#include <QStringList>
#include <QToolButton>
#include <QWidget>
#include <vector>

class QGridLayout;

namespace tidemark::ui {

class RowGrid : public QWidget {
  Q_OBJECT
 public:
  // One heading a column; `wide` is the column that takes what is over: it may be the one behind the last.
  RowGrid(const QStringList& headings, int wide, QWidget* parent = nullptr);

  // Without headings where it is empty.
  void clear();
  void add(const std::vector<QWidget*>& cells);

 private:
  QGridLayout* grid_;
  std::vector<QWidget*> headings_;
  std::vector<QWidget*> cells_;
};

// A small button that takes a row away.
[[nodiscard]] QToolButton* make_remove_button(const QString& name);

}  // namespace tidemark::ui
