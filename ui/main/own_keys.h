// Keys that the widget in focus has a use for, before the shortcuts of the main window.
#pragma once

#include <QObject>

namespace tidemark::ui {

// Space presses a button, ticks a cell of a list or a table and opens a list of choices. Home goes to the
// first of a list, a table or a slider, instead of back to the start. What takes text claims its keys by
// itself. An event filter of the application: floating panels, too, have the main window's shortcuts.
class OwnKeys : public QObject {
  Q_OBJECT
 public:
  explicit OwnKeys(QObject* parent);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;
};

}  // namespace tidemark::ui
