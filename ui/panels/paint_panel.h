// The panel Paint: 3D paint and 3D eraser (paper section 6.2).
#pragma once

#include "ui/panels/panel.h"

class QAction;
class QButtonGroup;
class QLabel;
class QToolButton;

namespace tidemark::ui {

class SliderNumber;

class PaintPanel : public Panel {
  Q_OBJECT
 public:
  explicit PaintPanel(QWidget* parent = nullptr);

  // The main window's.
  void set_actions(QAction* undo, QAction* redo);

 protected:
  void refresh() override;

 private:
  QWidget* make_tools();
  QWidget* make_history();

  QButtonGroup* tools_;
  SliderNumber* radius_;
  QLabel* voxels_;
  QToolButton* undo_;
  QToolButton* redo_;
};

}  // namespace tidemark::ui
