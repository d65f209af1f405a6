// The figures of a lesson's part with their expected ranges, a row each.
#pragma once

#include <QLabel>
#include <QPushButton>
#include <QWidget>
#include <vector>

#include "document/lesson.h"
#include "document/lesson_figure.h"
#include "document/lesson_run.h"
#include "ui/lessons/row_grid.h"
#include "ui/widgets/number_box.h"

namespace tidemark::ui {

// The value to that many percent, outwards to the digits that the figure is shown with; a count is rounded.
[[nodiscard]] document::LessonMeasure measure_around(const document::LessonFigure& figure, double value,
                                                     double percent);

class MeasureRows : public QWidget {
  Q_OBJECT
 public:
  explicit MeasureRows(QWidget* parent = nullptr);

  // `measures` is changed by the user, and must outlive the showing; null: none.
  void show_measures(std::vector<document::LessonMeasure>* measures);
  // Gives each figure that was measured its range.
  void take(const document::LessonOutcome& outcome);

 signals:
  void edited();
  void measure_wanted();

 private:
  void fill();
  void add_row(std::size_t index);
  [[nodiscard]] QWidget* make_figure(std::size_t index);
  [[nodiscard]] NumberBox* make_end(std::size_t index, const QString& name,
                                    double document::LessonMeasure::*end);
  void add_measure();

  std::vector<document::LessonMeasure>* measures_ = nullptr;
  std::vector<QString> measured_;  // beside each of them; empty: not yet
  RowGrid* rows_;
  QPushButton* add_;
  NumberBox* tolerance_;
  QPushButton* measure_;
};

}  // namespace tidemark::ui
