#include "ui/readers/reader_table.h"

#include <QHeaderView>
#include <limits>

#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

// Sorted by its value, not by its text.
class NumberItem : public QTableWidgetItem {
 public:
  NumberItem(const std::optional<double>& value, int decimals)
      : QTableWidgetItem(value ? number_text(*value, decimals) : kNothing),
        value_(value.value_or(std::numeric_limits<double>::infinity())) {
    setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  }
  bool operator<(const QTableWidgetItem& other) const override {
    return value_ < static_cast<const NumberItem&>(other).value_;
  }

 private:
  double value_;
};

}  // namespace

ReaderTable::ReaderTable(const std::vector<Column>& columns, const QString& name, int sorted_by,
                         QWidget* parent)
    : QTableWidget(0, static_cast<int>(columns.size()), parent), columns_(columns) {
  for (int column = 0; column < columnCount(); ++column) {
    const Column& is = columns_[static_cast<std::size_t>(column)];
    auto* heading = new QTableWidgetItem(is.heading);
    heading->setToolTip(is.tip);
    setHorizontalHeaderItem(column, heading);
    horizontalHeader()->setSectionResizeMode(
        column, is.decimals ? QHeaderView::ResizeToContents : QHeaderView::Stretch);
  }
  setAccessibleName(name);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setSelectionBehavior(QAbstractItemView::SelectRows);
  setSelectionMode(QAbstractItemView::SingleSelection);
  setTabKeyNavigation(false);
  setShowGrid(false);
  setWordWrap(false);
  verticalHeader()->setDefaultSectionSize(fontMetrics().height() + kSpace);
  verticalHeader()->hide();
  horizontalHeader()->setHighlightSections(false);
  sortByColumn(sorted_by, Qt::AscendingOrder);
  setSortingEnabled(true);
}

void ReaderTable::add_row(const QStringList& names, const std::vector<std::optional<double>>& numbers) {
  setSortingEnabled(false);  // a row must not move before it is filled
  const int row = rowCount();
  insertRow(row);
  int column = 0;
  for (const QString& name : names) {
    auto* item = new QTableWidgetItem(name);
    item->setToolTip(name);
    setItem(row, column++, item);
  }
  for (const std::optional<double>& number : numbers) {
    setItem(row, column,
            new NumberItem(number, columns_[static_cast<std::size_t>(column)].decimals.value_or(0)));
    ++column;
  }
  setSortingEnabled(true);
}

}  // namespace tidemark::ui
