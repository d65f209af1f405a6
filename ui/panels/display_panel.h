// The panel Display: how the active case is shown.
#pragma once

#include "ui/panels/panel.h"

namespace tidemark::ui {

class DisplayPanel : public Panel {
  Q_OBJECT
 public:
  explicit DisplayPanel(QWidget* parent = nullptr);
};

}  // namespace tidemark::ui
