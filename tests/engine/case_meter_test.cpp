// Figures that are taken while a case runs.
#include "engine/case_meter.h"

#include <random>

#include "tests/document/cases.h"
#include "tests/support/test_program.h"

namespace tidemark::test::case_meter_test {

namespace {

// A bright ball of noise: a narrow range stops a surface inside of it.
std::shared_ptr<const Volume> noisy_ball() {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = Index3(30);
  std::mt19937 random(7);
  std::vector<std::int16_t> voxels;
  for (std::int64_t v = 0; v < volume->geometry.voxel_count(); ++v) {
    const glm::dvec3 p(v % 30, v / 30 % 30, v / 900);
    const int noise = static_cast<int>(random() % 71U) - 35;
    voxels.push_back(static_cast<std::int16_t>(glm::length(p - 14.5) < 11.0 ? 500 + noise : noise));
  }
  volume->voxels = std::move(voxels);
  return volume;
}

}  // namespace

class CaseMeterTest : public QObject {
  Q_OBJECT

  std::unique_ptr<document::Case> case_;

  Status measure(engine::CaseMeter& meter, bool thoroughly = false) {
    return meter.measure([this] { return case_->level_set().checkpoint(); }, *case_, thoroughly);
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

  void a_wider_range_is_offered_only_where_the_range_drives_the_surface() {
    case_ = make_case(noisy_ball());
    document::LevelSet& level_set = case_->level_set();
    solver::Parameters parameters;
    parameters.target = 500.0;
    parameters.range = 18.0;  // of values up to 35 away
    parameters.alpha = 0.95;
    QCOMPARE(failure(level_set.set_parameters(parameters)), QString());
    document::Start start;
    start.seeds = {ball_at(*case_->volume(), glm::dvec3(0.0), 5.0)};
    QCOMPARE(failure(level_set.begin(start)), QString());
    engine::CaseMeter meter;
    const auto report = level_set.advance({.steps = 4000, .until_converged = true});
    QCOMPARE(failure(report), QString());
    QVERIFY(report->converged);
    meter.computed(*report, level_set.step());
    engine::CaseState state;
    QCOMPARE(failure(measure(meter, true)), QString());
    meter.report(state);
    QCOMPARE(state.outcome, document::Outcome::converged);
    QVERIFY(state.wider_range && *state.wider_range > parameters.range);

    document::Drive drive;
    drive.setting.terms = {{"edges", {}}};
    QCOMPARE(failure(level_set.set_drive(drive)), QString());
    auto speed = document::make_speed(drive, level_set.source(), parameters);
    QCOMPARE(failure(speed), QString());
    QCOMPARE(failure(level_set.set_speed(*speed)), QString());
    QCOMPARE(failure(measure(meter, true)), QString());
    meter.report(state);
    QCOMPARE(state.outcome, document::Outcome::converged);
    QVERIFY(!state.wider_range);
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

}  // namespace tidemark::test::case_meter_test

#include "case_meter_test.moc"
