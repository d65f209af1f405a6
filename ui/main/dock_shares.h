// The docks' shares of a window, which they keep when the window gets another size.
#pragma once

#include <QHash>
#include <QMainWindow>
#include <QTimer>

namespace tidemark::ui {

// Qt gives and takes room in the order of docks: in a window that became small and large again, or whose
// style changes after its docks were restored, the first dock has most of it.
class DockShares : public QObject {
  Q_OBJECT

 public:
  using Shares = QHash<QDockWidget*, QSizeF>;  // of the window's width and height

  explicit DockShares(QMainWindow& window);

  void set(const Shares& shares);
  void forget();  // the docks keep what they are about to get

  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void note_or_restore();  // once windows and docks have their sizes
  [[nodiscard]] QList<QDockWidget*> docks() const;
  void note();
  void restore();

  QMainWindow& window_;
  Shares shares_;
  QTimer settling_;
  QSize settled_;           // of the window, at last; none: the docks have to get their shares again
  bool restoring_ = false;  // what docks become is no wish of the user
};

}  // namespace tidemark::ui
