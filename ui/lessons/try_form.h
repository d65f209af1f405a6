// The try of a lesson's part: how it begins, how far it runs, what it shows, and what is measured then.
#pragma once

#include <QCheckBox>
#include <QGroupBox>
#include <QLabel>
#include <QPushButton>
#include <QRadioButton>
#include <optional>
#include <vector>

#include "document/lesson.h"
#include "document/lesson_run.h"
#include "ui/lessons/measure_rows.h"
#include "ui/lessons/parameter_rows.h"
#include "ui/widgets/number_box.h"

namespace tidemark::ui {

class Form;

class TryForm : public QGroupBox {
  Q_OBJECT
 public:
  explicit TryForm(QWidget* parent = nullptr);

  // The part is changed by the user, and must outlive the showing; null: none.
  void show_part(document::LessonPart* part, const document::Lesson& lesson);
  void take(const document::LessonOutcome& outcome);

 signals:
  void edited();
  void case_wanted();     // its setting is to become the try's
  void measure_wanted();  // the figures of this part

 private:
  void add_start(Form& form);
  void add_run(Form& form);
  void add_views(Form& form);
  void fill();
  void show_start();
  void keep_views();
  void turn(bool on);
  void set_going_on(bool goes_on);
  // What the user has just done to the try.
  void change(const std::function<void(document::LessonTry&)>& apply);

  document::LessonPart* part_ = nullptr;
  const document::Lesson* lesson_ = nullptr;
  std::optional<document::LessonTry> kept_;  // while the box is not checked
  std::vector<document::LessonMeasure> kept_measures_;
  QRadioButton* from_start_;
  QRadioButton* goes_on_;
  QLabel* start_;
  QToolButton* drop_start_;
  NumberBox* steps_;
  QCheckBox* until_rest_;
  NumberBox* smoothing_;
  ParameterRows* parameters_;
  std::vector<QCheckBox*> views_;  // in the order of LessonView
  MeasureRows* measures_;
};

}  // namespace tidemark::ui
