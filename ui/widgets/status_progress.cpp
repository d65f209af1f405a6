#include "ui/widgets/status_progress.h"

#include <QHBoxLayout>
#include <QKeyEvent>
#include <cmath>

namespace tidemark::ui {
namespace {

constexpr int kProgressSteps = 1000;  // of the bar
constexpr int kProgressWidth = 160;

}  // namespace

StatusProgress::StatusProgress(QStatusBar& bar)
    : QWidget(&bar), what_(new QLabel), step_(new QLabel), bar_(new QProgressBar) {
  what_->setTextFormat(Qt::PlainText);
  step_->setTextFormat(Qt::PlainText);
  step_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  bar_->setTextVisible(false);
  bar_->setAccessibleName(tr("Progress"));
  bar_->setFixedWidth(kProgressWidth);
  auto* cancel = new QPushButton(tr("Cancel"));
  connect(cancel, &QPushButton::clicked, this, &StatusProgress::cancelled);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(what_);
  row->addWidget(step_);
  row->addWidget(bar_);
  row->addWidget(cancel);
  hide();
  bar.addPermanentWidget(this);
}

void StatusProgress::follow(engine::ResultJobs& jobs) {
  connect(&jobs, &engine::ResultJobs::progressed, this, &StatusProgress::set_progress);
  connect(this, &StatusProgress::cancelled, &jobs, &engine::ResultJobs::cancel);
}

void StatusProgress::begin(const QString& sentence) {
  setAccessibleName(sentence);
  what_->setText(sentence);
  step_->clear();
  bar_->setRange(0, 0);  // moving: how far is not known yet
  show();
}

void StatusProgress::set_progress(double fraction, const QString& step) {
  step_->setText(step);
  bar_->setRange(0, fraction < 0.0 ? 0 : kProgressSteps);
  bar_->setValue(static_cast<int>(std::lround(fraction * kProgressSteps)));
}

void StatusProgress::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    emit cancelled();
  } else {
    QWidget::keyPressEvent(event);
  }
}

}  // namespace tidemark::ui
