// A case of the ball on an engine of its own, told what to do without any widget.
#pragma once

#include <QTest>

#include "engine/case_proxy.h"
#include "tests/engine/ball_study.h"
#include "tests/support/executor_rows.h"

namespace tidemark::test {

struct BallCase {
  explicit BallCase(solver::ExecutorKind executor = solver::ExecutorKind::host, bool use_opengl = false)
      : engine(use_opengl), proxy(engine, ball_study(), executor) {
    QObject::connect(&proxy, &engine::CaseProxy::failed, [this](const QString& why) { failures += why; });
    wait_until_idle();
  }

  [[nodiscard]] glm::dvec3 middle() const { return renderer::middle_of(proxy.volume().geometry); }
  void begin(double radius_mm = 4.0) {
    document::Start start;
    start.seeds.push_back({middle(), radius_mm});
    proxy.begin(start);
    wait_until_idle();
  }
  void wait_until_idle() {
    static_cast<void>(QTest::qWaitFor([this] { return engine.idle(); }, 60'000));
    QCoreApplication::processEvents();
  }

  engine::Engine engine;
  engine::CaseProxy proxy;
  QStringList failures;
};

}  // namespace tidemark::test
