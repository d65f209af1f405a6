#include "ui/main/panel_docks.h"

#include <QMainWindow>
#include <QScrollArea>

#include "ui/panels/display_panel.h"
#include "ui/panels/initialise_panel.h"
#include "ui/panels/labels_panel.h"
#include "ui/panels/level_set_panel.h"
#include "ui/panels/paint_panel.h"
#include "ui/panels/statistics_panel.h"
#include "ui/transfer/transfer_function_editor.h"

namespace tidemark {

PanelDocks::PanelDocks(QMainWindow& window, Actions& actions) : QObject(&window), window_(window) {
  auto* level_set = new LevelSetPanel;
  level_set->set_actions({actions.play, actions.step, actions.step_back, actions.restart});
  auto* initialise = new InitialisePanel;
  auto* paint = new PaintPanel;
  paint->set_actions(actions.undo, actions.redo);
  auto* display = new DisplayPanel;
  auto* labels = new LabelsPanel;
  statistics_ = new StatisticsPanel;
  transfer_ = new TransferFunctionEditor;
  panels_ = {level_set, initialise, paint, display, labels, statistics_};
  // On the right what is used all the time, on the left what starts and ends a segmentation.
  const auto right = Qt::RightDockWidgetArea;
  const auto left = Qt::LeftDockWidgetArea;
  QDockWidget* steering = add("level-set", tr("Level set"), level_set, right);
  QDockWidget* showing = add("display", tr("Display"), display, right);
  QDockWidget* transfer = add("transfer", tr("Transfer function"), transfer_, right);
  window_.tabifyDockWidget(steering, showing);
  window_.tabifyDockWidget(showing, transfer);
  steering->raise();
  QDockWidget* start = add("initialise", tr("Start"), initialise, left);
  QDockWidget* brush = add("paint", tr("Paint"), paint, left);
  window_.tabifyDockWidget(start, brush);
  start->raise();
  QDockWidget* result = add("labels", tr("Labels"), labels, left);
  QDockWidget* figures = add("statistics", tr("Statistics"), statistics_, left);
  window_.tabifyDockWidget(result, figures);
  result->raise();
  window_.setTabPosition(right, QTabWidget::North);
  window_.setTabPosition(left, QTabWidget::North);
  set_session(nullptr);
}

QDockWidget* PanelDocks::add(const char* name, const QString& title, QWidget* panel, Qt::DockWidgetArea area) {
  auto* scroll = new QScrollArea;
  scroll->setWidget(panel);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* dock = new QDockWidget(title, &window_);
  dock->setObjectName(QString::fromLatin1(name));
  dock->setWidget(scroll);
  dock->setMinimumWidth(300);
  window_.addDockWidget(area, dock);
  docks_ << dock;
  return dock;
}

void PanelDocks::set_session(CaseSession* session) {
  for (SessionWidget* panel : panels_) panel->set_session(session);
  transfer_->set_display(session ? &session->display() : nullptr, session ? &session->summary() : nullptr,
                         session && session->volume().modality == "CT" ? tr("HU") : QString());
}

void PanelDocks::set_hidden(bool hidden) {
  if (hidden) {
    for (QDockWidget* dock : docks_) {
      if (!dock->isHidden()) open_ << dock;
      dock->hide();
    }
  } else {
    for (QDockWidget* dock : std::exchange(open_, {})) dock->show();
  }
}

QList<QAction*> PanelDocks::toggles() const {
  QList<QAction*> actions;
  for (const QDockWidget* dock : docks_) actions << dock->toggleViewAction();
  return actions;
}

void PanelDocks::show(const QString& name) {
  for (QDockWidget* dock : docks_) {
    if (dock->objectName() != name) continue;
    dock->show();
    dock->raise();
  }
}

}  // namespace tidemark
