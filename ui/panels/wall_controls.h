// Walls and anchors: their tool, what has been painted, and whether the eraser leaves walls.
#pragma once

#include "ui/panels/case_widget.h"

class QCheckBox;
class QLabel;
class QPushButton;
class QToolButton;

namespace tidemark::ui {

class WallControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit WallControls(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void count();

  QCheckBox* behind_eraser_;
  QLabel* walls_;
  QLabel* anchors_;
  QToolButton* tool_;
  QPushButton* clear_;
  std::shared_ptr<const solver::Constraints> counted_;
};

}  // namespace tidemark::ui
