// The desktop: cases side by side, and the panels that act on the active one.
#pragma once

#include <QMainWindow>
#include <memory>
#include <optional>
#include <vector>

#include "engine/engine.h"
#include "ui/main/actions.h"
#include "ui/main/case_window.h"
#include "ui/main/kept_cohort.h"

class QMdiSubWindow;
class QStackedWidget;

namespace tidemark::engine {
struct LoadedStudy;
}

namespace tidemark::ui {

class CaseArea;
class CaseComparison;
class CaseExports;
class FilmWriter;
class CaseFiles;
class CaseLinks;
class CaseResults;
class CohortReview;
class Help;
class ImageAdder;
class MessageBar;
class PanelDocks;
class RecentStudies;
class SessionReader;
class SessionWriter;
class StatusBar;
class StudyOpener;
class Teaching;
struct KeptLesson;
struct RecentStudy;

class MainWindow : public QMainWindow {
  Q_OBJECT
 public:
  explicit MainWindow(engine::Engine& engine, QWidget* parent = nullptr);
  ~MainWindow() override;

  // A folder with a study or a cohort, an image file, a session file, or a link (StudyLink).
  void open(const QString& path);
  void open_phantom(const QString& kind);
  CaseWindow* add_case(const std::shared_ptr<const engine::LoadedStudy>& study,
                       const engine::RestoredCase& restored = {},
                       std::optional<solver::ExecutorKind> executor = std::nullopt);  // unset: of new cases

  // What another main window needs to go on with the same cases, and with the lesson that is being done.
  // Nothing but deleting this one may follow, and the cases must outlive it.
  struct Kept {
    std::vector<KeptCase> cases;
    qsizetype active = -1;    // its place among the cases
    QList<qsizetype> linked;  // likewise
    bool tabs = false;
    bool panels_hidden = false;
    bool large_type = false;
    solver::ExecutorKind executor = solver::ExecutorKind::automatic;  // of new cases
    std::unique_ptr<KeptLesson> lesson;
    KeptCohort cohort;
  };
  [[nodiscard]] Kept keep();
  void take_over(Kept kept);

  [[nodiscard]] CaseWindow* active_case() const;  // null: none
  void bring_to_front(CaseWindow& window);
  // The open case whose session is in that file, or will be once it is written; null: none.
  [[nodiscard]] CaseWindow* case_of_session(const QString& file) const;
  [[nodiscard]] QList<CaseWindow*> cases() const;
  [[nodiscard]] Actions& actions() { return *actions_; }
  [[nodiscard]] PanelDocks& panels() { return *panels_; }
  [[nodiscard]] CaseFiles& files() { return *files_; }
  [[nodiscard]] CaseComparison& comparison() { return *comparison_; }
  [[nodiscard]] CaseExports& exports() { return *exports_; }
  [[nodiscard]] FilmWriter& films() { return *films_; }
  [[nodiscard]] SessionReader& session_reader() { return *session_reader_; }
  [[nodiscard]] SessionWriter& session_writer() { return *session_writer_; }
  [[nodiscard]] ImageAdder& images() { return *images_; }
  [[nodiscard]] CaseResults& results() { return *results_; }
  [[nodiscard]] CohortReview& cohort() { return *cohort_; }
  [[nodiscard]] Teaching& teaching() { return *teaching_; }
  [[nodiscard]] Help& help() { return *help_; }
  // The executor of new cases.
  void set_executor(solver::ExecutorKind kind) { executor_ = kind; }
  // Shows a sentence until it is dismissed, the next one comes, or its subject has succeeded.
  void tell(const QString& message, const QString& about = {});
  // The same about one case, which need not be the active one: it bears the case's mark and goes with it.
  void tell(CaseWindow& of, const QString& message, const QString& about = {});
  void dismiss_about(const QString& about);

 protected:
  void closeEvent(QCloseEvent* event) override;
  void dragEnterEvent(QDragEnterEvent* event) override;
  void dropEvent(QDropEvent* event) override;
  void changeEvent(QEvent* event) override;
  // Qt asks for it at Tab, and when the control that has the keyboard is hidden or becomes grey. A case
  // window that gets the keyboard becomes the active one, so that the other cases are passed over.
  bool focusNextPrevChild(bool next) override;

 private:
  void make_centre();
  void connect_files();
  void connect_views();
  void connect_windows();
  void connect_help();
  void ask_for_folder();
  void ask_for_file();
  void open_link(const QString& link);
  void open_recent(const RecentStudy& study);
  QMdiSubWindow* place(CaseWindow* window);
  void show_case(QMdiSubWindow& child, const engine::LoadedStudy& study,
                 const engine::RestoredCase& restored);
  [[nodiscard]] int free_number() const;
  void activate(QMdiSubWindow* window);
  [[nodiscard]] bool close_cases();  // whether none is left
  void quit_at_last();
  void keep_arrangement() const;
  void follow_case();
  void follow_closing();
  void remember(CaseWindow& window);

  engine::Engine& engine_;
  Actions* actions_;
  solver::ExecutorKind executor_ = solver::ExecutorKind::automatic;
  CaseArea* area_ = nullptr;
  QStackedWidget* centre_ = nullptr;
  PanelDocks* panels_ = nullptr;
  CaseLinks* links_ = nullptr;
  CaseComparison* comparison_ = nullptr;
  RecentStudies* recent_ = nullptr;
  StudyOpener* opener_ = nullptr;
  MessageBar* messages_ = nullptr;
  StatusBar* status_bar_ = nullptr;
  CaseFiles* files_ = nullptr;
  CaseExports* exports_ = nullptr;
  FilmWriter* films_ = nullptr;
  SessionReader* session_reader_ = nullptr;
  SessionWriter* session_writer_ = nullptr;
  CaseResults* results_ = nullptr;
  CohortReview* cohort_ = nullptr;
  ImageAdder* images_ = nullptr;
  Teaching* teaching_ = nullptr;
  Help* help_ = nullptr;
  QPointer<CaseWindow> active_;
  bool quitting_ = false;  // once cases are saved and files are written
  QList<QMetaObject::Connection> active_connections_;
};

}  // namespace tidemark::ui
