#include "ui/passes/pass_card.h"

#include <QGridLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <algorithm>

#include "ui/look/theme.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {
namespace {

constexpr int kMostColumns = 3;

}  // namespace

PassCard::PassCard(const QString& title, const QString& figure, const QString& sentence, QWidget* parent)
    : QFrame(parent), column_(new QVBoxLayout(this)) {
  setFrameShape(QFrame::StyledPanel);
  column_->setContentsMargins(kSpace, kSpace, kSpace, kSpace);
  column_->setSpacing(kSpaceTight);
  auto* head = new QHBoxLayout;
  auto* name = new QLabel(title);
  QFont bold = name->font();
  bold.setBold(true);
  name->setFont(bold);
  auto* source = new QLabel(figure);
  source->setForegroundRole(QPalette::PlaceholderText);
  source->setToolTip(tr("In Lefohn, Kniss, Hansen and Whitaker, A Streaming Narrow-Band Algorithm (2004)"));
  head->addWidget(name, 1);
  head->addWidget(source);
  column_->addLayout(head);
  column_->addWidget(make_note(sentence));
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Maximum);
}

void PassCard::add(QWidget* widget) {
  column_->addWidget(widget);
}
void PassCard::add(QLayout* layout) {
  column_->addLayout(layout);
}

QLabel* PassCard::add_line() {
  auto* line = make_note({});
  column_->addWidget(line);
  return line;
}

CardColumns::CardColumns(QWidget* parent) : QWidget(parent), grid_(new QGridLayout(this)) {
  grid_->setContentsMargins(kSpace, kSpace, kSpace, kSpace);
  grid_->setSpacing(kSpace);
}

void CardColumns::add(PassCard* card) {
  cards_ << card;
  columns_ = 0;
  arrange();
}

void CardColumns::resizeEvent(QResizeEvent* event) {
  QWidget::resizeEvent(event);
  arrange();
}

// Column by column, in the order of the steps.
void CardColumns::arrange() {
  const int fit = std::clamp((width() - kSpace) / (PassCard::kWidth + kSpace), 1, kMostColumns);
  if (fit == columns_) return;
  columns_ = fit;
  while (QLayoutItem* item = grid_->takeAt(0)) {
    if (item->layout() != nullptr) {
      while (QLayoutItem* inner = item->layout()->takeAt(0)) delete inner;
    }
    delete item;
  }
  const auto in_column = static_cast<int>((cards_.size() + fit - 1) / fit);
  for (int column = 0; column < kMostColumns; ++column) {
    grid_->setColumnStretch(column, column < fit ? 1 : 0);
    if (column >= fit) continue;
    auto* stack = new QVBoxLayout;
    stack->setSpacing(kSpace);
    for (int i = in_column * column;
         i < std::min<int>(in_column * (column + 1), static_cast<int>(cards_.size())); ++i)
      stack->addWidget(cards_[i]);
    stack->addStretch(1);
    grid_->addLayout(stack, 0, column);
  }
}

}  // namespace tidemark::ui
