// The prediction of a ball's radius: closed formulas, the solver, and where it ends.
#include "document/prediction.h"

#include <algorithm>

#include "solver/ball.h"
#include "solver/statistics.h"
#include "tests/document/cases.h"
#include "tests/support/test_program.h"

namespace tidemark::test::prediction_test {

using document::Prediction;

namespace {

constexpr double kTissue = 100.0;

// Everywhere the same value, but for what is beyond so many mm from the middle.
std::shared_ptr<const Volume> even_volume(Index3 size, glm::dvec3 spacing = glm::dvec3(1.0),
                                          double tissue_mm = 1e9) {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = size;
  volume->geometry.spacing_mm = spacing;
  const glm::dvec3 middle = volume->geometry.to_patient(0.5 * glm::dvec3(size - Index3(1)));
  std::vector<float> voxels;
  for (std::int64_t offset = 0; offset < volume->geometry.voxel_count(); ++offset) {
    const double distance =
        glm::distance(volume->geometry.to_patient(volume->geometry.voxel_at(offset)), middle);
    voxels.push_back(distance < tissue_mm ? static_cast<float>(kTissue) : -50.0F);
  }
  volume->voxels = std::move(voxels);
  return volume;
}

// D is `data_speed` in the tissue.
solver::Parameters parameters_of(double alpha, double data_speed) {
  solver::Parameters parameters;
  parameters.alpha = alpha;
  parameters.range = 40.0;
  parameters.target = kTissue + (1.0 - data_speed) * parameters.range;
  return parameters;
}

struct Run {
  std::shared_ptr<const Volume> volume;
  std::unique_ptr<solver::Executor> executor;
  std::int64_t step = 0;

  Run(std::shared_ptr<const Volume> source, const solver::Parameters& parameters, double radius_mm,
      glm::dvec3 off_mm = glm::dvec3(0.0))
      : volume(std::move(source)) {
    solver::ExecutorOptions options;
    options.threads = 1;
    executor =
        std::move(solver::make_executor(solver::ExecutorKind::host, volume, parameters, options).value());
    if (!executor->paint(ball_at(*volume, off_mm, radius_mm), solver::Brush::add)) qFatal("paint failed");
  }

  solver::StepInputs inputs() const {
    return {std::make_shared<const solver::Field>(executor->snapshot().value()),
            volume,
            executor->parameters(),
            executor->speed(),
            executor->constraints(),
            executor->time_step()};
  }
  Prediction prediction() const { return document::predict(inputs(), step).value(); }
  void advance(std::int64_t steps) {
    if (!executor->advance({.steps = steps})) qFatal("advance failed");
    step += steps;
  }
  double radius_mm() const {
    return solver::radius_of_ball_mm(solver::measure(executor->snapshot().value()).volume_ml);
  }
};

}  // namespace

class PredictionTest : public QObject {
  Q_OBJECT

 private slots:
  void the_law_has_its_closed_forms() {
    solver::Parameters parameters = parameters_of(0.0, 1.0);
    // sqrt(R0^2 - 4 t) in voxels of 1 mm, and in voxels of half a millimetre.
    QVERIFY(std::abs(solver::ball_law(parameters, 1.0, 1.0).radius_after(10.0, 9.0) - 8.0) < 1e-12);
    QVERIFY(std::abs(solver::ball_law(parameters, 1.0, 0.5).radius_after(5.0, 9.0) - 4.0) < 1e-12);
    QCOMPARE(solver::ball_law(parameters, 1.0, 1.0).radius_after(10.0, 26.0), 0.0);
    parameters.alpha = 0.6;
    parameters.curvature_term = false;
    QVERIFY(std::abs(solver::ball_law(parameters, 0.5, 2.0).radius_after(10.0, 5.0) - 13.0) < 1e-12);
    QVERIFY(!solver::ball_law(parameters, 0.5, 2.0).critical_radius_mm());
  }

  // t = (R - R0) / g + s / g^2 ln((g R - s) / (g R0 - s)).
  void both_terms_are_integrated_as_their_implicit_solution_says() {
    const solver::BallLaw law = solver::ball_law(parameters_of(0.5, 0.8), 0.8, 1.0);
    const double g = law.growth;
    const double s = law.shrinking;
    QVERIFY(std::abs(*law.critical_radius_mm() - 2.5) < 1e-12);
    for (const double from : {2.0, 3.0, 12.0}) {
      for (const double time : {0.5, 2.0}) {
        const double to = law.radius_after(from, time);
        QVERIFY(to > 0.0);
        const double back = (to - from) / g + s / (g * g) * std::log((g * to - s) / (g * from - s));
        QVERIFY2(std::abs(back - time) < 1e-6, qPrintable(QString::number(back)));
      }
    }
    QCOMPARE(law.radius_after(2.0, 50.0), 0.0);
    QVERIFY(std::abs(law.radius_after(2.5, 50.0) - 2.5) < 1e-9);
  }

  void the_solver_keeps_to_it_data() {
    QTest::addColumn<double>("alpha");
    QTest::addColumn<double>("data_speed");
    QTest::addColumn<double>("radius_mm");
    QTest::addColumn<double>("until_mm");  // the radius
    QTest::addColumn<glm::dvec3>("spacing");
    QTest::addColumn<bool>("rescaling");
    // How far the radius may be from the law: in parts of it, and of the way that the front has gone. The law
    // is that of the equation. Upwind differences are of first order, and rescaling in a band of 2.5 voxels
    // draws the surface inwards, so that the longer way is the less exact one.
    QTest::addColumn<double>("of_radius");
    QTest::addColumn<double>("of_way");
    const glm::dvec3 cubes(1.0);
    QTest::newRow("curvature") << 0.0 << 1.0 << 12.0 << 4.0 << cubes << false << 0.02 << 0.01;
    QTest::newRow("curvature, larger") << 0.0 << 1.0 << 20.0 << 4.0 << cubes << false << 0.02 << 0.01;
    QTest::newRow("curvature, half the spacing")
        << 0.0 << 1.0 << 6.0 << 2.0 << 0.5 * cubes << false << 0.02 << 0.01;
    QTest::newRow("curvature, thick slices")
        << 0.0 << 1.0 << 14.0 << 8.0 << glm::dvec3(1, 1, 2) << false << 0.02 << 0.03;
    QTest::newRow("curvature, rescaled") << 0.0 << 1.0 << 12.0 << 6.0 << cubes << true << 0.02 << 0.05;
    QTest::newRow("curvature, rescaled, to the end")
        << 0.0 << 1.0 << 20.0 << 4.0 << cubes << true << 0.15 << 0.05;
    QTest::newRow("data, outward") << 1.0 << 1.0 << 8.0 << 22.0 << cubes << true << 0.025 << 0.05;
    QTest::newRow("data, slowly") << 1.0 << 0.3 << 8.0 << 20.0 << cubes << true << 0.025 << 0.05;
    QTest::newRow("data, inward") << 1.0 << -1.0 << 20.0 << 10.0 << cubes << true << 0.025 << 0.04;
    QTest::newRow("both, outward") << 0.5 << 1.0 << 8.0 << 22.0 << cubes << true << 0.04 << 0.08;
    QTest::newRow("both, inward against growth")
        << 0.2 << 0.2 << 12.0 << 7.0 << cubes << true << 0.04 << 0.06;
    QTest::newRow("both, inward") << 0.6 << -0.7 << 20.0 << 10.0 << cubes << true << 0.025 << 0.04;
    QTest::newRow("both, thick slices")
        << 0.6 << 1.0 << 9.0 << 20.0 << glm::dvec3(1, 1, 2) << true << 0.04 << 0.08;
  }

  void the_solver_keeps_to_it() {
    QFETCH(double, alpha);
    QFETCH(double, data_speed);
    QFETCH(double, radius_mm);
    QFETCH(double, until_mm);
    QFETCH(glm::dvec3, spacing);
    QFETCH(bool, rescaling);
    QFETCH(double, of_radius);
    QFETCH(double, of_way);
    solver::Parameters parameters = parameters_of(alpha, data_speed);
    parameters.rescaling_term = rescaling;
    const double wide_mm = radius_mm > 6.0 ? 52.0 : 20.0;
    Run run(even_volume(Index3(glm::ceil(wide_mm / spacing)), spacing), parameters, radius_mm);
    const Prediction prediction = run.prediction();
    QVERIFY(prediction.holds());
    const double from_mm = prediction.points.front().radius_mm;
    QVERIFY(std::abs(from_mm - radius_mm) < 0.01 * radius_mm);
    if (alpha > 0.0) QVERIFY(std::abs(prediction.data_speed - data_speed) < 1e-5);
    const bool grows = until_mm > radius_mm;
    const auto goes_on = [&](double at_mm) { return grows ? at_mm < until_mm : at_mm > until_mm; };
    double worst = 0.0;
    double last = 0.0;
    double now = from_mm;
    while (goes_on(now) && run.step < 2000) {
      const auto predicted = prediction.radius_at(run.step);
      QVERIFY2(predicted, qPrintable(QString("nothing at step %1, radius %2").arg(run.step).arg(now)));
      worst = std::max(worst, std::abs(now / *predicted - 1.0));
      last =
          std::abs(now - *predicted) / std::max(std::abs(now - from_mm), 0.5 * std::abs(until_mm - from_mm));
      run.advance(4);
      now = run.radius_mm();
    }
    QVERIFY2(!goes_on(now), qPrintable(QString::number(now)));
    qInfo("at most %.2f %% of the radius, in the end %.2f %% of the way", 100.0 * worst, 100.0 * last);
    QVERIFY2(worst < of_radius, qPrintable(QString::number(worst)));
    QVERIFY2(last < of_way, qPrintable(QString::number(last)));
    // It is still a ball for it.
    QVERIFY(run.prediction().holds());
  }

  // From the present radius, with what holds from there on.
  void it_begins_anew_in_the_middle_of_a_run() {
    Run run(even_volume(Index3(48)), parameters_of(1.0, 1.0), 8.0);
    run.advance(30);
    QVERIFY(run.executor->set_parameters(parameters_of(0.0, 1.0)));
    const Prediction prediction = run.prediction();
    QVERIFY(prediction.holds());
    QCOMPARE(prediction.points.front().step, std::int64_t{30});
    QVERIFY(std::abs(prediction.points.front().radius_mm - run.radius_mm()) < 1e-9);
    QCOMPARE(prediction.end, Prediction::End::vanishes);
    QCOMPARE(prediction.points.back().radius_mm, 0.0);
    run.advance(40);
    QVERIFY(std::abs(run.radius_mm() / *prediction.radius_at(70) - 1.0) < 0.02);
  }

  void it_ends_where_other_tissue_begins() {
    const Run run(even_volume(Index3(48), glm::dvec3(1.0), 14.0), parameters_of(0.8, 1.0), 8.0);
    const Prediction prediction = run.prediction();
    QVERIFY(prediction.holds());
    QCOMPARE(prediction.end, Prediction::End::tissue);
    QVERIFY(std::abs(prediction.points.back().radius_mm - 14.0) < 1.5);
    QVERIFY(!prediction.radius_at(prediction.points.back().step + 1));
    QVERIFY(!prediction.radius_at(-1));
  }

  void it_ends_at_the_volumes_border() {
    const Run run(even_volume(Index3(48)), parameters_of(0.8, 1.0), 8.0, {3.0, 0.0, 0.0});
    const Prediction prediction = run.prediction();
    QCOMPARE(prediction.end, Prediction::End::border);
    QVERIFY(std::abs(prediction.points.back().radius_mm - 20.5) < 0.1);
  }

  void it_ends_at_a_wall() {
    Run run(even_volume(Index3(48)), parameters_of(0.8, 1.0), 8.0);
    auto walls = std::make_shared<solver::Constraints>(run.volume->geometry.size);
    walls->set(run.volume->geometry, ball_at(*run.volume, {15.0, 0.0, 0.0}, 2.0), solver::Constraint::wall);
    QVERIFY(run.executor->set_constraints(walls));
    const Prediction prediction = run.prediction();
    QCOMPARE(prediction.end, Prediction::End::tissue);
    QVERIFY(std::abs(prediction.points.back().radius_mm - 13.0) < 1.5);
    walls = std::make_shared<solver::Constraints>(*walls);
    walls->set(run.volume->geometry, ball_at(*run.volume, {9.0, 0.5, 0.5}, 0.6), solver::Constraint::wall);
    QVERIFY(run.executor->set_constraints(walls));
    QCOMPARE(run.prediction().obstacle, Prediction::Obstacle::held);
  }

  void where_no_law_holds_there_is_none() {
    Run two(even_volume(Index3(48)), parameters_of(0.8, 1.0), 6.0, {-9.0, 0.0, 0.0});
    QVERIFY(two.prediction().holds());
    QVERIFY(two.executor->paint(ball_at(*two.volume, {9.0, 0.0, 0.0}, 6.0), solver::Brush::add));
    QCOMPARE(two.prediction().obstacle, Prediction::Obstacle::shape);

    const Run cut(even_volume(Index3(48)), parameters_of(0.8, 1.0), 8.0, {20.0, 0.0, 0.0});
    QCOMPARE(cut.prediction().obstacle, Prediction::Obstacle::shape);

    const Run tiny(even_volume(Index3(48)), parameters_of(0.8, 1.0), 1.5);
    QCOMPARE(tiny.prediction().obstacle, Prediction::Obstacle::shape);

    const Run lumpy(lumpy_volume(), lumpy_parameters(), 8.0);
    QCOMPARE(lumpy.prediction().obstacle, Prediction::Obstacle::speed);
    // Without the data term its brightness does not matter.
    solver::Parameters curvature = lumpy_parameters();
    curvature.data_term = false;
    QVERIFY(Run(lumpy_volume(), curvature, 8.0).prediction().holds());
  }

  void a_stop_is_told() {
    std::stop_source stop;
    stop.request_stop();
    const Run run(even_volume(Index3(32)), parameters_of(0.5, 1.0), 8.0);
    const auto predicted = document::predict(run.inputs(), 0, {nullptr, stop.get_token()});
    QCOMPARE(predicted.error().kind, ErrorKind::cancelled);
  }
};

TIDEMARK_TEST(PredictionTest)

}  // namespace tidemark::test::prediction_test

#include "prediction_test.moc"
