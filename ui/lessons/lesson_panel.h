// The panel Lesson: the parts of a lesson, one at a time, and its end.
#pragma once

#include <QWidget>

#include "engine/lesson_course.h"

class QComboBox;
class QLabel;
class QPushButton;
class QScrollArea;

namespace tidemark::ui {

class HandInBox;
class LessonPartView;

class LessonPanel : public QWidget {
  Q_OBJECT
 public:
  // The course must outlive it.
  explicit LessonPanel(engine::LessonCourse& course, QWidget* parent = nullptr);

 signals:
  void end_wanted();

 private:
  QWidget* make_head();
  QWidget* make_foot();
  void show_part();
  void show_outcome();
  void follow();

  engine::LessonCourse& course_;
  QComboBox* parts_;
  QScrollArea* scroll_;
  QLabel* message_;
  QPushButton* back_;
  QPushButton* next_;
  LessonPartView* view_ = nullptr;
  bool was_done_ = false;  // the part that is shown
};

}  // namespace tidemark::ui
