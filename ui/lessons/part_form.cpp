#include "ui/lessons/part_form.h"

#include <QVBoxLayout>

#include "ui/lessons/text_box.h"
#include "ui/look/theme.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {
namespace {

constexpr int kTextLines = 5;
constexpr int kExplanationLines = 4;

}  // namespace

PartForm::PartForm(QWidget* parent)
    : QWidget(parent),
      title_(new QLineEdit),
      text_(make_text_box(kTextLines)),
      study_(new StudyChoice),
      question_(new QuestionForm),
      try_(new TryForm),
      explanation_(make_text_box(kExplanationLines)) {
  auto* column = new QVBoxLayout(this);
  auto* rows = new QWidget;
  Form form(rows);
  column->setContentsMargins(kSpace, kSpace, kSpace, kSpace);
  column->addWidget(rows);
  column->addStretch(1);
  form.row(tr("Title"), title_, tr("One line, at the head of the part."));
  form.row(tr("Text"), text_, tr("What the student reads first. An empty line ends a paragraph."));
  other_study_ = form.check(tr("Another study than the lesson's"), tr("This part alone is about it."));
  form.wide(study_);
  form.wide(question_);
  form.wide(try_);
  form.row(tr("Explanation"), explanation_, tr("Why it came out so. Shown when all is measured."));

  connect(title_, &QLineEdit::textEdited, this, [this](const QString& typed) {
    part_->title = typed.toStdString();
    emit edited();
  });
  connect(text_, &QPlainTextEdit::textChanged, this, [this] {
    part_->text = text_->toPlainText().toStdString();
    emit edited();
  });
  connect(explanation_, &QPlainTextEdit::textChanged, this, [this] {
    part_->explanation = explanation_->toPlainText().toStdString();
    emit edited();
  });
  connect(other_study_, &QCheckBox::clicked, this, &PartForm::use_own_study);
  connect(study_, &StudyChoice::edited, this, &PartForm::edited);
  connect(question_, &QuestionForm::edited, this, &PartForm::edited);
  connect(try_, &TryForm::edited, this, &PartForm::edited);
  connect(try_, &TryForm::case_wanted, this, &PartForm::case_wanted);
  connect(try_, &TryForm::measure_wanted, this, &PartForm::measure_wanted);
}

void PartForm::show_part(document::Lesson& lesson, std::size_t index, const std::filesystem::path& folder) {
  lesson_ = &lesson;
  part_ = &lesson.parts[index];
  folder_ = folder;
  show_text(*title_, part_->title);
  show_text(*text_, part_->text);
  show_text(*explanation_, part_->explanation);
  other_study_->setChecked(part_->study.has_value());
  study_->setVisible(part_->study.has_value());
  study_->show_study(part_->study ? &*part_->study : nullptr, folder);
  question_->show_question(&part_->question);
  try_->show_part(part_, lesson);
}

void PartForm::focus_title() {
  title_->setFocus();
  title_->selectAll();
}

void PartForm::use_own_study(bool own) {
  part_->study.reset();
  if (own) part_->study = lesson_->study;
  study_->setVisible(own);
  study_->show_study(own ? &*part_->study : nullptr, folder_);
  try_->show_part(part_, *lesson_);  // whose start may be another one
  emit edited();
}

}  // namespace tidemark::ui
