// Lessons in the desktop: the menu Teach, the panel Lesson, and large type for a projector.
#pragma once

#include <QFont>
#include <QObject>
#include <QPoint>
#include <QPointer>
#include <filesystem>
#include <memory>

#include "document/lesson_copy.h"

class QAction;
class QDockWidget;
class QMenu;

namespace tidemark::engine {
class CaseProxy;
class LessonAutosave;
class LessonCourse;
struct LoadedStudy;
}  // namespace tidemark::engine

namespace tidemark::ui {

class CaseHead;
class CaseWindow;
class LessonEditor;
class MainWindow;

// A lesson without its panel, which another main window may take over.
struct KeptLesson {
  std::unique_ptr<engine::LessonCourse> course;
  std::filesystem::path file;
  bool shown = true;

  ~KeptLesson();
};

// One lesson at a time.
class Teaching : public QObject {
  Q_OBJECT
 public:
  explicit Teaching(MainWindow& window);
  ~Teaching() override;

  void fill(QMenu& menu);
  void show_list(QPoint at);  // that menu, somewhere else on the screen
  // Its studies are looked for beside its file; empty: one of the program's own. The lesson that is being
  // done is ended; where its answers would be lost, the user is asked.
  void begin(document::Lesson lesson, const std::filesystem::path& file);
  void go_on(const document::RescuedLesson& rescued);  // with the answers that a crash has left
  void open(const QString& file);                      // a lesson; says what is wrong with it
  [[nodiscard]] engine::LessonCourse* course() const { return course_.get(); }  // null: none
  // Whether the program may end: asks about answers that were not handed in, and about a lesson that was
  // written and not saved.
  [[nodiscard]] bool may_close();
  // The lesson that is being done, if there is one, to be taken over by another main window.
  [[nodiscard]] std::unique_ptr<KeptLesson> keep();
  void take_over(std::unique_ptr<KeptLesson> kept);
  // For a projector.
  [[nodiscard]] bool large_type() const;
  void set_large_type(bool large);

 private:
  void ask_and_open();
  // False: the one that is being done stays, for its answers.
  bool show(document::Lesson lesson, const std::filesystem::path& file,
            const document::LessonProgress* progress);
  void show(std::unique_ptr<engine::LessonCourse> course, const std::filesystem::path& file);
  void end();
  // Whether the lesson may go: asks about answers that were not handed in.
  [[nodiscard]] bool may_end(const QString& question);
  [[nodiscard]] bool may_end();  // while the cases stay
  [[nodiscard]] bool editor_may_close();
  void open_case(const std::shared_ptr<const engine::LoadedStudy>& study);
  void show_case(engine::CaseProxy& proxy, const document::LessonTry& attempt);
  void name_case();
  [[nodiscard]] CaseWindow* window_of(const engine::CaseProxy* proxy) const;
  void set_large(bool large);
  LessonEditor& editor();  // seen from now on

  MainWindow& window_;
  std::unique_ptr<engine::LessonCourse> course_;
  std::unique_ptr<engine::LessonAutosave> autosave_;  // of the course
  QDockWidget* dock_ = nullptr;
  CaseHead* head_ = nullptr;
  QPointer<CaseWindow> named_;  // at the head
  QMenu* menu_ = nullptr;
  QAction* show_ = nullptr;
  QAction* edit_ = nullptr;
  QAction* large_ = nullptr;
  std::filesystem::path file_;      // of the lesson; empty: one of the program's own
  LessonEditor* editor_ = nullptr;  // once it is wanted
  QFont normal_;
};

}  // namespace tidemark::ui
