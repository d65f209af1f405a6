// The parts of a lesson in a list below the lesson itself, with buttons that add, move and remove them.
#pragma once

#include <QListWidget>
#include <QToolButton>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "document/lesson.h"

namespace tidemark::ui {

class PartList : public QWidget {
  Q_OBJECT
 public:
  explicit PartList(QWidget* parent = nullptr);

  // The user changes its parts, and it must outlive the showing. Chooses a part, or the lesson itself.
  void show_lesson(document::Lesson& lesson, std::optional<std::size_t> chosen);
  // The titles as they are now, and a mark where the problem is; row 0 is the lesson itself.
  void show_titles(std::optional<int> problem_row);
  [[nodiscard]] std::optional<std::size_t> chosen() const;  // unset: the lesson itself

 signals:
  void chose();   // another one, or the same at another place
  void edited();  // parts came, went or moved; after chose()
  void added();   // a new part, which is chosen

 private:
  QToolButton* make_button(const QString& name, QStringView picture, const QString& text,
                           const QKeySequence& keys, void (PartList::*method)());
  void fill(int row);
  void choose(int row);
  void add();
  void duplicate();
  void remove();
  void move(int by);
  void move_up() { move(-1); }
  void move_down() { move(1); }
  void insert(document::LessonPart part);

  document::Lesson* lesson_ = nullptr;
  QListWidget* list_;
  QToolButton* duplicate_;
  QToolButton* remove_;
  QToolButton* up_;
  QToolButton* down_;
};

}  // namespace tidemark::ui
