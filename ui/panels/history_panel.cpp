#include "ui/panels/history_panel.h"

#include <QGuiApplication>
#include <QHBoxLayout>
#include <QKeyEvent>
#include <QLabel>
#include <QListView>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/panels/history_delegate.h"
#include "ui/panels/history_model.h"
#include "ui/widgets/form.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr int kHistoryHeight = 160;  // at least

}  // namespace

HistoryPanel::HistoryPanel(QWidget* parent)
    : Panel(tr("Open a study to go back and forth in what is done to it."), parent),
      model_(new HistoryModel(this)) {
  add(make_list());
  add(make_comparison());
  fill_height();
  show_buttons();
}

QWidget* HistoryPanel::make_list() {
  list_ = new QListView;
  list_->setModel(model_);
  list_->setItemDelegate(new HistoryDelegate(list_));
  list_->setAccessibleName(tr("History"));
  list_->setAccessibleDescription(tr("States of the case, the newest first. Return goes to one."));
  list_->setUniformItemSizes(true);
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  list_->setSelectionMode(QAbstractItemView::SingleSelection);
  list_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  list_->setMinimumHeight(kHistoryHeight);
  list_->installEventFilter(this);
  connect(list_, &QListView::clicked, this, &HistoryPanel::clicked);
  connect(list_->selectionModel(), &QItemSelectionModel::currentChanged, this, &HistoryPanel::show_buttons);
  connect(model_, &HistoryModel::modelReset, this, &HistoryPanel::show_buttons);

  auto* part = new QWidget;
  auto* column = new QVBoxLayout(part);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpace);
  column->addWidget(make_note(tr("Click a state to go there: nothing is lost. Ctrl+click compares.")));
  column->addWidget(list_, 1);
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpace);
  go_ = new QPushButton(icon(u"recent"), tr("Go there"));
  go_->setToolTip(tr("The case becomes as it was in the chosen state (Return)."));
  compare_ = new QPushButton(tr("Compare"));
  compare_->setCheckable(true);
  compare_->setToolTip(
      tr("Shows the outline of the chosen state in the slices, and how far the surface is from it (Space)."));
  row->addWidget(go_);
  row->addWidget(compare_);
  column->addLayout(row);
  connect(go_, &QPushButton::clicked, this, &HistoryPanel::go);
  connect(compare_, &QPushButton::clicked, this, &HistoryPanel::compare);
  return part;
}

QWidget* HistoryPanel::make_comparison() {
  comparison_ = new QWidget;
  Form form(comparison_);
  form.heading(tr("Compared with the surface"));
  with_ = form.figure(tr("State"), tr("Its outline is the turquoise one in the slices."));
  dice_ =
      form.figure(tr("Dice"), tr("Twice the common voxels as a part of both: 1 where they are the same."));
  mean_ = form.figure(tr("Mean distance"), tr("From one surface to the other, both ways."));
  largest_ = form.figure(tr("Largest distance"), tr("The farthest that any point of one is from the other "
                                                    "(Hausdorff distance)."));
  comparison_->hide();
  return comparison_;
}

// Ctrl+click compares; any other click goes there.
void HistoryPanel::clicked(const QModelIndex& index) {
  list_->setCurrentIndex(index);
  if (QGuiApplication::keyboardModifiers() & Qt::ControlModifier) {
    const auto item = model_->item(index);
    compare(item && !item->compared);
  } else {
    go();
  }
}

bool HistoryPanel::eventFilter(QObject* watched, QEvent* event) {
  const QEvent::Type type = event->type();
  if (watched != list_ || (type != QEvent::KeyPress && type != QEvent::ShortcutOverride))
    return Panel::eventFilter(watched, event);
  const int key = static_cast<const QKeyEvent*>(event)->key();
  const bool goes = key == Qt::Key_Return || key == Qt::Key_Enter;
  const auto item = model_->item(list_->currentIndex());
  if (!item || (!goes && key != Qt::Key_Space)) return Panel::eventFilter(watched, event);
  event->accept();
  if (type == QEvent::KeyPress && goes) go();
  if (type == QEvent::KeyPress && !goes) compare(!item->compared);
  return true;
}

void HistoryPanel::go() {
  const auto item = model_->item(list_->currentIndex());
  if (proxy() && item && !item->present) proxy()->go_to(item->id);
}

void HistoryPanel::compare(bool on) {
  const auto item = model_->item(list_->currentIndex());
  if (!proxy()) return;
  const bool can = item && !item->open && !item->figures.isEmpty();
  proxy()->comparison().choose(on && can ? std::optional(item->id) : std::nullopt);
  show_buttons();
}

void HistoryPanel::attach() {
  Panel::attach();
  disconnect(compared_);
  followed_ = 0;
  if (!proxy()) {
    model_->clear();
    comparison_->hide();
    return;
  }
  compared_ = connect(&proxy()->comparison(), &engine::StateComparison::changed, this, [this] {
    if (isVisible()) refresh();
  });
}

void HistoryPanel::refresh() {
  const engine::CaseState& state = proxy()->state();
  const auto before = model_->item(list_->currentIndex());
  const std::uint64_t chosen = before ? before->id : 0;
  model_->show(state, proxy()->comparison().state());
  const std::uint64_t present = state.open_change ? state.open_change->id : state.history_state;
  if (followed_ != present) {
    followed_ = present;
    list_->setCurrentIndex(model_->index_of(present));
  } else if (before && !list_->currentIndex().isValid()) {
    list_->setCurrentIndex(model_->index_of(chosen));
  }
  show_buttons();
  show_comparison();
}

void HistoryPanel::show_buttons() {
  const auto item = model_->item(list_->currentIndex());
  go_->setEnabled(item && !item->present);
  compare_->setEnabled(item && !item->open && !item->figures.isEmpty());
  compare_->setChecked(item && item->compared);
}

void HistoryPanel::show_comparison() {
  engine::StateComparison& comparison = proxy()->comparison();
  comparison_->setVisible(comparison.state().has_value());
  if (!comparison.state()) return;
  const auto item = model_->item(model_->index_of(*comparison.state()));
  with_->setText(item ? item->figures : kNothing);
  const auto& agreement = comparison.agreement();
  dice_->setText(agreement ? number_text(agreement->dice, 3) : kNothing);
  const bool apart = agreement && agreement->distance;
  mean_->setText(apart ? number_text(agreement->distance->mean_mm, 2, tr("mm")) : kNothing);
  largest_->setText(apart ? number_text(agreement->distance->largest_mm, 1, tr("mm")) : kNothing);
}

}  // namespace tidemark::ui
