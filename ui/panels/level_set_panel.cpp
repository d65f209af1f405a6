#include "ui/panels/level_set_panel.h"

#include "ui/panels/balance_controls.h"
#include "ui/panels/change_controls.h"
#include "ui/panels/evolution_curves.h"
#include "ui/panels/evolution_figures.h"
#include "ui/panels/example_controls.h"
#include "ui/panels/function_controls.h"
#include "ui/panels/gradient_figures.h"
#include "ui/panels/profile_controls.h"
#include "ui/panels/speed_controls.h"
#include "ui/panels/speed_details.h"

namespace tidemark::ui {

LevelSetPanel::LevelSetPanel(QWidget* parent)
    : Panel(tr("Open a study to steer a level set in it."), parent), evolution_(new EvolutionControls) {
  add(evolution_);
  add(new ChangeControls);
  add(new FunctionControls);
  add(new ExampleControls);
  add(new SpeedControls);
  add(new BalanceControls);
  add(new SpeedDetails);
  add(new EvolutionFigures);
  add(new EvolutionCurves);
  add(new GradientFigures);
  add(new ProfileControls);
}

}  // namespace tidemark::ui
