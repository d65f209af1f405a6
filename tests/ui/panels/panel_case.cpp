#include "tests/ui/panels/panel_case.h"

#include <QCoreApplication>

namespace tidemark::test {

void show(QWidget& widget) {
  widget.show();
  widget.activateWindow();
  if (!QTest::qWaitForWindowActive(&widget)) qFatal("the window does not show");
}

PanelCase::PanelCase() : session(std::make_unique<CaseSession>(engine, ball_study(), ExecutorKind::host)) {
  session->display().change([this](DisplaySettings& settings) { settings.cursor_mm = middle(); });
  settle();
}

void PanelCase::settle() {
  QCoreApplication::processEvents();  // editors in tables hand over what was typed a moment later
  static_cast<void>(QTest::qWaitFor([this] { return engine.idle(); }, 60000));
  QCoreApplication::sendPostedEvents();
  QCoreApplication::processEvents();
}

void PanelCase::begin(double radius_mm) {
  Start start;
  start.seeds.push_back({middle(), radius_mm});
  session->begin(start);
  settle();
}

glm::dvec3 PanelCase::middle() const {
  return middle_of(session->volume().geometry);
}

}  // namespace tidemark::test
