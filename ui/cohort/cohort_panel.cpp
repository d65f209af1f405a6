#include "ui/cohort/cohort_panel.h"

#include <QAction>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QPushButton>
#include <QVBoxLayout>

#include "ui/cohort/case_pictures.h"
#include "ui/cohort/cohort_model.h"
#include "ui/look/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/work_line.h"

namespace tidemark::ui {
namespace {

constexpr int kListHeight = 160;      // at least
constexpr int kDetailsHeight = 72;    // at most
constexpr int kLongestComment = 400;  // letters

}  // namespace

CohortPanel::CohortPanel(CohortModel& model, const Actions& actions, QWidget* parent)
    : QWidget(parent), model_(model), accept_action_(actions.accept) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(kSpace, kSpace, kSpace, kSpace);
  column->setSpacing(kSpace);
  summary_ = make_note({});
  column->addWidget(summary_);
  list_ = new QListView;
  list_->setModel(&model_);
  list_->setAccessibleName(tr("Cases of the cohort"));
  list_->setAccessibleDescription(tr("The most unusual first. Return opens a case."));
  list_->setUniformItemSizes(true);
  list_->setTextElideMode(Qt::ElideMiddle);  // names that are UIDs differ at their ends
  list_->setIconSize(QSize(CasePictures::kWidth, CasePictures::kHeight));
  list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  list_->setVerticalScrollMode(QAbstractItemView::ScrollPerPixel);
  list_->setSelectionMode(QAbstractItemView::SingleSelection);
  list_->setEditTriggers(QAbstractItemView::NoEditTriggers);
  list_->setMinimumHeight(kListHeight);
  column->addWidget(list_, 1);
  details_ = make_note({});
  details_->setMaximumHeight(kDetailsHeight);
  column->addWidget(details_);
  comment_ = new QLineEdit;
  comment_->setPlaceholderText(tr("Comment on the case"));
  comment_->setAccessibleName(tr("Comment on the case"));
  comment_->setMaxLength(kLongestComment);
  column->addWidget(comment_);
  for (const auto& [first, second] :
       {std::pair(actions.previous, actions.next), std::pair(actions.accept, actions.reject)}) {
    auto* row = new QHBoxLayout;
    row->setSpacing(kSpace);
    for (QAction* action : {first, second}) {
      QPushButton* button = make_button(action);
      if (action == actions.accept) accept_ = button;
      row->addWidget(button, 1);
    }
    column->addLayout(row);
  }
  work_ = new WorkLine;
  column->addWidget(work_);
  auto* close = new QPushButton(tr("Close the cohort"));
  close->setToolTip(tr("What was said is kept in the cohort's folder."));
  column->addWidget(close);
  connect(close, &QPushButton::clicked, this, &CohortPanel::close_wanted);
  connect(list_, &QListView::activated, this,
          [this](const QModelIndex& index) { emit open_wanted(index.row()); });
  connect(list_->selectionModel(), &QItemSelectionModel::currentChanged, this, &CohortPanel::show_row);
  connect(comment_, &QLineEdit::editingFinished, this, &CohortPanel::keep_comment);
  connect(&model_, &QAbstractItemModel::dataChanged, this,
          [this](const QModelIndex&, const QModelIndex&, const QList<int>& roles) {
            if (roles != QList<int>{Qt::DecorationRole}) summary_->setText(model_.summary());
          });
  summary_->setText(model_.summary());
  set_correction(false);
  show_row();
}

CohortPanel::~CohortPanel() {
  keep_comment();
}

QPushButton* CohortPanel::make_button(QAction* action) {
  auto* button = new QPushButton(action->iconText());
  button->setToolTip(action->toolTip());
  button->setEnabled(action->isEnabled());
  connect(button, &QPushButton::clicked, action, &QAction::trigger);
  connect(action, &QAction::changed, button, [button, action] { button->setEnabled(action->isEnabled()); });
  return button;
}

int CohortPanel::row() const {
  return list_->currentIndex().row();
}

void CohortPanel::choose(int row) {
  list_->setCurrentIndex(model_.index(row));
}

QString CohortPanel::comment() const {
  return comment_->text().trimmed();
}

void CohortPanel::set_correction(bool correction) {
  accept_->setText(correction ? tr("Accept the correction") : accept_action_->iconText());
}

// What was typed for one case is kept before the next is shown.
void CohortPanel::show_row() {
  keep_comment();
  shown_ = row();
  comment_->setEnabled(shown_ >= 0);
  comment_->setText(shown_ >= 0 ? QString::fromStdString(model_.at(shown_).decision.comment) : QString());
  const QString details = shown_ >= 0 ? model_.details(shown_) : QString();
  details_->setText(details);
  details_->setToolTip(details);
  details_->setVisible(!details.isEmpty());
  emit chosen(shown_);
}

void CohortPanel::keep_comment() {
  if (shown_ < 0 || comment() == QString::fromStdString(model_.at(shown_).decision.comment)) return;
  emit commented(shown_, comment());
}

}  // namespace tidemark::ui
