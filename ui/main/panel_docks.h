// The panels around the cases: docks of the main window that act on the active case.
#pragma once

#include <QDockWidget>
#include <QList>
#include <QObject>
#include <QPointer>

#include "session/case_session.h"
#include "ui/main/actions.h"

class QMainWindow;

namespace tidemark {

class SessionWidget;
class StatisticsPanel;
class TransferFunctionEditor;

class PanelDocks : public QObject {
  Q_OBJECT
 public:
  PanelDocks(QMainWindow& window, Actions& actions);

  void set_session(CaseSession* session);  // null: none
  // Hides all that are open, and shows the same ones again.
  void set_hidden(bool hidden);
  [[nodiscard]] QList<QAction*> toggles() const;  // one a panel: shows or hides it
  [[nodiscard]] StatisticsPanel& statistics() { return *statistics_; }
  // Brings a panel to the front: "initialise", "level-set", ...
  void show(const QString& name);

 private:
  QDockWidget* add(const char* name, const QString& title, QWidget* panel);

  void follow_start();

  QMainWindow& window_;
  QPointer<CaseSession> session_;
  bool begun_ = false;
  QList<QDockWidget*> docks_;
  QList<SessionWidget*> panels_;
  QList<QDockWidget*> open_;  // before they were hidden
  StatisticsPanel* statistics_ = nullptr;
  TransferFunctionEditor* transfer_ = nullptr;
};

}  // namespace tidemark
