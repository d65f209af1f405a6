#include "tests/ui/panels/panel_case.h"

#include <QCoreApplication>

namespace tidemark::test {

void show(QWidget& widget) {
  widget.show();
  widget.activateWindow();
  if (!QTest::qWaitForWindowActive(&widget)) qFatal("the window does not show");
}

PanelCase::PanelCase() : proxy(std::make_unique<CaseProxy>(engine, ball_study(), ExecutorKind::host)) {
  proxy->display().change([this](DisplaySettings& settings) { settings.cursor_mm = middle(); });
  wait_until_idle();
}

void PanelCase::wait_until_idle() {
  QCoreApplication::processEvents();  // editors in tables hand over what was typed a moment later
  static_cast<void>(QTest::qWaitFor([this] { return engine.idle(); }, 60000));
  QCoreApplication::sendPostedEvents();
  QCoreApplication::processEvents();
}

void PanelCase::begin(double radius_mm) {
  Start start;
  start.seeds.push_back({middle(), radius_mm});
  proxy->begin(start);
  wait_until_idle();
}

glm::dvec3 PanelCase::middle() const {
  return middle_of(proxy->volume().geometry);
}

}  // namespace tidemark::test
