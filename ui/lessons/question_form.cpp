#include "ui/lessons/question_form.h"

#include <QButtonGroup>
#include <QHBoxLayout>
#include <QLineEdit>
#include <QSignalBlocker>

#include "ui/lessons/text_box.h"
#include "ui/look/icons.h"
#include "ui/look/theme.h"
#include "ui/widgets/form.h"

namespace tidemark::ui {
namespace {

constexpr int kQuestionLines = 2;

}  // namespace

QuestionForm::QuestionForm(QWidget* parent)
    : QGroupBox(tr("&Question before the try"), parent),
      text_(make_text_box(kQuestionLines)),
      choices_(new RowGrid({tr("Right"), tr("Choice"), QString()}, 1)),
      add_(new QPushButton(icon(u"add"), tr("Add a choice"))),
      none_wrong_(new QRadioButton(tr("None is wrong"))) {
  setToolTip(tr("What the student predicts before the try."));
  Form form(make_content(*this));
  form.row(tr("Question"), text_, tr("What is asked. Without choices the student answers in words."));
  auto* whole = new QWidget;
  auto* column = new QVBoxLayout(whole);
  column->setContentsMargins(0, 0, 0, 0);
  column->setSpacing(kSpaceTight);
  column->addWidget(choices_);
  auto* row = new QHBoxLayout;
  row->addWidget(none_wrong_);
  row->addStretch(1);
  row->addWidget(add_);
  column->addLayout(row);
  form.row(tr("Choices"), whole, tr("Two or more, or none."));
  none_wrong_->setToolTip(tr("Every choice is taken, as where an opinion is asked."));
  add_->setAutoDefault(false);
  add_->setToolTip(tr("Adds a choice at the end."));

  connect(this, &QGroupBox::clicked, this, [this](bool on) {
    if (question_ == nullptr) return;
    if (on) {
      *question_ = kept_;
    } else {
      kept_ = question_->value_or(document::LessonQuestion{});
      question_->reset();
    }
    emit edited();
  });
  connect(text_, &QPlainTextEdit::textChanged, this, [this] {
    if (question_ == nullptr || !*question_) return;
    (*question_)->text = text_->toPlainText().toStdString();
    emit edited();
  });
  connect(add_, &QPushButton::clicked, this, &QuestionForm::add_choice);
  connect(none_wrong_, &QRadioButton::clicked, this, [this] {
    (*question_)->right.reset();
    emit edited();
  });
}

void QuestionForm::show_question(std::optional<document::LessonQuestion>* question) {
  question_ = question;
  kept_ = {};
  setChecked(question != nullptr && question->has_value());
  const document::LessonQuestion shown = isChecked() ? **question : document::LessonQuestion{};
  show_text(*text_, shown.text);
  fill();
}

void QuestionForm::fill() {
  choices_->clear();
  const document::LessonQuestion* asked = isChecked() ? &**question_ : nullptr;
  const bool has_choices = asked != nullptr && !asked->choices.empty();
  none_wrong_->setVisible(has_choices);
  delete none_wrong_->group();  // with the rows that were
  auto* group = new QButtonGroup(choices_);
  group->addButton(none_wrong_);
  none_wrong_->setChecked(true);
  if (!has_choices) return;
  for (std::size_t i = 0; i < asked->choices.size(); ++i) add_row(i);
}

void QuestionForm::add_row(std::size_t index) {
  document::LessonQuestion& asked = **question_;
  const int number = static_cast<int>(index) + 1;
  auto* right = new QRadioButton;
  right->setAccessibleName(tr("Choice %1 is right").arg(number));
  right->setToolTip(tr("This choice is right."));
  none_wrong_->group()->addButton(right);
  right->setChecked(asked.right == index);
  connect(right, &QRadioButton::clicked, this, [this, index] {
    (*question_)->right = index;
    emit edited();
  });
  auto* text = new QLineEdit(QString::fromStdString(asked.choices[index]));
  text->setAccessibleName(tr("Choice %1").arg(number));
  text->setToolTip(tr("What can be chosen."));
  connect(text, &QLineEdit::textEdited, this, [this, index](const QString& typed) {
    (*question_)->choices[index] = typed.toStdString();
    emit edited();
  });
  QToolButton* remove = make_remove_button(tr("Remove choice %1").arg(number));
  connect(remove, &QToolButton::clicked, this, [this, index] { remove_choice(index); });
  choices_->add({right, text, remove});
}

void QuestionForm::add_choice() {
  if (question_ == nullptr || !*question_) return;
  const int number = static_cast<int>((*question_)->choices.size()) + 1;
  (*question_)->choices.emplace_back();
  fill();
  for (QLineEdit* line : choices_->findChildren<QLineEdit*>()) {
    if (line->accessibleName() == tr("Choice %1").arg(number)) line->setFocus();
  }
  emit edited();
}

void QuestionForm::remove_choice(std::size_t index) {
  document::LessonQuestion& asked = **question_;
  asked.choices.erase(asked.choices.begin() + static_cast<std::ptrdiff_t>(index));
  if (asked.right == index) asked.right.reset();
  if (asked.right && *asked.right > index) --*asked.right;
  fill();
  emit edited();
}

}  // namespace tidemark::ui
