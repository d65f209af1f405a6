// The panel Labels of a desktop, for stories.
#pragma once

#include <QAbstractButton>

#include "core/region.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/panel_docks.h"
#include "ui/panels/labels_panel.h"

namespace tidemark::test {

inline void click(Desktop& desktop, QWidget& in, const QString& text) {
  auto* button = seen<QAbstractButton>(in, text);
  QVERIFY2(button->isEnabled(), qPrintable(text));
  QTest::mouseClick(button, Qt::LeftButton, {}, {8, button->height() / 2});
  desktop.wait_until_idle();
}
inline ui::LabelsPanel* shown_panel(Desktop& desktop) {
  desktop.window().panels().show("labels");
  desktop.wait_until_idle();
  auto* panel = desktop.window().findChild<ui::LabelsPanel*>();
  if (!panel || !panel->isVisible()) qFatal("there is no panel");
  return panel;
}
inline Region region(Desktop& desktop, std::uint8_t label) {
  const auto& voxels = desktop.state().label_voxels;
  return voxels ? Region(*voxels, label) : Region();
}

}  // namespace tidemark::test
