// The outcome of a whole lesson: each figure beside its range.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QTableWidget>
#include <vector>

#include "document/lesson.h"
#include "document/lesson_run.h"

namespace tidemark::ui {

class LessonTrial : public QDialog {
  Q_OBJECT
 public:
  explicit LessonTrial(QWidget* parent = nullptr);

  // One outcome a part.
  void show_outcomes(const document::Lesson& lesson, const std::vector<document::LessonOutcome>& outcomes);

 private:
  void add_row(const QString& part, const document::LessonMeasure& measure, std::optional<double> value);

  QLabel* said_;
  QTableWidget* table_;
};

}  // namespace tidemark::ui
