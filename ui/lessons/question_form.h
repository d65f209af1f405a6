// The question of a lesson's part: its text, its choices, and which of them is right.
#pragma once

#include <QGroupBox>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QRadioButton>
#include <optional>

#include "document/lesson.h"
#include "ui/lessons/row_grid.h"

namespace tidemark::ui {

class QuestionForm : public QGroupBox {
  Q_OBJECT
 public:
  explicit QuestionForm(QWidget* parent = nullptr);

  // `question` is changed by the user, and must outlive the showing; unset: nothing is asked.
  void show_question(std::optional<document::LessonQuestion>* question);

 signals:
  void edited();

 private:
  void fill();
  void add_row(std::size_t index);
  void add_choice();
  void remove_choice(std::size_t index);

  std::optional<document::LessonQuestion>* question_ = nullptr;
  document::LessonQuestion kept_;  // while the box is not checked
  QPlainTextEdit* text_;
  RowGrid* choices_;
  QPushButton* add_;
  QRadioButton* none_wrong_;
};

}  // namespace tidemark::ui
