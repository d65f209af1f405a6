// The controls of window and level: which values are black, and which white.
#pragma once

#include <vector>

#include "ui/panels/case_widget.h"
#include "ui/panels/window_presets.h"

class QComboBox;

namespace tidemark::ui {

class SliderNumber;

class WindowControls : public CaseWidget {
  Q_OBJECT
 public:
  explicit WindowControls(QWidget* parent = nullptr);

 protected:
  void attach() override;
  void refresh() override;

 private:
  SliderNumber* width_;
  SliderNumber* level_;
  QComboBox* preset_;
  std::vector<WindowPreset> presets_;
};

}  // namespace tidemark::ui
