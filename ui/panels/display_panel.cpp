#include "ui/panels/display_panel.h"

#include "ui/panels/clip_controls.h"
#include "ui/panels/image_controls.h"
#include "ui/panels/slice_controls.h"
#include "ui/panels/surface_controls.h"
#include "ui/panels/window_controls.h"

namespace tidemark::ui {

DisplayPanel::DisplayPanel(QWidget* parent) : Panel(tr("Open a study to choose how it is shown."), parent) {
  add(new WindowControls);
  add(new ImageControls);
  add(new SliceControls);
  add(new SurfaceControls);
  add(new ClipControls);
}

}  // namespace tidemark::ui
