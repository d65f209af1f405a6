// The panel Level set, which steers and watches the evolution.
#pragma once

#include "ui/panels/evolution_controls.h"
#include "ui/panels/panel.h"

namespace tidemark::ui {

class LevelSetPanel : public Panel {
  Q_OBJECT
 public:
  explicit LevelSetPanel(QWidget* parent = nullptr);

  void set_actions(const EvolutionActions& actions) { evolution_->set_actions(actions); }

 private:
  EvolutionControls* evolution_;
};

}  // namespace tidemark::ui
