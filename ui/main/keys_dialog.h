// All keys, to be looked at and changed.
#pragma once

#include <QDialog>

#include "ui/main/actions.h"

class QTableWidget;

namespace tidemark::ui {

class KeysDialog : public QDialog {
  Q_OBJECT
 public:
  explicit KeysDialog(Actions& actions, QWidget* parent = nullptr);

 private:
  void mark_conflicts();

  Actions& actions_;
  QTableWidget* table_;
};

}  // namespace tidemark::ui
