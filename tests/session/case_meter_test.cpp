// Figures that are taken while a case runs.
#include "session/case_meter.h"

#include "tests/support/support.h"

using namespace tidemark;

class CaseMeterTest : public QObject {
  Q_OBJECT

  std::unique_ptr<Case> case_;
  std::shared_ptr<const Field> phi_;

  void measure(CaseMeter& meter, std::int64_t step) { meter.measure(phi_, step, *case_, false); }
  static CaseState state_of(const CaseMeter& meter) {
    CaseState state;
    meter.report(state);
    return state;
  }
  static std::vector<std::int64_t> steps(const CaseState& state) {
    std::vector<std::int64_t> steps;
    for (const CurvePoint& point : *state.curve) steps.push_back(point.step);
    return steps;
  }

 private slots:
  void initTestCase() {
    const auto volume = std::make_shared<Volume>();
    volume->geometry.size = {8, 8, 8};
    volume->voxels = std::vector<std::int16_t>(512, 7);
    auto made = Case::create(volume, {}, {}, ExecutorKind::host, {});
    QCOMPARE(test::failure(made), QString());
    case_ = std::move(*made);
    phi_ = std::make_shared<const Field>(Field::empty(volume->geometry, 3.0));
  }

  void states_share_the_curve_until_it_has_another_point() {
    CaseMeter meter;
    measure(meter, 0);
    const CaseState first = state_of(meter);
    const CaseState second = state_of(meter);
    QCOMPARE(first.curve.get(), second.curve.get());
    measure(meter, 0);  // nothing has moved
    QCOMPARE(state_of(meter).curve.get(), first.curve.get());
    measure(meter, 5);
    QCOMPARE(steps(state_of(meter)), (std::vector<std::int64_t>{0, 5}));
    QCOMPARE(steps(first), std::vector<std::int64_t>{0});  // whoever has it keeps it
  }

  void a_step_back_takes_the_points_behind_it() {
    CaseMeter meter;
    for (const std::int64_t step : {0, 10, 20, 30}) measure(meter, step);
    const auto all = state_of(meter).curve;
    meter.edited(40);
    QCOMPARE(state_of(meter).curve.get(), all.get());
    meter.edited(20);
    QCOMPARE(steps(state_of(meter)), (std::vector<std::int64_t>{0, 10}));
    meter.edited(0);
    QVERIFY(state_of(meter).curve->empty());
  }

  void a_long_curve_is_thinned_and_keeps_its_newest_point() {
    CaseMeter meter;
    for (std::int64_t step = 0; step <= 2001; ++step) measure(meter, step);
    const auto curve = state_of(meter).curve;
    QVERIFY(curve->size() > 900 && curve->size() < 1100);
    QCOMPARE(curve->back().step, std::int64_t{2001});
  }
};

QTEST_GUILESS_MAIN(CaseMeterTest)
#include "case_meter_test.moc"
