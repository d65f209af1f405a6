#include "ui/opening/loading_view.h"

#include <QBoxLayout>
#include <QKeyEvent>
#include <cmath>

namespace tidemark::ui {
namespace {

constexpr int kLoadingSteps = 1000;  // of the bar
constexpr int kCardWidth = 380;
constexpr int kLineBarWidth = 160;

}  // namespace

LoadingView::LoadingView(Shape shape, QWidget* parent)
    : QFrame(parent),
      what_(new QLabel(this)),
      step_(new QLabel(this)),
      bar_(new QProgressBar(this)),
      button_(new QPushButton(this)) {
  setAccessibleName(tr("Loading"));
  what_->setTextFormat(Qt::PlainText);
  step_->setTextFormat(Qt::PlainText);
  step_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  bar_->setTextVisible(false);
  bar_->setAccessibleName(tr("Progress of loading"));
  connect(button_, &QPushButton::clicked, this, &LoadingView::press);
  if (shape == Shape::line) {
    auto* row = new QHBoxLayout(this);
    row->setContentsMargins(0, 0, 0, 0);
    bar_->setFixedWidth(kLineBarWidth);
    for (QWidget* part : {static_cast<QWidget*>(what_), static_cast<QWidget*>(step_),
                          static_cast<QWidget*>(bar_), static_cast<QWidget*>(button_)}) {
      row->addWidget(part);
    }
  } else {
    setFrameShape(QFrame::StyledPanel);
    setMinimumWidth(kCardWidth);
    step_->setWordWrap(true);
    QFont bold = what_->font();
    bold.setWeight(QFont::DemiBold);
    what_->setFont(bold);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(18, 16, 18, 16);
    column->setSpacing(8);
    column->addWidget(what_);
    column->addWidget(step_);
    column->addWidget(bar_);
    column->addWidget(button_, 0, Qt::AlignRight);
  }
  begin({});
}

void LoadingView::begin(const QString& what) {
  failed_ = false;
  what_->setText(what.isEmpty() ? tr("Opening a study") : tr("Opening %1").arg(what));
  step_->clear();
  bar_->setRange(0, 0);  // moving: how far is not known yet
  bar_->show();
  button_->setText(tr("Cancel"));
  button_->setAccessibleName(tr("Cancel loading"));
}

void LoadingView::set_progress(double fraction, const QString& step) {
  if (failed_) return;
  step_->setText(step);
  bar_->setRange(0, fraction < 0.0 ? 0 : kLoadingSteps);
  bar_->setValue(static_cast<int>(std::lround(fraction * kLoadingSteps)));
}

void LoadingView::fail(const QString& message) {
  failed_ = true;
  what_->setText(tr("The study cannot be opened"));
  step_->setText(message);
  step_->setToolTip(message);
  bar_->hide();
  button_->setText(tr("Close"));
  button_->setAccessibleName(tr("Close this message"));
}

void LoadingView::press() {
  if (failed_) {
    emit closed();
  } else {
    emit cancelled();
  }
}

void LoadingView::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) {
    press();
  } else {
    QFrame::keyPressEvent(event);
  }
}

}  // namespace tidemark::ui
