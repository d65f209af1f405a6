// The section "Along the line": phi and brightness along a line that was drawn in a slice.
#pragma once

#include "ui/panels/case_widget.h"

class QLabel;
class QPushButton;

namespace tidemark::ui {

class ProfilePlot;

// Hidden until the tool is chosen or a line is drawn.
class ProfileControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit ProfileControls(QWidget* parent = nullptr);

 protected:
  void refresh() override;

 private:
  void show_line(const engine::Measurement& line);
  void resizeEvent(QResizeEvent* event) override;

  QWidget* content_;
  QWidget* drawn_;  // what there is to say of a line
  ProfilePlot* plot_;
  QLabel* crossings_;
  QLabel* note_;
  QPushButton* clear_;
  bool comes_to_sight_ = false;  // once its new size is known
};

}  // namespace tidemark::ui
