// A speed function is made in the background and drives the surface from then on.
#include <QTest>
#include <algorithm>

#include "engine/case_proxy.h"
#include "engine/speed_sampler.h"
#include "solver/speed/speed_registry.h"
#include "tests/engine/ball_study.h"
#include "tests/support/test_program.h"

namespace tidemark::test {

class CaseDriveTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    engine_ = std::make_unique<engine::Engine>(false);
    proxy_ = std::make_unique<engine::CaseProxy>(*engine_, ball_study(), solver::ExecutorKind::host);
    failures_.clear();
    connect(proxy_.get(), &engine::CaseProxy::failed, this, [this](const QString& why) { failures_ += why; });
    wait_until_idle();
  }
  void cleanup() {
    proxy_.reset();
    engine_.reset();
  }

  void a_function_is_made_and_undone() {
    document::Drive drive = proxy_->drive();
    drive.setting.terms = {{"edges", {}}};
    proxy_->set_drive(drive);
    QCOMPARE(proxy_->drive().setting, drive.setting);  // the wish, at once
    QTRY_VERIFY(proxy_->state().speed && !proxy_->state().speed_waits);
    QVERIFY(failures_.isEmpty());
    QCOMPARE(proxy_->state().drive.setting, drive.setting);
    const auto first = proxy_->state().speed;

    // Numbers of one gesture are one entry.
    for (const double sigma : {0.8, 1.2, 1.5}) {
      drive.setting.terms.front().values[solver::speed_kind("edges")->parameters.front().name] = sigma;
      proxy_->set_drive(drive, 99);
    }
    QTRY_VERIFY(proxy_->state().speed != first && !proxy_->state().speed_waits);
    proxy_->undo();
    QTRY_VERIFY(proxy_->state().drive.setting.terms.front().values.empty());
    QTRY_VERIFY(!proxy_->state().speed_waits);
    proxy_->undo();
    QTRY_VERIFY(proxy_->state().drive.setting.is_tent());
    QVERIFY(!proxy_->state().speed);
    QCOMPARE(proxy_->drive().setting, solver::SpeedSetting());
    QVERIFY(failures_.isEmpty());
  }

  void a_function_that_follows_the_surface_is_seen_before_the_first_step() {
    const glm::dvec3 middle = renderer::middle_of(proxy_->volume().geometry);
    const auto speed_at = [&](glm::dvec3 place_mm) {
      double speed = 0.0;
      const Index3 voxel(glm::round(proxy_->volume().geometry.to_voxel(place_mm)));
      if (proxy_->state().speed) proxy_->state().speed->evaluate({voxel, Index3(1)}, &speed);
      return speed;
    };
    document::Drive drive = proxy_->drive();
    drive.setting.terms = {{"regions", {}}};
    proxy_->set_drive(drive);
    QTRY_VERIFY(proxy_->state().speed && !proxy_->state().speed_waits);
    QCOMPARE(speed_at(middle), 0.0);  // there is no surface to follow
    document::Start start;
    start.seeds.push_back({middle, 6.0});
    proxy_->begin(start);
    QTRY_VERIFY(speed_at(middle) > 0.5);
    QVERIFY(speed_at(middle + glm::dvec3(1.8 * kBallRadius, 0.0, 0.0)) < -0.5);
    QCOMPARE(proxy_->state().step, std::int64_t{0});
    // Paint moves the means, before a step does.
    const double before = speed_at(middle);
    proxy_->paint({middle + glm::dvec3(1.2 * kBallRadius, 0.0, 0.0), 8.0}, solver::Brush::add, 7);
    QTRY_VERIFY(speed_at(middle) != before);
    QCOMPARE(proxy_->state().step, std::int64_t{0});
    proxy_->step(1);
    QTRY_COMPARE(proxy_->state().step, std::int64_t{1});
    QVERIFY(speed_at(middle) > 0.5);
    QVERIFY(failures_.isEmpty());
  }

  void one_that_cannot_be_made_is_told_of_and_the_surface_waits() {
    document::Start start;
    start.seeds.push_back({renderer::middle_of(proxy_->volume().geometry), 4.0});
    proxy_->begin(start);
    document::Drive drive = proxy_->drive();
    drive.setting.terms = {{"image", {}}};  // there is no map
    proxy_->set_drive(drive);
    QTRY_COMPARE(failures_.size(), 1);
    QVERIFY2(failures_.front().contains("map"), qPrintable(failures_.front()));
    proxy_->play();
    QTRY_COMPARE(failures_.size(), 2);
    QTRY_VERIFY(!proxy_->state().playing);
    QCOMPARE(proxy_->state().step, std::int64_t{0});
    // With the tent it goes on.
    proxy_->set_drive({});
    proxy_->play();
    QTRY_VERIFY(proxy_->state().step > 0);
    QCOMPARE(failures_.size(), 2);
  }

  void samples_come_from_another_thread() {
    document::Drive drive = proxy_->drive();
    drive.setting.terms = {{"edges", {}}};
    proxy_->set_drive(drive);
    QTRY_VERIFY(proxy_->state().speed);
    engine::SpeedSampler sampler;
    const Index3 size = proxy_->volume().geometry.size;
    const Index3 slice(size.x, size.y, 1);
    sampler.ask({proxy_->state().speed, {0, 0, 3}, slice});
    sampler.ask({proxy_->state().speed, {0, 0, size.z / 2}, slice});  // the newest wins
    QVERIFY(!sampler.answer());
    QTRY_VERIFY(sampler.answer());
    std::vector<double> expected(static_cast<std::size_t>(size.x * size.y));
    proxy_->state().speed->evaluate({{0, 0, size.z / 2}, slice}, expected.data());
    QVERIFY(*sampler.answer() == expected);
    QVERIFY(std::ranges::any_of(expected, [&](double value) { return value != expected.front(); }));
    sampler.ask({});
    QVERIFY(!sampler.answer());
  }

 private:
  void wait_until_idle() {
    QVERIFY(QTest::qWaitFor([this] { return engine_->idle(); }, 60000));
    QCoreApplication::processEvents();
  }

  std::unique_ptr<engine::Engine> engine_;
  std::unique_ptr<engine::CaseProxy> proxy_;
  QStringList failures_;
};

}  // namespace tidemark::test

TIDEMARK_TEST(tidemark::test::CaseDriveTest)
#include "case_drive_test.moc"
