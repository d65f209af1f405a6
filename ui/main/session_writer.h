// Cases saved in session files, and what is asked before one is lost.
#pragma once

#include <QObject>
#include <QSet>

#include "ui/main/case_files.h"
#include "ui/main/case_window.h"

class QCloseEvent;

namespace tidemark::ui {

class MainWindow;

QString session_filter();  // of file dialogs

class SessionWriter : public QObject {
  Q_OBJECT
 public:
  SessionWriter(MainWindow& window, CaseFiles& files);

  void save(CaseWindow& window);  // to its file; asks for one the first time
  void save_as(CaseWindow& window);

  // Asks before something is lost.
  void close(CaseWindow& window, QCloseEvent* event);
  // The case closes once it is saved, or exports that were asked for have taken from it what they write.
  [[nodiscard]] bool closes_later(const CaseWindow& window) const {
    return once_saved_.contains(&window) || after_exports_.contains(&window);
  }

 signals:
  void saved(tidemark::ui::CaseWindow& window);  // its session_file holds it
  void not_saved();                              // a case that would have closed then stays

 private:
  [[nodiscard]] QString ask_for_file(CaseWindow& window);
  void save_to(CaseWindow& window, const QString& file, CaseFiles::Ended ended = {});
  void close_later(const CaseWindow& window, QSet<const CaseWindow*>& when);
  void close_after_exports(const CaseWindow* window);
  void keep_open(const CaseWindow& window);  // one that would have closed

  MainWindow& window_;
  CaseFiles& files_;
  QSet<const CaseWindow*> once_saved_;  // cases that close then
  QSet<const CaseWindow*> after_exports_;
};

}  // namespace tidemark::ui
