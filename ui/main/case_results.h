// Results of cases to other systems, and what comes from others: labels, and segmentations to compare.
#pragma once

#include <QObject>
#include <QPointer>
#include <QStringList>
#include <deque>
#include <memory>

#include "engine/result_jobs.h"
#include "ui/main/case_window.h"

namespace tidemark::ui {

class MainWindow;
class StatusProgress;

// Carries out the window's actions about results, on the active case.
class CaseResults : public QObject {
  Q_OBJECT
 public:
  explicit CaseResults(MainWindow& window);

  void import_labels(CaseWindow& window, const QString& file);
  // DICOM segmentations and structure sets become labels of the case that they were dropped on, which comes
  // to the front, or else of the active one. The window opens everything else, and without a case everything.
  void take_dropped(const QStringList& paths, CaseWindow* onto);

 private:
  void connect_jobs();
  void make_anonymous_copies();
  void compare_readers(CaseWindow& window);
  void read(CaseWindow& window, const QString& file, bool only_results);
  void read_next();
  void end_reading(const QString& problem = {});
  void add(const std::shared_ptr<const imaging::Segments>& segments);
  // Null: a dialog of that name is there already, and was brought to the front.
  template <class Dialog, class... Arguments>
  Dialog* new_dialog(CaseWindow& window, const QString& name, Arguments... arguments);

  // A file that is being read, or waits to be.
  struct Reading {
    QPointer<CaseWindow> window;
    QString file;
    bool only_results = false;  // else it is opened
  };

  MainWindow& window_;
  engine::ResultJobs jobs_;
  StatusProgress* progress_;
  std::deque<Reading> waiting_;  // the first is being read
};

}  // namespace tidemark::ui
