#include "ui/main/dock_shares.h"

#include <QChildEvent>
#include <QDockWidget>
#include <utility>

namespace tidemark::ui {

DockShares::DockShares(QMainWindow& window) : QObject(&window), window_(window) {
  window.installEventFilter(this);
  settling_.setSingleShot(true);
  connect(&settling_, &QTimer::timeout, this, &DockShares::note_or_restore);
}

void DockShares::set(const Shares& shares) {
  shares_ = shares;
  settled_ = {};
  settling_.start();
}

void DockShares::forget() {
  shares_.clear();
}

bool DockShares::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::ChildAdded && watched == &window_)
    static_cast<QChildEvent*>(event)->child()->installEventFilter(this);
  if (event->type() == QEvent::StyleChange && watched == &window_) settled_ = {};
  if (event->type() == QEvent::Resize || event->type() == QEvent::StyleChange) settling_.start();
  return QObject::eventFilter(watched, event);
}

void DockShares::note_or_restore() {
  if (!window_.isVisible()) return;
  if (std::exchange(settled_, window_.size()) != window_.size() && !shares_.isEmpty()) {
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
  shares_.clear();
  for (QDockWidget* dock : docks()) {
    shares_[dock] = {static_cast<double>(dock->width()) / window_.width(),
                     static_cast<double>(dock->height()) / window_.height()};
  }
}

void DockShares::restore() {
  QList<QDockWidget*> known;
  QList<int> widths;
  QList<int> heights;
  for (QDockWidget* dock : docks()) {
    const auto share = shares_.constFind(dock);
    if (share == shares_.cend()) continue;
    known << dock;
    widths << qRound(share->width() * window_.width());
    heights << qRound(share->height() * window_.height());
  }
  window_.resizeDocks(known, widths, Qt::Horizontal);
  window_.resizeDocks(known, heights, Qt::Vertical);
}

}  // namespace tidemark::ui
