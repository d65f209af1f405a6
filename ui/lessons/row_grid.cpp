#include "ui/lessons/row_grid.h"

#include <QGridLayout>
#include <QLabel>

#include "ui/look/icons.h"
#include "ui/look/theme.h"

namespace tidemark::ui {

RowGrid::RowGrid(const QStringList& headings, int wide, QWidget* parent)
    : QWidget(parent), grid_(new QGridLayout(this)) {
  grid_->setContentsMargins(0, 0, 0, 0);
  grid_->setHorizontalSpacing(kSpace);
  grid_->setVerticalSpacing(kSpaceTight);
  grid_->setColumnStretch(wide, 1);
  for (qsizetype column = 0; column < headings.size(); ++column) {
    auto* heading = new QLabel(headings[column]);
    heading->setForegroundRole(QPalette::PlaceholderText);
    grid_->addWidget(heading, 0, static_cast<int>(column));
    headings_.push_back(heading);
  }
  clear();
}

void RowGrid::clear() {
  for (QWidget* cell : cells_) {
    // A number box speaks once more when it is hidden, and its row is no longer there.
    cell->blockSignals(true);
    for (QWidget* inner : cell->findChildren<QWidget*>()) inner->blockSignals(true);
    // A button in a row may be the one that asked for it.
    cell->setParent(nullptr);
    cell->deleteLater();
  }
  cells_.clear();
  for (QWidget* heading : headings_) heading->hide();
}

void RowGrid::add(const std::vector<QWidget*>& cells) {
  const int row = 1 + static_cast<int>(cells_.size() / headings_.size());
  for (std::size_t column = 0; column < cells.size(); ++column) {
    grid_->addWidget(cells[column], row, static_cast<int>(column));
    cells[column]->show();  // at once, so that it can have the focus
    cells_.push_back(cells[column]);
  }
  for (QWidget* heading : headings_) heading->show();
}

QToolButton* make_remove_button(const QString& name) {
  auto* button = new QToolButton;
  button->setIcon(icon(u"remove"));
  button->setIconSize({kIconSmall, kIconSmall});
  button->setAutoRaise(true);
  button->setFocusPolicy(Qt::StrongFocus);
  button->setToolTip(name);
  button->setAccessibleName(name);
  return button;
}

}  // namespace tidemark::ui
