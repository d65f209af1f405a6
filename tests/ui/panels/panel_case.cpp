#include "tests/ui/panels/panel_case.h"

#include <QCoreApplication>

namespace tidemark::test {

void show(QWidget& widget) {
  widget.show();
  widget.activateWindow();
  if (!QTest::qWaitForWindowActive(&widget)) qFatal("the window does not show");
}

void drag(QWidget& widget, QPoint from, QPoint to, int moves) {
  QTest::mousePress(&widget, Qt::LeftButton, {}, from);
  for (int move = 1; move <= moves; ++move) QTest::mouseMove(&widget, from + (to - from) * move / moves);
  QTest::mouseRelease(&widget, Qt::LeftButton, {}, to);
}

PanelCase::PanelCase(std::shared_ptr<const engine::LoadedStudy> study)
    : proxy(std::make_unique<engine::CaseProxy>(engine, std::move(study), solver::ExecutorKind::host)) {
  proxy->display().change([this](engine::DisplaySettings& settings) { settings.cursor_mm = middle(); });
  wait_until_idle();
}

void PanelCase::wait_until_idle() {
  QCoreApplication::processEvents();  // editors in tables hand over what was typed a moment later
  QVERIFY2(QTest::qWaitFor([this] { return engine.idle(); }, 60000), "a surface moves, or the engine hangs");
  QCoreApplication::sendPostedEvents();
  QCoreApplication::processEvents();
}

void PanelCase::begin(double radius_mm) {
  document::Start start;
  start.seeds.push_back({middle(), radius_mm});
  proxy->begin(start);
  wait_until_idle();
}

glm::dvec3 PanelCase::middle() const {
  return renderer::middle_of(proxy->volume().geometry);
}

}  // namespace tidemark::test
