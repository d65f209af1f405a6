// A table of names and numbers whose columns can be sorted by.
#pragma once

#include <QTableWidget>
#include <optional>
#include <vector>

namespace tidemark::ui {

// Names stand in the first columns, numbers in the others.
class ReaderTable : public QTableWidget {
  Q_OBJECT
 public:
  struct Column {
    QString heading;
    QString tip;
    std::optional<int> decimals = {};  // of a number; unset: names, which share the room that is left
  };
  // `name`: for those who do not see it. `sorted_by`: the column that is sorted by first, upwards.
  ReaderTable(const std::vector<Column>& columns, const QString& name, int sorted_by,
              QWidget* parent = nullptr);

  // Numbers are written as the user's language does. One that is not known stands behind all others.
  void add_row(const QStringList& names, const std::vector<std::optional<double>>& numbers);

 private:
  std::vector<Column> columns_;
};

}  // namespace tidemark::ui
