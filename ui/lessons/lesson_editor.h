// The editor of lessons, for teachers: parts on the left, the form of the chosen one beside.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QPointer>
#include <QPushButton>
#include <QScrollArea>
#include <QStackedWidget>
#include <QTimer>
#include <filesystem>
#include <functional>
#include <optional>

#include "document/lesson.h"
#include "engine/lesson_jobs.h"
#include "ui/lessons/lesson_file.h"
#include "ui/lessons/lesson_form.h"
#include "ui/lessons/lesson_problem.h"
#include "ui/lessons/lesson_trial.h"
#include "ui/lessons/part_form.h"
#include "ui/lessons/part_list.h"
#include "ui/widgets/work_line.h"

class QBoxLayout;

namespace tidemark::engine {
class CaseProxy;
}

namespace tidemark::ui {

struct CaseSetup;

// Not modal: the teacher works with a case beside it. It begins with a new lesson.
class LessonEditor : public QDialog {
  Q_OBJECT
 public:
  // The case from which "Take from the case" takes; null: there is none.
  using ActiveCase = std::function<engine::CaseProxy*()>;
  explicit LessonEditor(ActiveCase active_case, QWidget* parent = nullptr);
  ~LessonEditor() override;

  // Where the present lesson has changes, the user is asked first, and may keep it.
  void new_lesson();
  // As it is in `file`; empty: it is in none yet, as the program's own lessons.
  void edit(const document::Lesson& lesson, const std::filesystem::path& file = {});
  // Reads the file in the background; what is wrong with it is said in the window.
  void open(const std::filesystem::path& file);

  [[nodiscard]] const document::Lesson& lesson() const { return lesson_; }
  [[nodiscard]] bool is_modified() const { return file_->is_modified(); }

  void reject() override;  // asks where something would be lost

 signals:
  void saved(const QString& file);

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void make_forms(QBoxLayout& whole);
  QWidget* make_messages();
  QWidget* make_buttons();
  QPushButton* make_button(const QString& text, const QString& tip, QBoxLayout& row,
                           const std::function<void()>& clicked);
  void connect_forms();
  void connect_trials();
  void show_lesson(const document::Lesson& lesson, const std::filesystem::path& file);
  void show_chosen();
  void note_edit();
  void check();
  void show_title();
  void commit_typed_number();  // the edited number box keeps what is typed
  void say(const QString& sentence);
  void take_from_case();
  void take(const CaseSetup& setup);
  void measure();
  void try_all();
  void carry_out(const document::Lesson& lesson, const QString& what);
  void set_busy(bool busy);
  [[nodiscard]] QString problem() const;

  ActiveCase active_case_;
  document::Lesson lesson_;
  std::optional<std::size_t> shown_;     // part; unset: the lesson itself
  std::filesystem::path shown_folder_;   // of the lesson's file
  std::optional<int> problem_row_;       // of the list; unset: no problem is known
  std::uint64_t showing_ = 0;            // grows with each one
  std::optional<std::size_t> measured_;  // part that is carried out; unset: the whole lesson
  LessonFile* file_;
  engine::LessonJobs trials_;
  engine::LessonJobs suits_;
  QTimer checking_;
  PartList* list_ = nullptr;
  LessonForm* lesson_form_ = nullptr;
  PartForm* part_form_ = nullptr;
  QStackedWidget* forms_ = nullptr;
  QLabel* problem_;
  WorkLine* work_;
  QList<QPushButton*> idle_buttons_;  // that wait while the lesson is carried out
  LessonTrial* trial_ = nullptr;
  QPointer<QWidget> focus_;  // before the lesson was carried out
};

}  // namespace tidemark::ui
