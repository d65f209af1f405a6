#include "ui/main/case_area.h"

#include <QAction>
#include <QEvent>
#include <QMdiSubWindow>
#include <QMenu>
#include <QTimer>
#include <algorithm>

#include "ui/main/case_head.h"

namespace tidemark::ui {

CaseArea::CaseArea(QWidget* parent) : QMdiArea(parent) {
  setTabsClosable(true);
  setTabsMovable(true);
  setDocumentMode(true);
  connect(this, &QMdiArea::subWindowActivated, this, &CaseArea::follow_cover);
}

// The cases go after it, and say so.
CaseArea::~CaseArea() {
  disconnect(this);
  for (QMdiSubWindow* child : subWindowList()) child->disconnect(this);
}

QMdiSubWindow* CaseArea::add(CaseWindow* window) {
  QMdiSubWindow* child = addSubWindow(window);
  child->setAttribute(Qt::WA_DeleteOnClose);
  // Its own menu has keys that ours have, too.
  for (QAction* action : child->systemMenu()->actions()) action->setShortcut({});
  connect(window, &QWidget::windowTitleChanged, child, &QWidget::setWindowTitle);
  child->setWindowTitle(window->windowTitle());
  child->setWindowIcon(case_mark(window->number()));
  connect(child, &QMdiSubWindow::windowStateChanged, this, &CaseArea::follow_cover);
  return child;
}

void CaseArea::show_child(QMdiSubWindow& child) {
  if (viewMode() == QMdiArea::TabbedView || subWindowList().size() == 1) {
    child.showMaximized();
  } else {
    child.show();
    tile();
  }
}

QList<CaseWindow*> CaseArea::cases() const {
  QList<CaseWindow*> cases;
  for (QMdiSubWindow* child : subWindowList()) {
    if (auto* window = qobject_cast<CaseWindow*>(child->widget())) cases << window;
  }
  return cases;
}

CaseWindow* CaseArea::case_of(const QWidget* widget) const {
  for (CaseWindow* window : cases()) {
    const QWidget* child = window->parentWidget();
    if (widget == child || child->isAncestorOf(widget)) return window;
  }
  return nullptr;
}

void CaseArea::follow_cover() {
  const QMdiSubWindow* front = currentSubWindow();
  for (CaseWindow* window : cases()) {
    const bool is_front = front && window->parentWidget() == front;
    window->set_covered(front && front->isMaximized() && !is_front);
  }
}

void CaseArea::tile() {
  tiled_ = true;
  tileSubWindows();
}

void CaseArea::cascade() {
  tiled_ = false;
  cascadeSubWindows();
}

void CaseArea::set_tabs(bool tabs) {
  setViewMode(tabs ? QMdiArea::TabbedView : QMdiArea::SubWindowView);
}

bool CaseArea::viewportEvent(QEvent* event) {
  const bool handled = QMdiArea::viewportEvent(event);
  // Once the area knows that it has closed.
  if (event->type() == QEvent::ChildRemoved) QTimer::singleShot(0, this, &CaseArea::fill);
  return handled;
}

// The room of one that was closed goes to the others.
void CaseArea::fill() {
  const QList<QMdiSubWindow*> left = subWindowList();
  const auto is_large = [](const QMdiSubWindow* child) { return child->isMaximized(); };
  if (viewMode() == QMdiArea::SubWindowView && std::none_of(left.begin(), left.end(), is_large)) {
    if (left.size() == 1) left.front()->showMaximized();
    if (left.size() > 1 && tiled_) tileSubWindows();
  }
  follow_cover();
  emit case_closed();
}

}  // namespace tidemark::ui
