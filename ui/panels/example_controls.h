// Strokes of examples: the brush, what has been painted, and what is missing.
#pragma once

#include "ui/panels/case_widget.h"

class QComboBox;
class QLabel;
class QPushButton;
class QToolButton;

namespace tidemark::ui {

class Form;
class SliderNumber;

// Hidden while neither strokes nor their tool nor a function that learns from them is there.
class ExampleControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit ExampleControls(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  void count();

  QWidget* content_;
  QLabel* missing_;
  QLabel* inside_;
  QLabel* outside_;
  QToolButton* tool_;
  SliderNumber* radius_;
  QComboBox* motion_;
  QPushButton* clear_;
  std::shared_ptr<const solver::Strokes> counted_;
};

}  // namespace tidemark::ui
