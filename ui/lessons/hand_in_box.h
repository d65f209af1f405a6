// The end of a lesson: what came out, the student's name, and the files to be handed in.
#pragma once

#include <QWidget>

#include "engine/lesson_course.h"
#include "engine/result_jobs.h"

class QLabel;
class QLineEdit;
class QPushButton;

namespace tidemark::ui {

// The name goes into the file that the student chooses, and nowhere else.
class HandInBox : public QWidget {
  Q_OBJECT
 public:
  explicit HandInBox(engine::LessonCourse& course, QWidget* parent = nullptr);

  // CSV or PDF, by its suffix.
  void write(const QString& file);

 signals:
  void said();  // how the writing of a file ended

 private:
  void say(const QString& sentence);
  void ask(const QString& filter, const QString& suffix);
  void follow();
  [[nodiscard]] QString score_text() const;

  engine::LessonCourse& course_;
  engine::ResultJobs jobs_;
  QLabel* score_;
  QLineEdit* name_;
  QPushButton* table_;
  QPushButton* sheet_;
  QLabel* outcome_;
  QString file_;
};

}  // namespace tidemark::ui
