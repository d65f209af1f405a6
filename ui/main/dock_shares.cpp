#include "ui/main/dock_shares.h"

#include <QChildEvent>
#include <QDockWidget>
#include <utility>

namespace tidemark::ui {

DockShares::DockShares(QMainWindow& window) : QObject(&window), window_(window) {
  window.installEventFilter(this);
  settling_.setSingleShot(true);
  connect(&settling_, &QTimer::timeout, this, &DockShares::settle);
}

bool DockShares::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ChildAdded && watched == &window_)
    static_cast<QChildEvent*>(event)->child()->installEventFilter(this);
  if (event->type() == QEvent::Resize) settling_.start();
  return QObject::eventFilter(watched, event);
}

void DockShares::settle() {
  if (!window_.isVisible()) return;
  if (std::exchange(settled_, window_.size()) != window_.size() && !noted_.isEmpty()) {
    restoring_ = true;
    return restore();
  }
  if (!std::exchange(restoring_, false)) note();
}

// Those that share the window.
QList<QDockWidget*> DockShares::docks() const {
  QList<QDockWidget*> docks;
  for (auto* dock : window_.findChildren<QDockWidget*>(Qt::FindDirectChildrenOnly)) {
    if (dock->isVisible() && !dock->isFloating()) docks << dock;
  }
  return docks;
}

void DockShares::note() {
  noted_ = window_.size();
  dock_sizes_.clear();
  for (QDockWidget* dock : docks()) dock_sizes_[dock] = dock->size();
}

void DockShares::restore() {
  QList<QDockWidget*> known;
  QList<int> widths;
  QList<int> heights;
  for (QDockWidget* dock : docks()) {
    const auto size = dock_sizes_.constFind(dock);
    if (size == dock_sizes_.cend()) continue;
    known << dock;
    widths << size->width() * window_.width() / noted_.width();
    heights << size->height() * window_.height() / noted_.height();
  }
  window_.resizeDocks(known, widths, Qt::Horizontal);
  window_.resizeDocks(known, heights, Qt::Vertical);
}

}  // namespace tidemark::ui
