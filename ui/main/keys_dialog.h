// The dialog of all keys, to be looked at and changed.
#pragma once

#include <QDialog>

#include "ui/main/actions.h"

class QKeySequenceEdit;
class QTableWidget;

namespace tidemark::ui {

// What is typed into a box becomes the action's key, and Backspace leaves it without one. Tab, Return and
// Escape stay the dialog's.
class KeysDialog : public QDialog {
  Q_OBJECT
 public:
  explicit KeysDialog(Actions& actions, QWidget* parent = nullptr);

  void done(int result) override;

 private:
  [[nodiscard]] QKeySequenceEdit& box(std::size_t row) const;
  void keep_keys();
  void reset_keys();
  void mark_conflicts();

  Actions& actions_;
  QTableWidget* table_;
};

}  // namespace tidemark::ui
