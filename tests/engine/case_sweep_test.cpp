// The sweep of a case, beside the user interface.
#include "engine/case_sweep.h"

#include <optional>

#include "tests/engine/ball_case.h"
#include "tests/support/test_program.h"

namespace tidemark::test::case_sweep_test {

class CaseSweepTest : public QObject {
  Q_OBJECT

 private slots:
  void init() {
    ball_.emplace();
    proxy_ = &ball_->proxy;
    failures_.clear();
    connect(&proxy_->sweep(), &engine::CaseSweep::failed, this,
            [this](const QString& why) { failures_ << why; });
  }
  void cleanup() { ball_.reset(); }

  void without_a_surface_there_is_nothing_to_sweep() {
    proxy_->sweep().start(axes_);
    QVERIFY(proxy_->sweep().running());
    QTRY_VERIFY(!proxy_->sweep().running());
    QCOMPARE(failures_.size(), 1);
    QVERIFY2(failures_.first().contains("a start is needed"), qPrintable(failures_.first()));
    QVERIFY(!proxy_->sweep().outcome());
  }

  void it_ends_with_pictures_and_an_agreement() {
    ball_->begin(6.0);
    proxy_->sweep().start(axes_);
    QTRY_VERIFY(!proxy_->sweep().running());
    const auto outcome = proxy_->sweep().outcome();
    QVERIFY(outcome && failures_.isEmpty());
    QCOMPARE(outcome->sweep.runs.size(), std::size_t{2});
    QCOMPARE(outcome->pictures.size(), std::size_t{2});
    QVERIFY(!outcome->pictures.front().isNull());
    // On a grid of its own, in its place in the patient.
    const auto& volume = outcome->agreement.image->volume;
    QVERIFY(volume);
    const document::Agreement& agreement = outcome->sweep.agreement;
    const Index3 off = agreement.size() / std::int64_t{2};
    const Index3 voxel = agreement.first() + off;
    QCOMPARE(volume->value(off), static_cast<float>(agreement.count(voxel)));
    const glm::dvec3 there = volume->geometry.to_patient(glm::dvec3(off));
    const glm::dvec3 wanted = proxy_->volume().geometry.to_patient(glm::dvec3(voxel));
    QVERIFY(glm::length(there - wanted) < 1e-9);

    // It is there until the next one is, and a run of it can be taken.
    proxy_->sweep().start({{"range", 0.5 * proxy_->parameters().range, proxy_->parameters().range, 3}});
    QVERIFY(proxy_->sweep().outcome() == outcome);
    QTRY_VERIFY(!proxy_->sweep().running());
    QCOMPARE(proxy_->sweep().outcome()->sweep.runs.size(), std::size_t{3});
    proxy_->sweep().take(2, 0);
    const document::SweepRun& run = proxy_->sweep().outcome()->sweep.at(2, 0);
    QTRY_COMPARE(proxy_->state().step, run.steps);
    QTRY_VERIFY(ball_->engine.idle());
    QVERIFY(proxy_->state().parameters == run.parameters);
    QTRY_COMPARE(proxy_->state().outcome, run.outcome);
  }

  void it_is_given_up_at_once() {
    ball_->begin(6.0);
    int cancelled = 0;
    connect(&proxy_->sweep(), &engine::CaseSweep::cancelled, this, [&] { ++cancelled; });
    proxy_->sweep().start(axes_);
    proxy_->sweep().cancel();  // before the start has come from the engine
    QVERIFY(!proxy_->sweep().running());
    QCOMPARE(cancelled, 1);
    QTest::qWait(100);
    QVERIFY(!proxy_->sweep().running() && !proxy_->sweep().outcome());
  }

  void it_ends_where_its_case_cannot_go_on() {
    engine::Engine engine(false);
    engine::CaseProxy proxy(engine, hopeless_study(), solver::ExecutorKind::host);
    engine::CaseSweep& sweep = proxy.sweep();
    int cancelled = 0;
    connect(&sweep, &engine::CaseSweep::cancelled, this, [&] { ++cancelled; });
    sweep.start(axes_);
    QVERIFY(sweep.running());
    QTRY_VERIFY(!sweep.running());
    QCOMPARE(cancelled, 1);
    QVERIFY(!sweep.outcome());
  }

 private:
  const std::vector<document::SweepAxis> axes_{{"alpha", 0.4, 0.9, 2}};
  std::optional<BallCase> ball_;
  engine::CaseProxy* proxy_ = nullptr;  // its
  QStringList failures_;
};

TIDEMARK_TEST(CaseSweepTest)

}  // namespace tidemark::test::case_sweep_test

#include "case_sweep_test.moc"
