#include "ui/panels/figure_table.h"

#include <QHeaderView>

#include "ui/look/theme.h"

namespace tidemark::ui {
namespace {

Qt::Alignment alignment_of(int column) {
  return (column == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter;
}

}  // namespace

FigureTable::FigureTable(const QStringList& headings, const QString& name, QWidget* parent)
    : QTableWidget(0, static_cast<int>(headings.size()), parent) {
  setHorizontalHeaderLabels(headings);
  setAccessibleName(name);
  setEditTriggers(QAbstractItemView::NoEditTriggers);
  setSelectionBehavior(QAbstractItemView::SelectRows);
  setTabKeyNavigation(false);
  setShowGrid(false);
  setWordWrap(false);
  setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  verticalHeader()->setDefaultSectionSize(fontMetrics().height() + kSpace);
  verticalHeader()->hide();
  setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  horizontalHeader()->setHighlightSections(false);
  horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
  horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
  for (int column = 0; column < columnCount(); ++column)
    horizontalHeaderItem(column)->setTextAlignment(alignment_of(column));
}

void FigureTable::fill_row(int row, const QStringList& cells) {
  for (int column = 0; column < cells.size(); ++column) {
    QTableWidgetItem* cell = item(row, column);
    if (!cell) {
      cell = new QTableWidgetItem;
      cell->setTextAlignment(alignment_of(column));
      setItem(row, column, cell);
    }
    cell->setText(cells[column]);
    if (column == 0) cell->setToolTip(cells[column]);
  }
}

void FigureTable::fill(const std::vector<QStringList>& lines, QWidget* title) {
  const auto count = static_cast<int>(lines.size());
  if (rowCount() != count) {
    setRowCount(count);
    updateGeometry();
  }
  for (int row = 0; row < count; ++row) fill_row(row, lines[static_cast<std::size_t>(row)]);
  if (title) title->setVisible(count > 0);
  setVisible(count > 0);
}

}  // namespace tidemark::ui
