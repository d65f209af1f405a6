// The end of what a widget asks, where it comes to show another case.
#pragma once

#include <QDialog>

namespace tidemark::ui {

// Dialogs of the widget and of its parts. An answer would go to a case that it was not meant for.
inline void cancel_dialogs(const QWidget& of) {
  for (auto* dialog : of.findChildren<QDialog*>()) {
    if (dialog->isVisible()) dialog->reject();
  }
}

}  // namespace tidemark::ui
