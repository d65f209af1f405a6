#include "ui/lessons/lesson_part_view.h"

#include <QButtonGroup>
#include <QEvent>
#include <QGridLayout>
#include <QLabel>
#include <QLineEdit>
#include <QProgressBar>
#include <QPushButton>
#include <QRadioButton>
#include <QVBoxLayout>

#include "ui/lessons/lesson_text.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/number_text.h"

namespace tidemark::ui {
namespace {

constexpr int kProgressRange = 1000;

// Wraps, and shows its text as it is written.
QLabel* plain_label(const QString& text) {
  auto* label = new QLabel(text);
  label->setTextFormat(Qt::PlainText);
  label->setWordWrap(true);
  label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  return label;
}

}  // namespace

LessonPartView::LessonPartView(engine::LessonCourse& course, QWidget* parent)
    : QWidget(parent),
      course_(course),
      part_(course.part()),
      index_(course.index()),
      column_(new QVBoxLayout(this)) {
  column_->setContentsMargins(0, 0, 0, 0);
  column_->setSpacing(kSpace);
  add_heading(lesson_words(part_.title));
  add_text(part_.text);
  if (part_.question) add_question();
  if (part_.attempt) add_try();
  if (!part_.measures.empty()) add_figures();
  add_explanation();
  connect(&course_, &engine::LessonCourse::changed, this, &LessonPartView::follow);
  follow();
}

QLabel* LessonPartView::add_heading(const QString& text) {
  auto* heading = plain_label(text);
  QFont bold = heading->font();
  bold.setBold(true);
  heading->setFont(bold);
  column_->addWidget(heading);
  return heading;
}

QLabel* LessonPartView::add_text(const std::string& text) {
  auto* label = plain_label(lesson_words(text));
  column_->addWidget(label);
  return label;
}

void LessonPartView::add_question() {
  const document::LessonQuestion& question = *part_.question;
  column_->addSpacing(kSpace);
  add_heading(tr("Predict"));
  add_text(question.text);
  if (question.choices.empty()) {
    words_ = new QLineEdit(QString::fromStdString(course_.given().words));
    words_->setMaxLength(static_cast<int>(document::Lesson::kLongestLine));
    words_->setAccessibleName(tr("Your answer"));
    words_->setPlaceholderText(tr("Your answer"));
    column_->addWidget(words_);
    connect(words_, &QLineEdit::textEdited, &course_, &engine::LessonCourse::answer);
    return;
  }
  choices_ = new QButtonGroup(this);
  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(0);
  grid->setVerticalSpacing(kSpaceTight);
  grid->setColumnStretch(1, 1);
  for (std::size_t i = 0; i < question.choices.size(); ++i) {
    const QString text = lesson_words(question.choices[i]);
    const int row = static_cast<int>(i);
    // A radio button's own text does not wrap. A blank one is as high as a line: the mark is beside the
    // first.
    auto* button = new QRadioButton(QStringLiteral(" "));
    button->setAccessibleName(text);
    auto* label = plain_label(text);
    label->setTextInteractionFlags(Qt::NoTextInteraction);
    label->setBuddy(button);
    label->installEventFilter(this);
    choices_->addButton(button, row);
    grid->addWidget(button, row, 0, Qt::AlignTop);
    grid->addWidget(label, row, 1);
    button->setChecked(course_.given().choice == i);
  }
  column_->addLayout(grid);
  connect(choices_, &QButtonGroup::idClicked, &course_,
          [this](int id) { course_.choose(static_cast<std::size_t>(id)); });
}

// A click on a choice's text is one on its button.
bool LessonPartView::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::MouseButtonRelease) {
    auto* label = qobject_cast<QLabel*>(watched);
    auto* button = label ? qobject_cast<QRadioButton*>(label->buddy()) : nullptr;
    if (button && button->isEnabled()) button->click();
  }
  return QWidget::eventFilter(watched, event);
}

void LessonPartView::add_try() {
  column_->addSpacing(kSpace);
  add_heading(tr("Try"));
  auto* row = new QHBoxLayout;
  row->setSpacing(kSpace);
  try_ = new QPushButton(icon(u"play"), tr("Set up and play"));
  try_->setToolTip(
      tr("Gives the case of the lesson its start and parameters, and plays it to the end of the try."));
  stop_ = new QPushButton(tr("Stop"));
  progress_ = new QProgressBar;
  progress_->setRange(0, kProgressRange);
  progress_->setTextVisible(false);
  progress_->setAccessibleName(tr("Progress of the try"));
  row->addWidget(try_);
  row->addWidget(progress_, 1);
  row->addWidget(stop_);
  column_->addLayout(row);
  try_hint_ = plain_label(words_ ? tr("Type an answer first: a prediction counts before the try.")
                                 : tr("Choose an answer first: a prediction counts before the try."));
  column_->addWidget(try_hint_);
  connect(try_, &QPushButton::clicked, &course_, &engine::LessonCourse::attempt);
  connect(stop_, &QPushButton::clicked, &course_, &engine::LessonCourse::stop);
}

void LessonPartView::add_figures() {
  column_->addSpacing(kSpace);
  measure_heading_ = add_heading(tr("Measure"));
  measure_ = new QPushButton(icon(u"statistics"), tr("Measure"));
  measure_->setToolTip(tr("Takes the figures of the surface as it is now."));
  connect(measure_, &QPushButton::clicked, &course_, &engine::LessonCourse::measure);
  column_->addWidget(measure_, 0, Qt::AlignLeft);
  table_ = new QWidget;
  auto* grid = new QGridLayout(table_);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->setHorizontalSpacing(kSpace);
  grid->setVerticalSpacing(kSpaceTight);
  grid->setColumnStretch(0, 1);
  for (std::size_t i = 0; i < part_.measures.size(); ++i) {
    const int row = 2 * static_cast<int>(i);
    const Row made{plain_label({}), plain_label({}), plain_label({})};
    made.value->setWordWrap(false);
    made.verdict->setWordWrap(false);
    grid->addWidget(plain_label(figure_title(part_.measures[i].figure)), row, 0);
    grid->addWidget(made.value, row, 1, Qt::AlignRight);
    grid->addWidget(made.expected, row + 1, 0);
    grid->addWidget(made.verdict, row + 1, 1, Qt::AlignRight);
    made.expected->setText(tr("expected: %1").arg(range_text(part_.measures[i])));
    made.expected->setForegroundRole(QPalette::PlaceholderText);
    rows_.push_back(made);
  }
  column_->addWidget(table_);
}

void LessonPartView::add_explanation() {
  explanation_ = new QWidget;
  auto* column = new QVBoxLayout(explanation_);
  column->setContentsMargins(0, kSpace, 0, 0);
  column->setSpacing(kSpace);
  auto* heading = plain_label(part_.explanation.empty() ? QString() : tr("Why"));
  QFont bold = heading->font();
  bold.setBold(true);
  heading->setFont(bold);
  heading->setVisible(!part_.explanation.empty());
  verdict_ = plain_label({});
  auto* text = plain_label(lesson_words(part_.explanation));
  text->setVisible(!part_.explanation.empty());
  column->addWidget(heading);
  column->addWidget(verdict_);
  column->addWidget(text);
  column_->addWidget(explanation_);
  column_->addStretch(1);
}

void LessonPartView::follow() {
  if (course_.index() != index_) return;  // it goes away
  const bool open = course_.can_answer();
  if (choices_) {
    for (QAbstractButton* button : choices_->buttons()) button->setEnabled(open);
  }
  if (words_) words_->setEnabled(open);
  if (try_) {
    const bool running = course_.attempting();
    try_->setEnabled(course_.can_attempt() || running);  // it keeps the keyboard
    try_->setText(course_.tried(index_) ? tr("Again") : tr("Set up and play"));
    try_hint_->setVisible(!course_.answered(index_));
    progress_->setVisible(running);
    stop_->setVisible(running);
    progress_->setValue(static_cast<int>(kProgressRange * course_.fraction()));
  }
  if (measure_) show_figures();
  explanation_->setVisible(course_.done(index_));
  const QString said = verdict();
  verdict_->setText(said);
  verdict_->setVisible(!said.isEmpty());
}

void LessonPartView::show_figures() {
  measure_->setEnabled(course_.can_measure() || course_.measuring());  // it keeps the keyboard
  const auto& figures = course_.given().figures;
  table_->setVisible(!figures.empty());
  for (std::size_t i = 0; i < rows_.size() && i < figures.size(); ++i) {
    const document::LessonMeasure& measure = part_.measures[i];
    const Row& row = rows_[i];
    row.value->setText(figures[i] ? figure_text(measure.figure, *figures[i]) : kNothing);
    const bool holds = figures[i] && measure.holds(*figures[i]);
    row.verdict->setText(holds ? tr("as expected") : tr("not as expected"));
    QPalette colours = palette();
    if (!holds) colours.setColor(QPalette::WindowText, problem_colour(palette()));
    row.verdict->setPalette(colours);
  }
}

QString LessonPartView::verdict() const {
  if (!part_.question || !part_.question->right) return {};
  const std::string& right = part_.question->choices[*part_.question->right];
  if (course_.given().choice == part_.question->right) return tr("Your prediction was right.");
  return tr("Your prediction was not what happened. Right is: %1").arg(lesson_words(right));
}

}  // namespace tidemark::ui
