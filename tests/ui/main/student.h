// A student at the panel Lesson: reads, clicks and types what is seen there.
#pragma once

#include <QComboBox>
#include <QPushButton>
#include <filesystem>

#include "engine/lesson_course.h"
#include "tests/ui/main/desktop.h"
#include "ui/lessons/lesson_panel.h"
#include "ui/main/teaching.h"

namespace tidemark::test {

inline constexpr int kLessonPatience = 240'000;  // ms

// A function that fails has called QFAIL: look at QTest::currentTestFailed() after each.
class Student {
 public:
  explicit Student(Desktop& desktop) : desktop_(desktop) {}

  // The lesson with that number in the menu Teach.
  void open_own(int number);
  [[nodiscard]] const engine::LessonCourse& course() const { return *desktop_.window().teaching().course(); }
  [[nodiscard]] ui::LessonPanel* panel() const;

  void choose(std::size_t choice);
  void answer(const QString& words);
  void try_out();
  void measure();
  void go_on();  // to the next part
  // Whether a text can be read on the panel, by scrolling at most.
  [[nodiscard]] bool reads(const QString& text) const;
  [[nodiscard]] bool sees(const QString& text) const;  // without scrolling

  void sign(const QString& name);
  // By that button and the dialog of files.
  void hand_in(const QString& button, const std::filesystem::path& file);
  void end();

  [[nodiscard]] QPushButton* button(const QString& text) const;  // null: there is none to be seen
  // Scrolls there first.
  static void click(QWidget& widget, QPoint at);
  static void click(QWidget& widget) { click(widget, widget.rect().center()); }

 private:
  Desktop& desktop_;
};

}  // namespace tidemark::test
