#include "ui/lessons/lesson_panel.h"

#include <QComboBox>
#include <QCoreApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QVBoxLayout>
#include <utility>

#include "ui/lessons/hand_in_box.h"
#include "ui/lessons/lesson_part_view.h"
#include "ui/lessons/lesson_text.h"
#include "ui/look/theme.h"
#include "ui/widgets/form.h"
#include "ui/widgets/relative_font.h"

namespace tidemark::ui {
namespace {

constexpr double kTitleSize = 1.3;  // of the font

// What was just shown has no place yet.
void give_places() {
  QCoreApplication::sendPostedEvents(nullptr, QEvent::LayoutRequest);
}

}  // namespace

LessonPanel::LessonPanel(engine::LessonCourse& course, QWidget* parent) : QWidget(parent), course_(course) {
  auto* column = new QVBoxLayout(this);
  column->setContentsMargins(kSpace, kSpace, kSpace, kSpace);
  column->setSpacing(kSpace);
  column->addWidget(make_head());
  scroll_ = new QScrollArea;
  scroll_->setWidgetResizable(true);
  scroll_->setFrameShape(QFrame::NoFrame);
  scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  column->addWidget(scroll_, 1);
  message_ = make_note({});
  message_->hide();
  column->addWidget(message_);
  column->addWidget(make_foot());
  connect(&course_, &engine::LessonCourse::changed, this, &LessonPanel::follow);
  connect(&course_, &engine::LessonCourse::failed, this, [this](const QString& message) {
    message_->setText(message);
    message_->show();
  });
  show_part();
  follow();
}

QWidget* LessonPanel::make_head() {
  auto* head = new QWidget;
  auto* column = new QVBoxLayout(head);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpace);
  auto* title = new QLabel(lesson_words(course_.lesson().title));
  title->setTextFormat(Qt::PlainText);
  title->setWordWrap(true);
  set_relative_font(*title, kTitleSize, QFont::Bold);
  parts_ = new QComboBox;
  parts_->setAccessibleName(tr("Parts of the lesson"));
  parts_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
  for (const document::LessonPart& part : course_.lesson().parts) {
    parts_->addItem(lesson_words(part.title));
  }
  column->addWidget(title);
  column->addWidget(parts_);
  connect(parts_, &QComboBox::activated, &course_,
          [this](int index) { course_.go_to(static_cast<std::size_t>(index)); });
  return head;
}

QWidget* LessonPanel::make_foot() {
  auto* foot = new QWidget;
  auto* row = new QHBoxLayout(foot);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(kSpace);
  back_ = new QPushButton(tr("Back"));
  next_ = new QPushButton(tr("Next"));
  auto* end = new QPushButton(tr("End lesson"));
  end->setToolTip(tr("Closes the lesson. Its cases stay open; answers that were not saved are lost."));
  row->addWidget(back_);
  row->addWidget(next_);
  row->addStretch(1);
  row->addWidget(end);
  connect(back_, &QPushButton::clicked, &course_, [this] { course_.go_to(course_.index() - 1); });
  connect(next_, &QPushButton::clicked, &course_, [this] { course_.go_to(course_.index() + 1); });
  connect(end, &QPushButton::clicked, this, &LessonPanel::end_wanted);
  return foot;
}

void LessonPanel::show_part() {
  auto* content = new QWidget;
  auto* column = new QVBoxLayout(content);
  column->setContentsMargins(0, 0, kSpace, 0);
  view_ = new LessonPartView(course_);
  column->addWidget(view_);
  const bool last = course_.index() + 1 == course_.lesson().parts.size();
  if (last) {
    auto* hand_in = new HandInBox(course_);
    column->addWidget(hand_in);
    connect(hand_in, &HandInBox::said, this, [this] {
      give_places();
      scroll_->verticalScrollBar()->setValue(scroll_->verticalScrollBar()->maximum());
    });
  }
  column->addStretch(1);
  scroll_->setWidget(content);  // deletes the one before
  scroll_->verticalScrollBar()->setValue(0);
  message_->hide();
  was_done_ = course_.done(course_.index());
}

// What has just appeared would be below the panel's end.
void LessonPanel::show_outcome() {
  give_places();
  scroll_->verticalScrollBar()->setValue(view_->outcome()->mapTo(scroll_->widget(), QPoint()).y());
}

void LessonPanel::follow() {
  if (view_->index() != course_.index()) show_part();
  if (!std::exchange(was_done_, course_.done(course_.index())) && was_done_)
    QMetaObject::invokeMethod(this, &LessonPanel::show_outcome, Qt::QueuedConnection);
  const std::size_t count = course_.lesson().parts.size();
  for (std::size_t i = 0; i < count; ++i) {
    const QString title = lesson_words(course_.lesson().parts[i].title);
    const QString done = course_.done(i) ? tr(" (done)") : QString();
    parts_->setItemText(static_cast<int>(i), tr("%1 of %2: %3").arg(i + 1).arg(count).arg(title) + done);
  }
  parts_->setCurrentIndex(static_cast<int>(course_.index()));
  back_->setEnabled(course_.index() > 0);
  next_->setEnabled(course_.index() + 1 < count);
  next_->setDefault(course_.done(course_.index()));
}

}  // namespace tidemark::ui
