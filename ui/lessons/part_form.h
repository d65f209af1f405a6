// The form of one part of a lesson.
#pragma once

#include <QCheckBox>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QWidget>
#include <filesystem>

#include "document/lesson.h"
#include "ui/lessons/question_form.h"
#include "ui/lessons/study_choice.h"
#include "ui/lessons/try_form.h"

namespace tidemark::ui {

class PartForm : public QWidget {
  Q_OBJECT
 public:
  explicit PartForm(QWidget* parent = nullptr);

  // The user changes the part in the lesson, whose parts must stay where they are until the next showing.
  void show_part(document::Lesson& lesson, std::size_t index, const std::filesystem::path& folder);
  void take(const document::LessonOutcome& outcome) { try_->take(outcome); }
  void focus_title();

 signals:
  void edited();
  void case_wanted();
  void measure_wanted();

 private:
  void use_own_study(bool own);

  document::Lesson* lesson_ = nullptr;
  document::LessonPart* part_ = nullptr;
  std::filesystem::path folder_;
  QLineEdit* title_;
  QPlainTextEdit* text_;
  QCheckBox* other_study_;
  StudyChoice* study_;
  QuestionForm* question_;
  TryForm* try_;
  QPlainTextEdit* explanation_;
};

}  // namespace tidemark::ui
