#include "ui/lessons/lesson_form.h"

#include <QHBoxLayout>
#include <QPushButton>
#include <cmath>

#include "engine/message_text.h"
#include "ui/lessons/text_box.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {
namespace {

constexpr int kAboutLines = 3;
constexpr double kMostMinutes = 1000.0;

}  // namespace

LessonForm::LessonForm(QWidget* parent) : QWidget(parent) {
  auto* column = new QVBoxLayout(this);
  auto* rows = new QWidget;
  Form form(rows);
  column->setContentsMargins(kSpace, kSpace, kSpace, kSpace);
  column->addWidget(rows);
  column->addStretch(1);
  add_words(form);
  add_setting(form);
}

void LessonForm::add_words(Form& form) {
  title_ = new QLineEdit;
  about_ = make_text_box(kAboutLines);
  author_ = new QLineEdit;
  minutes_ = make_number_box(0.0, kMostMinutes, 0);
  minutes_->setSpecialValueText(tr("not said"));
  minutes_->setSuffix(tr(" min"));
  minutes_->setSizePolicy(QSizePolicy::Maximum, QSizePolicy::Fixed);
  form.row(tr("Title"), title_, tr("By which students find the lesson."));
  form.row(tr("About"), about_, tr("One sentence on what is learnt."));
  form.row(tr("Author"), author_, tr("Who has written it; may be empty."));
  form.row(tr("Time needed"), minutes_, tr("Minutes that a student needs; 0: not said."));
  connect(title_, &QLineEdit::textEdited, this, [this](const QString& typed) {
    lesson_->title = typed.toStdString();
    emit edited();
  });
  connect(about_, &QPlainTextEdit::textChanged, this, [this] {
    lesson_->about = about_->toPlainText().toStdString();
    emit edited();
  });
  connect(author_, &QLineEdit::textEdited, this, [this](const QString& typed) {
    lesson_->author = typed.toStdString();
    emit edited();
  });
  connect(minutes_, &NumberBox::valueChanged, this, [this](double value) {
    lesson_->minutes = static_cast<int>(std::lround(value));
    emit edited();
  });
}

void LessonForm::add_setting(Form& form) {
  study_ = new StudyChoice;
  form.heading(tr("Study"));
  form.wide(study_);
  form.heading(tr("Level set"));
  auto* take = new QPushButton(icon(u"target"), tr("&Take from the case"));
  take->setAutoDefault(false);
  take->setToolTip(tr("The active case's study, start and parameters become those of the lesson."));
  connect(take, &QPushButton::clicked, this, &LessonForm::case_wanted);
  auto* row = new QHBoxLayout;
  row->addWidget(take);
  row->addStretch(1);
  form.wide(row);
  auto* start = new QWidget;
  auto* line = new QHBoxLayout(start);
  line->setContentsMargins(0, 0, 0, 0);
  start_ = make_note({});
  start_->setAccessibleName(tr("Start"));
  drop_start_ = make_remove_button(tr("Remove the lesson's own start"));
  line->addWidget(start_, 1);
  line->addWidget(drop_start_);
  form.row(tr("Start"), start, tr("Seeds, a threshold or a flood, taken from a case."));
  parameters_ = new ParameterRows(kMainParameters);
  form.row(tr("Parameters"), parameters_, tr("From which those of the parts differ."));
  parameters_->setAccessibleName({});
  connect(study_, &StudyChoice::edited, this, [this] {
    show_start();
    emit edited();
  });
  connect(study_, &StudyChoice::phantom_chosen, this, [this] {
    lesson_->start.reset();  // it was a place in the other one
    show_start();
    emit phantom_chosen();
  });
  connect(drop_start_, &QToolButton::clicked, this, [this] {
    lesson_->start.reset();
    show_start();
    emit edited();
  });
  connect(parameters_, &ParameterRows::edited, this, &LessonForm::keep_parameters);
}

void LessonForm::show_lesson(document::Lesson& lesson, const std::filesystem::path& folder) {
  lesson_ = &lesson;
  show_text(*title_, lesson.title);
  show_text(*about_, lesson.about);
  show_text(*author_, lesson.author);
  show_number(*minutes_, lesson.minutes, 0);
  study_->show_study(&lesson.study, folder);
  shown_ = before_ = lesson.parameters;
  of_parts_.clear();
  for (const document::LessonPart& part : lesson.parts) {
    of_parts_.push_back(part.attempt ? part.attempt->parameters : solver::Parameters{});
  }
  parameters_->show_parameters(&shown_, {});
  show_start();
}

void LessonForm::show_start() {
  drop_start_->setVisible(lesson_->start.has_value());
  if (lesson_->start) return start_->setText(engine::message_text(lesson_->start->describe()));
  start_->setText(lesson_->study.phantom.empty() ? tr("none yet: take it from a case")
                                                 : tr("the phantom's own"));
}

void LessonForm::focus_title() {
  title_->setFocus();
  title_->selectAll();
}

// From what was there before: a number that is half typed may be one that a part has of its own.
void LessonForm::keep_parameters() {
  for (std::size_t i = 0; i < lesson_->parts.size(); ++i) {
    if (!lesson_->parts[i].attempt) continue;
    solver::Parameters& parameters = lesson_->parts[i].attempt->parameters;
    parameters = of_parts_[i];
    follow(parameters, before_, shown_);
  }
  lesson_->parameters = shown_;
  emit edited();
}

}  // namespace tidemark::ui
