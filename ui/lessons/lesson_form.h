// The form of what holds for a whole lesson: title, author, study, parameters.
#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QWidget>
#include <filesystem>
#include <vector>

#include "document/lesson.h"
#include "ui/lessons/parameter_rows.h"
#include "ui/lessons/study_choice.h"
#include "ui/widgets/number_box.h"

namespace tidemark::ui {

class Form;

class LessonForm : public QWidget {
  Q_OBJECT
 public:
  explicit LessonForm(QWidget* parent = nullptr);

  // `lesson` is changed by the user, and must outlive the showing. `folder` is that of its file.
  void show_lesson(document::Lesson& lesson, const std::filesystem::path& folder);
  void focus_title();

 signals:
  void edited();
  void case_wanted();     // its study, start and parameters are to become the lesson's
  void phantom_chosen();  // another kind

 private:
  void add_words(Form& form);
  void add_setting(Form& form);
  void keep_parameters();
  void show_start();

  document::Lesson* lesson_ = nullptr;
  QLineEdit* title_;
  QPlainTextEdit* about_;
  QLineEdit* author_;
  NumberBox* minutes_;
  StudyChoice* study_;
  QLabel* start_;
  QToolButton* drop_start_;
  ParameterRows* parameters_;
  solver::Parameters shown_;   // as typed
  solver::Parameters before_;  // of the lesson and of its parts, when they were shown
  std::vector<solver::Parameters> of_parts_;
};

}  // namespace tidemark::ui
