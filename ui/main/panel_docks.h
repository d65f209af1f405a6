// The panels around the cases: docks of the main window that act on the active case.
#pragma once

#include <QDockWidget>
#include <QList>
#include <QObject>
#include <QPointer>

#include "engine/case_proxy.h"
#include "ui/main/actions.h"

class QMainWindow;

namespace tidemark::ui {

class CaseHead;
class CaseWindow;
class CaseWidget;
class TransferFunctionEditor;

class PanelDocks : public QObject {
  Q_OBJECT
 public:
  PanelDocks(QMainWindow& window, Actions& actions);

  // The case on which all panels act. Null: no case is open, and no panels beside the start page.
  void set_case(CaseWindow* window);
  void set_hidden(bool hidden);  // as the user wants it
  // The arrangement of docks and tool bars while panels show, for the settings.
  [[nodiscard]] QByteArray arrangement() const;
  void restore(const QByteArray& arrangement);
  [[nodiscard]] QList<QAction*> toggles() const;  // one a panel: shows or hides it
  // Brings a panel to the front, at once or when panels show again: "initialise", "level-set", ...
  void show(const QString& name);

 private:
  QDockWidget* add(const char* name, const QString& title, QWidget* panel);
  void follow_start();
  void follow_profile();
  void show_or_hide();
  void hide();

  QMainWindow& window_;
  QPointer<engine::CaseProxy> proxy_;
  bool begun_ = false;
  bool has_profile_ = false;
  QList<QDockWidget*> docks_;
  QList<CaseWidget*> panels_;
  QList<CaseHead*> heads_;
  bool unwanted_ = false;  // the user has hidden them
  bool shown_ = true;
  QByteArray arrangement_;  // from before they were hidden
  QString front_;           // while they are hidden: the next to come to the front
  TransferFunctionEditor* transfer_ = nullptr;
};

}  // namespace tidemark::ui
