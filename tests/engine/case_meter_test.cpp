// Figures that are taken while a case runs.
#include "engine/case_meter.h"

#include "tests/document/cases.h"
#include "tests/support/test_program.h"

using namespace tidemark;
using namespace tidemark::test;

class CaseMeterTest : public QObject {
  Q_OBJECT

  std::unique_ptr<document::Case> case_;

  Status measure(engine::CaseMeter& meter) {
    return meter.measure([this] { return case_->level_set().checkpoint(); }, *case_, false);
  }
  void forty_steps(engine::CaseMeter& meter) {
    const auto report = case_->level_set().advance({.steps = 40});
    QCOMPARE(failure(report), QString());
    meter.computed(*report, case_->level_set().step());
  }

 private slots:
  void init() { case_ = begun_case(); }

  void what_is_measured_is_noted_on_the_curve() {
    engine::CaseMeter meter;
    QVERIFY(meter.due());
    QCOMPARE(failure(measure(meter)), QString());
    QVERIFY(!meter.due());
    forty_steps(meter);
    QCOMPARE(failure(measure(meter)), QString());
    const document::Curve::Points& points = *case_->level_set().curve().points();
    QCOMPARE(points.size(), std::size_t{2});
    QCOMPARE(points[0].surface_speed, 0.0);
    QVERIFY(points[1].surface_speed > 0.0);
    QCOMPARE(points[1].step, std::int64_t{40});
    QVERIFY(points[1].volume_ml > points[0].volume_ml);
    QVERIFY(points[1].surface_mm2 > points[0].surface_mm2);
  }

  void a_case_from_a_file_has_its_last_speed_until_it_moves() {
    case_->level_set().note({-1, 1.0, 2.0, 0.5});
    engine::CaseMeter meter;
    QCOMPARE(failure(measure(meter)), QString());
    QCOMPARE(case_->level_set().curve().points()->back().step, std::int64_t{0});
    QCOMPARE(case_->level_set().curve().points()->back().surface_speed, 0.5);
    forty_steps(meter);
    QCOMPARE(failure(measure(meter)), QString());
    QVERIFY(case_->level_set().curve().points()->back().surface_speed != 0.5);
  }

  void phi_that_cannot_be_read_is_an_error() {
    engine::CaseMeter meter;
    const auto lost = []() -> Result<std::shared_ptr<const solver::Field>> {
      return fail(ErrorKind::capability, "lost");
    };
    QCOMPARE(failure(meter.measure(lost, *case_, false)), QString("lost"));
    QVERIFY(case_->level_set().curve().points()->empty());
  }
};

TIDEMARK_TEST(CaseMeterTest)
#include "case_meter_test.moc"
