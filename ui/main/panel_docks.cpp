#include "ui/main/panel_docks.h"

#include <QMainWindow>
#include <QScreen>
#include <QScrollArea>
#include <QVBoxLayout>
#include <utility>

#include "engine/case_balance.h"
#include "ui/main/case_head.h"
#include "ui/main/case_window.h"
#include "ui/panels/display_panel.h"
#include "ui/panels/history_panel.h"
#include "ui/panels/initialise_panel.h"
#include "ui/panels/labels_panel.h"
#include "ui/panels/level_set_panel.h"
#include "ui/panels/paint_panel.h"
#include "ui/panels/statistics_panel.h"
#include "ui/panels/sweep_panel.h"
#include "ui/panels/value_unit.h"
#include "ui/passes/passes_panel.h"
#include "ui/transfer/transfer_function_editor.h"
#include "ui/widgets/relative_font.h"

namespace tidemark::ui {
namespace {

constexpr int kDockWidth = 320;  // logical pixels
constexpr QSize kPassesWindow{970, 750};
constexpr int kDocksVersion = 2;
constexpr int kStateWithoutHistory = 1;       // of arrangements from before there was that panel
constexpr const char* kInFront = "in_front";  // property of a panel

QScrollArea* scrolled(QWidget* panel) {
  auto* scroll = new QScrollArea;
  scroll->setWidget(panel);
  scroll->setWidgetResizable(true);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  return scroll;
}

}  // namespace

PanelDocks::PanelDocks(QMainWindow& window, Actions& actions) : QObject(&window), window_(window) {
  auto* level_set = new LevelSetPanel;
  level_set->set_actions({actions.play, actions.step, actions.step_back, actions.restart});
  auto* initialise = new InitialisePanel;
  auto* paint = new PaintPanel;
  paint->set_actions(actions.undo, actions.redo);
  auto* display = new DisplayPanel;
  auto* history = new HistoryPanel;
  auto* labels = new LabelsPanel;
  labels->set_compare_action(actions.compare_with_label);
  auto* statistics = new StatisticsPanel;
  statistics->set_export_action(actions.export_statistics);
  auto* sweep = new SweepPanel;
  auto* passes = new PassesPanel;
  passes->set_actions(actions.play, actions.step);
  transfer_ = new TransferFunctionEditor;
  panels_ = {level_set, initialise, paint, display, history, labels, statistics, sweep, passes};
  // One column with its tabs at the side: the views keep the room. Editor, history and passes scroll their
  // parts themselves.
  const QList<QDockWidget*> docks{add("initialise", tr("Place surface"), scrolled(initialise)),
                                  add("level-set", tr("Level set"), scrolled(level_set)),
                                  add("history", tr("History"), history),
                                  add("paint", tr("Paint"), scrolled(paint)),
                                  add("display", tr("Display"), scrolled(display)),
                                  add("transfer", tr("Transfer"), transfer_),
                                  add("labels", tr("Labels"), scrolled(labels)),
                                  add("statistics", tr("Statistics"), scrolled(statistics)),
                                  add("sweep", tr("Sweep"), scrolled(sweep)),
                                  add("passes", tr("Passes"), passes)};
  for (qsizetype next = 1; next < docks.size(); ++next)
    window_.tabifyDockWidget(docks[next - 1], docks[next]);
  window_.setTabPosition(Qt::RightDockWidgetArea, QTabWidget::East);
  window_.resizeDocks({docks[0]}, {kDockWidth}, Qt::Horizontal);
  docks[0]->raise();
  // For lectures, and as a window of its own as wide as its columns.
  docks.back()->hide();
  connect(docks.back(), &QDockWidget::topLevelChanged, this, [dock = docks.back()](bool floats) {
    if (floats) dock->resize(kPassesWindow.boundedTo(dock->screen()->availableSize()));
  });
}

QDockWidget* PanelDocks::add(const char* name, const QString& title, QWidget* panel) {
  auto* dock = new QDockWidget(title, &window_);
  dock->setObjectName(QString::fromLatin1(name));
  let_title_follow_font(*dock);
  auto* head = new CaseHead;
  heads_ << head;
  auto* headed = new QWidget;
  auto* column = new QVBoxLayout(headed);
  column->setContentsMargins({});
  column->setSpacing(0);
  column->addWidget(head);
  column->addWidget(panel, 1);
  dock->setWidget(headed);
  dock->setMinimumWidth(kDockWidth);
  window_.addDockWidget(Qt::RightDockWidgetArea, dock);
  docks_ << dock;
  // Qt calls a panel behind another tab visible. Ours are hidden there, while their docks keep their size.
  // Each is shown in a turn of the event loop of its own, because bringing it up to date takes time; the
  // dock's latest state counts then.
  QSizePolicy policy = headed->sizePolicy();
  policy.setRetainSizeWhenHidden(true);
  headed->setSizePolicy(policy);
  headed->hide();
  connect(dock, &QDockWidget::visibilityChanged, headed, [headed](bool in_front) {
    headed->setProperty(kInFront, in_front);
    const auto follow = [headed] { headed->setVisible(headed->property(kInFront).toBool()); };
    QMetaObject::invokeMethod(headed, follow, Qt::QueuedConnection);
  });
  return dock;
}

void PanelDocks::set_case(CaseWindow* window) {
  engine::CaseProxy* proxy = window ? &window->proxy() : nullptr;
  for (CaseHead* head : heads_) head->set_case(window);
  for (CaseWidget* panel : panels_) panel->set_proxy(proxy);
  if (proxy_) {
    disconnect(proxy_, nullptr, this, nullptr);
    disconnect(&proxy_->balance(), nullptr, this, nullptr);
    disconnect(&proxy_->display(), nullptr, this, nullptr);
  }
  proxy_ = proxy;
  begun_ = proxy && proxy->state().begun;
  if (proxy_) {
    connect(proxy_, &engine::CaseProxy::state_changed, this, &PanelDocks::follow_start);
    connect(&proxy_->balance(), &engine::CaseBalance::show_wanted, this, [this] { show("level-set"); });
    connect(&proxy_->display(), &engine::Display::changed, this, &PanelDocks::follow_profile);
  }
  has_profile_ = proxy && proxy->display().settings().profile;
  transfer_->set_display(proxy ? &proxy->display() : nullptr, proxy ? &proxy->summary() : nullptr,
                         proxy ? value_unit(proxy->volume()) : QString());
  show_or_hide();
}

// So does the one that plots what is along a line, once there is a line.
void PanelDocks::follow_profile() {
  const bool has_profile = proxy_->display().settings().profile.has_value();
  if (std::exchange(has_profile_, has_profile) != has_profile && has_profile) show("level-set");
}

// Once there is a surface, the panel that steers it comes to the front in place of Start.
void PanelDocks::follow_start() {
  const bool began = !begun_ && proxy_->state().begun;
  begun_ = proxy_->state().begun;
  if (began && !docks_.first()->visibleRegion().isEmpty()) show("level-set");
}

void PanelDocks::set_hidden(bool hidden) {
  unwanted_ = hidden;
  show_or_hide();
}

void PanelDocks::show_or_hide() {
  const bool show_them = proxy_ && !unwanted_;
  for (QDockWidget* dock : docks_) dock->toggleViewAction()->setEnabled(show_them);
  if (show_them == shown_) return;
  if (show_them) {
    shown_ = true;
    window_.restoreState(arrangement_, kDocksVersion);
    if (!front_.isEmpty()) show(std::exchange(front_, {}));
  } else {
    arrangement_ = arrangement();
    hide();
  }
}

void PanelDocks::hide() {
  shown_ = false;
  for (QDockWidget* dock : docks_) dock->hide();
}

QByteArray PanelDocks::arrangement() const {
  return shown_ ? window_.saveState(kDocksVersion) : arrangement_;
}

// A window that was not shown yet does not know again which panel was in front.
void PanelDocks::restore(const QByteArray& arrangement) {
  arrangement_ = arrangement;
  if (!window_.restoreState(arrangement, kDocksVersion)) {
    if (window_.restoreState(arrangement, kStateWithoutHistory)) {
      window_.tabifyDockWidget(window_.findChild<QDockWidget*>("level-set"),
                               window_.findChild<QDockWidget*>("history"));
    }
    arrangement_ = window_.saveState(kDocksVersion);
  }
  hide();
  show_or_hide();
}

QList<QAction*> PanelDocks::toggles() const {
  QList<QAction*> actions;
  for (const QDockWidget* dock : docks_) actions << dock->toggleViewAction();
  return actions;
}

void PanelDocks::show(const QString& name) {
  if (!shown_) {
    front_ = name;
    return;
  }
  for (QDockWidget* dock : docks_) {
    if (dock->objectName() != name) continue;
    dock->show();
    dock->raise();
  }
}

}  // namespace tidemark::ui
