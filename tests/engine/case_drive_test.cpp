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

  void one_that_cannot_be_made_is_told_of_and_the_surface_waits() {
    begin();
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

  void undo_to_another_function_does_not_wait_for_it() {
    begin();
    proxy_->set_drive(learning(10.0));
    QTRY_VERIFY(proxy_->state().speed);
    const auto first = proxy_->state().speed;
    proxy_->set_drive(learning(200.0));
    QTRY_VERIFY(proxy_->state().speed != first && !proxy_->state().speed_waits);
    bool seen_without = false;
    connect(proxy_.get(), &engine::CaseProxy::state_changed, this,
            [&] { seen_without |= proxy_->state().speed_waits && !proxy_->state().speed; });
    proxy_->undo();
    proxy_->play();
    QTRY_VERIFY(proxy_->state().step > 0);
    QVERIFY(seen_without);
    QVERIFY(proxy_->state().speed);
    QCOMPARE(proxy_->state().drive.setting.terms.front().values.at("trees"), 10.0);
    QVERIFY(failures_.isEmpty());
  }

  void the_source_is_smoothed_while_the_surface_moves() {
    begin();
    proxy_->set_drive(learning(10.0));
    QTRY_VERIFY(proxy_->state().speed);
    const auto former = proxy_->state().speed;
    proxy_->set_pause_at_convergence(false);
    proxy_->play();
    bool seen_waiting = false;
    connect(proxy_.get(), &engine::CaseProxy::state_changed, this,
            [&] { seen_waiting |= proxy_->state().smoothing == 1.5 && proxy_->state().speed == former; });
    double reported = -1.0;
    connect(proxy_.get(), &engine::CaseProxy::progressed, this,
            [&](double fraction, const QString&) { reported = fraction; });
    proxy_->smooth_source(1.5);
    QTRY_COMPARE(proxy_->state().smoothed_mm, 1.5);
    QVERIFY(seen_waiting);
    QVERIFY(!proxy_->state().smoothing);
    QVERIFY(proxy_->state().speed && proxy_->state().speed != former);
    QVERIFY(proxy_->source() != proxy_->study().volume);
    QCOMPARE(reported, 1.0);
    const auto step = proxy_->state().step;
    QTRY_VERIFY(proxy_->state().step > step);
    QVERIFY(failures_.isEmpty());
  }

  void smoothing_can_be_given_up() {
    proxy_->smooth_source(2.0);
    proxy_->smooth_source(3.0);  // the newest wish wins
    QTRY_COMPARE(proxy_->state().smoothed_mm, 3.0);
    proxy_->smooth_source(1.0);
    proxy_->undo();
    QTRY_VERIFY(!proxy_->state().smoothing);
    wait_until_idle();
    QTest::qWait(300);
    QCOMPARE(proxy_->state().smoothed_mm, 3.0);
    proxy_->smooth_source(-1.0);
    QTRY_COMPARE(failures_.size(), 1);
    QVERIFY(!proxy_->state().smoothing);
    QCOMPARE(proxy_->state().smoothed_mm, 3.0);
  }

  void another_target_of_a_joined_tent_learns_nothing_anew() {
    begin();
    document::Drive drive = learning(10.0);
    drive.setting.terms.push_back({"tent", {}});
    proxy_->set_drive(drive);
    QTRY_VERIFY(proxy_->state().speed);
    const auto former = proxy_->state().speed;
    bool seen_waiting = false;
    connect(proxy_.get(), &engine::CaseProxy::state_changed, this,
            [&] { seen_waiting |= proxy_->state().speed_waits; });
    solver::Parameters parameters = proxy_->parameters();
    parameters.target += 30.0;
    proxy_->set_parameters(parameters);
    QTRY_VERIFY(proxy_->state().speed != former);
    wait_until_idle();
    QVERIFY(!seen_waiting);
    QCOMPARE(proxy_->state().parameters.target, parameters.target);
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
  void begin() {
    document::Start start;
    start.seeds.push_back({renderer::middle_of(proxy_->volume().geometry), 4.0});
    proxy_->begin(start);
  }
  [[nodiscard]] document::Drive learning(double trees) const {
    auto strokes = std::make_shared<solver::Strokes>();
    for (std::int64_t offset = 0; offset < proxy_->volume().geometry.voxel_count(); offset += 31)
      (proxy_->volume().value(offset) > 50.0F ? strokes->inside : strokes->outside).push_back(offset);
    document::Drive drive;
    drive.setting.terms = {{"examples", {{"trees", trees}}}};
    drive.strokes = std::move(strokes);
    return drive;
  }
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
