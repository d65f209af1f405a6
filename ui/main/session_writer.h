// Cases saved in session files, and what is asked before one is lost.
#pragma once

#include <QObject>
#include <functional>

#include "ui/main/case_window.h"

class QCloseEvent;

namespace tidemark::ui {

class CaseFiles;
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
  [[nodiscard]] bool closes_later() const { return closing_ > 0; }

 signals:
  void saved(tidemark::ui::CaseWindow& window);  // its session_file holds it

 private:
  [[nodiscard]] QString ask_for_file(CaseWindow& window);
  void save_to(CaseWindow& window, const QString& file, std::function<void()> done = {});

  MainWindow& window_;
  CaseFiles& files_;
  int closing_ = 0;  // cases that close once they are saved
};

}  // namespace tidemark::ui
