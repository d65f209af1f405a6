// The controls of the smoothing that the source gets before the level set sees it.
#pragma once

#include "ui/panels/case_widget.h"

class QLabel;
class QPushButton;

namespace tidemark::ui {

class SliderNumber;

class SmoothingControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit SmoothingControls(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void show_button();

  SliderNumber* sigma_;
  QLabel* now_;
  QPushButton* apply_;
};

}  // namespace tidemark::ui
