// The export of a film of the active view, with its progress in the status bar.
#pragma once

#include <QObject>

#include "engine/result_jobs.h"
#include "ui/main/case_window.h"

namespace tidemark::ui {

class CaseFiles;
class MainWindow;
class StatusProgress;

// One film at a time: no other one begins before it is written or given up.
class FilmWriter : public QObject {
  Q_OBJECT
 public:
  FilmWriter(MainWindow& window, CaseFiles& files);

  void ask_and_write(CaseWindow& window);
  void write(CaseWindow& window, const QString& file);
  [[nodiscard]] bool writing() const { return jobs_.busy(); }

 signals:
  void ended();  // well or not

 private:
  [[nodiscard]] bool may_begin();  // says why not

  MainWindow& window_;
  CaseFiles& files_;
  engine::ResultJobs jobs_;
  StatusProgress* progress_;
  QString file_;  // that is being written
};

}  // namespace tidemark::ui
