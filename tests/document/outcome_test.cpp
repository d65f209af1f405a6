// What has become of a surface, and whether its range is too narrow.
#include "document/outcome.h"

#include <glm/common.hpp>

#include "document/start.h"
#include "imaging/phantom/phantom.h"
#include "solver/executor.h"
#include "solver/speed/motion_limit.h"
#include "solver/statistics.h"
#include "tests/document/cases.h"
#include "tests/support/test_program.h"

namespace tidemark::test::outcome_test {

namespace {

struct Ended {
  document::Outcome outcome = document::Outcome::unfinished;
  std::optional<double> wider_range;
  solver::SurfaceStatistics surface;
};

// From a ball of `radius_mm` around `voxel`, or from `start`, for at most so many steps.
Ended run(const std::shared_ptr<const Volume>& source, const solver::Parameters& parameters,
          const document::Start& start, std::int64_t steps = solver::kMostStepsToRest) {
  auto executor = solver::make_executor(solver::ExecutorKind::host, source, parameters);
  if (!executor) qFatal("%s", executor.error().message.c_str());
  const auto constraints = document::joined(nullptr, start.limit().get());
  if (!(*executor)->set_constraints(constraints)) qFatal("no constraints");
  const auto begun = begin(**executor, {*source}, start);
  if (!begun) qFatal("%s", begun.error().message.c_str());
  const auto report = (*executor)->advance({.steps = steps, .until_converged = true});
  const auto phi = (*executor)->snapshot();
  if (!report || !phi) qFatal("no run");
  Ended ended;
  ended.surface = solver::measure(*phi);
  const document::EvolvedSurface evolved{*phi,
                                         ended.surface.voxels_inside,
                                         report->steps,
                                         report->converged,
                                         &*begun,
                                         *source,
                                         parameters,
                                         nullptr,
                                         constraints.get()};
  ended.outcome = document::outcome_of(evolved);
  ended.wider_range = document::wider_range(evolved);
  return ended;
}

document::Start ball_of(const Volume& volume, glm::dvec3 voxel, double radius_mm) {
  document::Start start;
  start.seeds.push_back({volume.geometry.to_patient(voxel), radius_mm});
  return start;
}

// 100 in the half x < 20, 0 in the other.
std::shared_ptr<const Volume> halves() {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = Index3(40);
  std::vector<std::int16_t> voxels;
  for (std::int64_t offset = 0; offset < volume->geometry.voxel_count(); ++offset) {
    voxels.push_back(offset % 40 < 20 ? std::int16_t{100} : std::int16_t{0});
  }
  volume->voxels = std::move(voxels);
  return volume;
}

solver::Parameters attracting(double target, double range, double alpha = 0.8) {
  solver::Parameters parameters;
  parameters.target = target;
  parameters.range = range;
  parameters.alpha = alpha;
  return parameters;
}

struct PhantomRun {
  std::shared_ptr<const Volume> volume;
  solver::Parameters parameters;
  document::Start start;
};

PhantomRun phantom_run(std::string_view kind) {
  imaging::Phantom phantom = *imaging::make_phantom(kind);
  PhantomRun run;
  run.parameters = attracting(phantom.target, phantom.range, phantom.alpha);
  run.volume = std::make_shared<const Volume>(std::move(phantom.volume));
  if (phantom.init_threshold) {
    run.start.from = document::ThresholdStart{phantom.init_threshold->first, phantom.init_threshold->second};
  } else {
    const auto& seed = *phantom.seed;
    run.start = ball_of(*run.volume, {seed[0], seed[1], seed[2]}, seed[3]);
  }
  return run;
}

}  // namespace

class OutcomeTest : public QObject {
  Q_OBJECT

 private slots:
  void what_has_become_of_a_surface_has_a_name_data() {
    QTest::addColumn<double>("target");
    QTest::addColumn<double>("range");
    QTest::addColumn<double>("alpha");
    QTest::addColumn<int>("x");
    QTest::addColumn<int>("steps");
    QTest::addColumn<QString>("name");
    QTest::newRow("stops at the border") << 100.0 << 50.0 << 0.8 << 8 << 4000 << "converged";
    QTest::newRow("still on its way") << 100.0 << 50.0 << 0.8 << 8 << 5 << "unfinished";
    QTest::newRow("no step yet") << 100.0 << 50.0 << 0.8 << 8 << 0 << "unfinished";
    QTest::newRow("curvature alone") << 100.0 << 50.0 << 0.0 << 8 << 4000 << "vanished";
    QTest::newRow("too much curvature") << 100.0 << 50.0 << 0.1 << 8 << 4000 << "vanished";
    QTest::newRow("in the other half") << 100.0 << 50.0 << 0.8 << 32 << 4000 << "seeded_outside";
    QTest::newRow("everything attracts") << 50.0 << 200.0 << 0.8 << 8 << 4000 << "filled_volume";
  }
  void what_has_become_of_a_surface_has_a_name() {
    QFETCH(double, target);
    QFETCH(double, range);
    QFETCH(double, alpha);
    QFETCH(int, x);
    QFETCH(int, steps);
    QFETCH(QString, name);
    const auto volume = halves();
    const Ended ended =
        run(volume, attracting(target, range, alpha), ball_of(*volume, {x, 20, 20}, 5.0), steps);
    const std::string_view found = document::name_of(ended.outcome);
    QCOMPARE(QString::fromUtf8(found.data(), static_cast<qsizetype>(found.size())), name);
    QCOMPARE(document::has_surface(ended.outcome), name == "converged" || name == "unfinished");
    QVERIFY(!ended.wider_range);
  }

  void the_right_parameters_are_not_widened_data() {
    QTest::addColumn<int>("unused");
    for (const char* kind :
         {"sphere", "dumbbell", "bridge", "tumour", "cortex", "organ", "junction", "head"}) {
      QTest::newRow(kind) << 0;
    }
  }
  void the_right_parameters_are_not_widened() {
    const PhantomRun phantom = phantom_run(QTest::currentDataTag());
    const Ended ended = run(phantom.volume, phantom.parameters, phantom.start);
    QCOMPARE(ended.outcome, document::Outcome::converged);
    QVERIFY(!ended.wider_range);
  }

  void a_refined_mask_that_is_held_in_like_tissue_is_offered_no_range() {
    auto mask = std::make_shared<BitMask>(halves()->geometry);
    for (std::int64_t i = 0; i < mask->geometry().voxel_count(); ++i) {
      const Index3 voxel(i % 40, i / 40 % 40, i / 1600);
      const Index3 off = glm::abs(voxel - Index3(10, 20, 20));
      if (std::max({off.x, off.y, off.z}) <= 4) mask->add(i);
    }
    document::Start start;
    start.from = document::limited({mask, "box"}, 3.0).value();
    const Ended ended = run(halves(), attracting(100.0, 30.0), start);
    QCOMPARE(ended.outcome, document::Outcome::converged);
    QVERIFY(ended.surface.voxels_inside > mask->count());
    QVERIFY(!ended.wider_range);
  }

  // The noise of the tumour has a standard deviation of 20: less than that stops the surface within it.
  void what_noise_has_stopped_is_offered_a_range_that_holds_the_tissue_data() {
    QTest::addColumn<double>("range");
    QTest::newRow("a little of it is inside") << 13.0;
    QTest::newRow("half of it is inside") << 16.5;
  }
  void what_noise_has_stopped_is_offered_a_range_that_holds_the_tissue() {
    QFETCH(double, range);
    PhantomRun phantom = phantom_run("tumour");
    phantom.parameters.range = range;
    phantom.parameters.alpha = 0.95;
    const Ended narrow = run(phantom.volume, phantom.parameters, phantom.start);
    QCOMPARE(narrow.outcome, document::Outcome::converged);
    QVERIFY2(narrow.surface.volume_ml < 75.0, qPrintable(QString::number(narrow.surface.volume_ml)));
    QVERIFY(narrow.wider_range);
    QVERIFY2(*narrow.wider_range > 30.0 && *narrow.wider_range < 110.0,
             qPrintable(QString::number(*narrow.wider_range)));
    phantom.parameters.range = *narrow.wider_range;
    const Ended wide = run(phantom.volume, phantom.parameters, phantom.start);
    QCOMPARE(wide.outcome, document::Outcome::converged);
    QVERIFY(!wide.wider_range);
    // The truth is 117.6 ml.
    QVERIFY2(std::abs(wide.surface.volume_ml - 117.6) < 8.0,
             qPrintable(QString::number(wide.surface.volume_ml)));
  }
};

TIDEMARK_TEST(OutcomeTest)

}  // namespace tidemark::test::outcome_test

#include "outcome_test.moc"
