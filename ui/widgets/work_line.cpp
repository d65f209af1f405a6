#include "ui/widgets/work_line.h"

#include <QHBoxLayout>
#include <cmath>

#include "ui/look/theme.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {
namespace {

constexpr int kSteps = 1000;  // of the bar
constexpr int kBarWidth = 160;

}  // namespace

WorkLine::WorkLine(QWidget* parent)
    : QWidget(parent),
      said_(make_note({})),
      bar_(new QProgressBar(this)),
      cancel_(new QPushButton(tr("Cancel"), this)) {
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpace);
  // The last message must not move the widgets around it.
  setMinimumHeight(std::max(cancel_->sizeHint().height(), 2 * fontMetrics().lineSpacing()));
  said_->setAccessibleName(tr("What is going on"));
  bar_->setTextVisible(false);
  bar_->setAccessibleName(tr("Progress"));
  bar_->setFixedWidth(kBarWidth);
  cancel_->setAutoDefault(false);
  cancel_->setToolTip(tr("Gives it up"));
  connect(cancel_, &QPushButton::clicked, this, &WorkLine::cancelled);
  row->addWidget(said_, 1);
  row->addWidget(bar_);
  row->addWidget(cancel_);
  end({});
}

void WorkLine::begin(const QString& what) {
  said_->setText(what);
  bar_->setRange(0, 0);  // moving: how far is not known yet
  bar_->show();
  cancel_->show();
}

void WorkLine::set_progress(double fraction, const QString& step) {
  said_->setText(step);
  bar_->setRange(0, fraction < 0.0 ? 0 : kSteps);
  bar_->setValue(static_cast<int>(std::lround(fraction * kSteps)));
}

void WorkLine::end(const QString& said) {
  said_->setText(said);
  bar_->hide();
  cancel_->hide();
}

}  // namespace tidemark::ui
