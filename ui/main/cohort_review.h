// A cohort in the desktop: its panel, the case of it that is open, and what is said of the cases.
#pragma once

#include <QObject>
#include <QPointer>
#include <QString>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "document/cohort/review_list.h"
#include "document/session_contents.h"
#include "engine/work_queue.h"
#include "ui/main/case_window.h"
#include "ui/main/kept_cohort.h"

class QDockWidget;

namespace tidemark::engine {
class BackgroundJob;
struct LoadedStudy;
}  // namespace tidemark::engine

namespace tidemark::ui {

class CaseOpener;
class CohortModel;
class CohortPanel;
class MainWindow;

// The case of a cohort that is open.
struct CohortCase {
  std::string id;
  const engine::CaseProxy* proxy = nullptr;  // by which another main window knows it
  QPointer<CaseWindow> window;
  std::optional<std::uint64_t> result;     // the state of the history that the cohort has; unset: none
  std::optional<cohort::CaseStatus> seen;  // likewise
};

// One cohort, and one case of it, at a time. What is said is said of the chosen case. While it is another one
// than the user sees, nothing can be said.
class CohortReview : public QObject {
  Q_OBJECT
 public:
  explicit CohortReview(MainWindow& window);
  ~CohortReview() override;

  [[nodiscard]] static bool is_cohort(const QString& folder);
  void ask_and_open();
  void open(const QString& folder);
  // Another case is the active one, or it has changed.
  void follow_case();
  // Whether the main window may close. While a correction is written it does so later, by itself.
  [[nodiscard]] bool may_close();
  // What was said is on the disk then, unless the disk takes seconds.
  [[nodiscard]] KeptCohort keep();
  void take_over(const KeptCohort& kept);

 private:
  using Verdict = cohort::Decision::Verdict;

  [[nodiscard]] KeptCohort present() const;
  void connect_actions();
  void read(const KeptCohort& wanted);
  void show(cohort::ReviewList list, const KeptCohort& wanted);
  void close();
  void go(int by);
  // Asks about changes of the open case first.
  void open_case(int row);
  void load(int row);
  void give_up();
  void add(const std::shared_ptr<const engine::LoadedStudy>& study,
           const std::shared_ptr<const document::SessionContents>& contents);
  void take_case(std::shared_ptr<CohortCase> open);
  void follow_closing();
  static void leave(CaseWindow& window);
  [[nodiscard]] CaseWindow* open_window() const;  // null: none
  [[nodiscard]] int open_row() const;             // -1: none
  [[nodiscard]] bool is_changed() const;          // the open case's surface
  [[nodiscard]] int meant_row() const;            // of which can be spoken; -1: none
  void accept();
  void correct();
  void write_correction(const std::shared_ptr<const engine::CaseProxy::Snapshot>& snapshot);
  void end_correction(const Status& written);
  void say(int row, Verdict verdict, const QString& comment);

  MainWindow& window_;
  std::optional<KeptCohort> wanted_;  // while it is read
  std::shared_ptr<engine::BackgroundJob> reading_;
  QString path_;  // of the cohort; empty: none is open
  std::shared_ptr<const cohort::CohortPlan> plan_;
  std::unique_ptr<CohortModel> model_;
  QPointer<CohortPanel> panel_;
  QDockWidget* dock_ = nullptr;

  std::unique_ptr<CaseOpener> opener_;
  int opening_ = -1;                  // the row of the case that is being opened
  std::shared_ptr<CohortCase> open_;  // its window may be gone

  bool correcting_ = false;    // the open case
  bool is_written_ = false;    // the correction: it has got what it needs of the case
  std::string after_it_;       // the case to be opened then; empty: none
  bool closes_later_ = false;  // the main window
  engine::WorkQueue writing_;
};

}  // namespace tidemark::ui
