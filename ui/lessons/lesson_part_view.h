// A part of a lesson: text, question, try, figures and explanation, each when its turn has come.
#pragma once

#include <QPointer>
#include <QWidget>
#include <vector>

#include "engine/lesson_course.h"

class QButtonGroup;
class QGridLayout;
class QLabel;
class QLineEdit;
class QProgressBar;
class QPushButton;
class QVBoxLayout;

namespace tidemark::ui {

class LessonPartView : public QWidget {
  Q_OBJECT
 public:
  // The present part of the course, which must outlive it.
  explicit LessonPartView(engine::LessonCourse& course, QWidget* parent = nullptr);

  [[nodiscard]] std::size_t index() const { return index_; }
  // Where the outcome of the part begins: figures and explanation.
  [[nodiscard]] QWidget* outcome() const { return measure_heading_ ? measure_heading_ : explanation_; }

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void add_question();
  void add_try();
  void add_figures();
  void add_explanation();
  QLabel* add_heading(const QString& text);
  QLabel* add_text(const std::string& text);
  void follow();
  void show_figures();
  [[nodiscard]] QString verdict() const;

  engine::LessonCourse& course_;
  const document::LessonPart& part_;
  std::size_t index_;
  QVBoxLayout* column_;
  QButtonGroup* choices_ = nullptr;
  QLineEdit* words_ = nullptr;
  QPushButton* try_ = nullptr;
  QPushButton* stop_ = nullptr;
  QLabel* try_hint_ = nullptr;
  QProgressBar* progress_ = nullptr;
  QWidget* measure_heading_ = nullptr;
  QPushButton* measure_ = nullptr;
  QWidget* table_ = nullptr;
  struct Row {
    QLabel* value;
    QLabel* expected;
    QLabel* verdict;
  };
  std::vector<Row> rows_;
  QWidget* explanation_ = nullptr;
  QLabel* verdict_ = nullptr;
};

}  // namespace tidemark::ui
