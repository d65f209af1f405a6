// A table of names and numbers to be read.
#pragma once

#include <QTableWidget>
#include <vector>

namespace tidemark::ui {

// As high as its rows. The first cell of a row is a name, the others are numbers.
class FigureTable : public QTableWidget {
  Q_OBJECT
 public:
  // `name`: for those who do not see it.
  FigureTable(const QStringList& headings, const QString& name, QWidget* parent = nullptr);

  // A table without rows is not there, nor is its title (null: it has none).
  void fill(const std::vector<QStringList>& lines, QWidget* title = nullptr);

 private:
  void fill_row(int row, const QStringList& cells);
};

}  // namespace tidemark::ui
