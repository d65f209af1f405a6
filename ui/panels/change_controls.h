// A mask that is refined: how far the surface may move, and whether views show what has changed.
#pragma once

#include "ui/panels/case_widget.h"

class QCheckBox;
class QLabel;

namespace tidemark::ui {

// Hidden unless the surface began so.
class ChangeControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit ChangeControls(QWidget* parent = nullptr);

 protected:
  void refresh() override;

 private:
  QWidget* content_;
  QLabel* limit_;
  QCheckBox* show_;
};

}  // namespace tidemark::ui
