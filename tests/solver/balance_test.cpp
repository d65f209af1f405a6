// The balance of the speed terms at a place foretells the next step, and what would turn it.
#include "balance_check.h"
#include "phantom_problem.h"
#include "random_problem.h"
#include "settings.h"
#include "solver/speed/speed_registry.h"
#include "tests/support/test_program.h"

namespace tidemark::test::balance_test {

namespace {

struct BallScene {
  std::shared_ptr<const Volume> source;
  solver::StepInputs inputs;
};

// A ball of that radius in a source of one value, mm and voxels alike.
BallScene ball(double radius, const solver::Parameters& parameters, double value = 0.0) {
  const Geometry geometry = grid(Index3(40));
  BallScene scene{volume_of(geometry, [=](glm::dvec3) { return value; }), {}};
  const auto level_set = executor(solver::ExecutorKind::reference, scene.source, parameters);
  const glm::dvec3 centre = centre_of(geometry);
  set_phi(*level_set, geometry, [&](glm::dvec3 p) { return radius - glm::distance(p, centre); });
  scene.inputs = inputs_of(*level_set, scene.source);
  return scene;
}

glm::dvec3 place_on_ball(double radius) {
  return glm::dvec3(19.5) + radius * glm::normalize(glm::dvec3(1.0, 2.0, -1.5));
}

double sum_with(solver::StepInputs inputs, const solver::Parameters& parameters, glm::dvec3 place) {
  inputs.parameters = parameters;
  return solver::PlaceBalance(inputs, place).balance().pushes.sum();
}

}  // namespace

class BalanceTest : public QObject {
  Q_OBJECT

 private slots:
  void a_phantoms_next_step_is_the_sum_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<int>("steps");
    QTest::addColumn<int>("executor");
    const auto row = [](const char* kind, int steps, solver::ExecutorKind executor, const char* name) {
      QTest::newRow(name) << QString::fromLatin1(kind) << steps << static_cast<int>(executor);
    };
    row("tumour", 40, solver::ExecutorKind::host, "tumour, host");
    row("organ", 40, solver::ExecutorKind::host, "organ, host");
    row("cortex", 10, solver::ExecutorKind::host, "cortex, host");
    row("sphere", 20, solver::ExecutorKind::reference, "sphere, reference");
    row("sphere", 20, solver::ExecutorKind::compute, "sphere, compute");
    row("sphere", 20, solver::ExecutorKind::stream, "sphere, stream");
  }
  void a_phantoms_next_step_is_the_sum() {
    QFETCH(QString, kind);
    QFETCH(int, steps);
    QFETCH(int, executor);
    const auto problem = PhantomProblem::make(kind.toStdString());
    QCOMPARE(failure(problem), QString());
    solver::ExecutorOptions options;
    options.skip_quiet_pages = false;
    const auto level_set = test::executor(static_cast<solver::ExecutorKind>(executor), problem->source,
                                          problem->parameters, options);
    QCOMPARE(failure(problem->begin(*level_set)), QString());
    run(*level_set, steps);
    expect_balances_foretell_a_step(*level_set, problem->source);
  }

  // Both schemes, both forms of the data term, coarse slices, terms switched off, and walls.
  void any_next_step_is_the_sum() {
    std::mt19937 random(7);
    for (int problem = 0; problem < 12; ++problem) {
      const RandomProblem drawn = random_problem(random);
      solver::ExecutorOptions options;
      options.skip_quiet_pages = false;
      const auto level_set = executor(solver::ExecutorKind::host, drawn.source, drawn.parameters, options);
      seed(*level_set, drawn.source->geometry, random);
      if (problem % 3 == 0) {
        auto walls = std::make_shared<solver::Constraints>(drawn.source->geometry.size);
        const glm::dvec3 middle = 0.5 * glm::dvec3(drawn.source->geometry.size);
        walls->set(drawn.source->geometry, solver::sphere_at_voxel(drawn.source->geometry, middle, 4.0),
                   solver::Constraint::wall);
        QCOMPARE(failure(level_set->set_constraints(walls)), QString());
      }
      run(*level_set, 5);
      const solver::StepInputs inputs = inputs_of(*level_set, drawn.source);
      run(*level_set, 1);
      const solver::Field after = level_set->snapshot().value();
      for (const glm::dvec3& place : solver::surface_places(*inputs.phi, std::nullopt, 2.0)) {
        const double foretold = inputs.time_step * solver::PlaceBalance(inputs, place).balance().pushes.sum();
        const double change = solver::phi_at(after, place) - solver::phi_at(*inputs.phi, place);
        QVERIFY2(std::abs(foretold - change) <= 0.01 * std::abs(change) + 1e-5,
                 qPrintable(QStringLiteral("problem %1: foretold %2, computed %3")
                                .arg(problem)
                                .arg(foretold)
                                .arg(change)));
      }
    }
  }

  void where_it_moves_most_is_in_a_page_that_moves() {
    // A ball that grows everywhere.
    const Geometry geometry = grid(Index3(40));
    const glm::dvec3 centre = centre_of(geometry);
    const auto source = volume_of(geometry, [](glm::dvec3 p) { return p.x > 20.0 ? 100.0 : 60.0; });
    solver::Parameters parameters;
    parameters.target = 100.0;
    parameters.range = 50.0;
    parameters.alpha = 0.9;
    const auto level_set = executor(solver::ExecutorKind::host, source, parameters);
    QCOMPARE(failure(level_set->paint({centre, 9.0}, solver::Brush::add)), QString());
    run(*level_set, 1);
    solver::StepInputs inputs = inputs_of(*level_set, source);
    QVERIFY(solver::fastest_place(inputs)->x > 20.0);
    const Index3 slow(12, 16, 16);
    const std::int64_t page = inputs.phi->layout.translate(slow).page;
    inputs.moving_pages = std::make_shared<const std::vector<std::int64_t>>(1, page);
    const glm::dvec3 place = solver::fastest_place(inputs).value();
    QCOMPARE(inputs.phi->layout.translate(Index3(place)).page, page);
    // A page without a surface says nothing.
    inputs.moving_pages = std::make_shared<const std::vector<std::int64_t>>(1, 0);
    QVERIFY(solver::fastest_place(inputs)->x > 20.0);
  }

  void advection_is_a_part_of_the_sum() {
    const Geometry geometry = grid(Index3(40));
    const glm::dvec3 centre = centre_of(geometry);
    const auto source =
        volume_of(geometry, [&](glm::dvec3 p) { return glm::distance(p, centre) < 12.0 ? 100.0 : 0.0; });
    solver::SpeedInputs made_from;
    made_from.source = source;
    const auto speed = solver::make_speed({{{"edges", {{"attraction", 1.0}}}}}, made_from);
    QCOMPARE(failure(speed), QString());
    QVERIFY((*speed)->advects());
    solver::ExecutorOptions options;
    options.skip_quiet_pages = false;
    const auto level_set = executor(solver::ExecutorKind::host, source, {}, options);
    QCOMPARE(failure(level_set->set_speed(*speed)), QString());
    set_phi(*level_set, geometry, [&](glm::dvec3 p) { return 10.5 - glm::distance(p, centre); });
    const solver::StepInputs inputs = inputs_of(*level_set, source);
    const glm::dvec3 place = glm::dvec3(19.5) + glm::dvec3(10.5, 0.0, 0.0);
    QVERIFY(std::abs(solver::PlaceBalance(inputs, place).balance().pushes.advection) > 0.05);
    expect_balances_foretell_a_step(*level_set, source);
  }

  // kappa = -2 / r, and D = 1 everywhere. Upwind gradients are of first order: a tenth off on small balls.
  void the_terms_of_a_ball_are_known() {
    solver::Parameters parameters;
    parameters.alpha = 0.25;
    const BallScene scene = ball(10.0, parameters);
    const solver::Balance balance = solver::PlaceBalance(scene.inputs, place_on_ball(10.0)).balance();
    QVERIFY(std::abs(balance.phi) < 0.05);
    QCOMPARE(balance.speed, 1.0);
    QVERIFY(std::abs(balance.pushes.data / 0.25 - 1.0) < 0.1);
    QVERIFY(std::abs(balance.pushes.curvature / (0.75 * -0.2) - 1.0) < 0.05);
    QVERIFY(std::abs(balance.pushes.rescaling) < 0.01);
    QCOMPARE(balance.pushes.limits, 0.0);
    QVERIFY(glm::distance(balance.outward, glm::normalize(glm::dvec3(1.0, 2.0, -1.5))) < 0.02);
  }

  // alpha r = 2 (1 - alpha) where D = 1.
  void the_alpha_that_turns_a_ball_is_known() {
    solver::Parameters parameters;
    parameters.alpha = 0.1;
    const BallScene scene = ball(8.0, parameters);
    const glm::dvec3 place = place_on_ball(8.0);
    const solver::PlaceBalance here(scene.inputs, place);
    QVERIFY(here.balance().pushes.sum() < 0.0);
    const auto alpha = here.alpha_for(0.0);
    QVERIFY(alpha);
    QVERIFY2(std::abs(*alpha - 0.2) < 0.02, qPrintable(QString::number(*alpha)));
    parameters.alpha = *alpha;
    QVERIFY(std::abs(sum_with(scene.inputs, parameters, place)) < 1e-6);
    // No epsilon makes D larger than 1.
    QVERIFY(!here.range_for(0.0));
    // Nor does any alpha make the surface faster than the data.
    QVERIFY(!here.alpha_for(1.5));
  }

  // D = 1 - 30 / epsilon.
  void the_range_that_turns_a_ball_is_known() {
    for (const solver::Scheme scheme : {solver::Scheme::split, solver::Scheme::paper}) {
      solver::Parameters parameters;
      parameters.alpha = 0.5;
      parameters.range = 20.0;
      parameters.scheme = scheme;
      const BallScene scene = ball(8.0, parameters, 30.0);
      const glm::dvec3 place = place_on_ball(8.0);
      const solver::PlaceBalance here(scene.inputs, place);
      QCOMPARE(here.balance().intensity, 30.0);
      const auto range = here.range_for(0.0);
      QVERIFY(range);
      QVERIFY2(std::abs(*range - 40.0) < 2.0, qPrintable(QString::number(*range)));
      parameters.range = *range + 0.5;
      QVERIFY(sum_with(scene.inputs, parameters, place) > 0.0);
      parameters.range = *range - 0.5;
      QVERIFY(sum_with(scene.inputs, parameters, place) < 0.0);
    }
  }

  void a_speed_that_is_no_tent_has_no_range() {
    solver::Parameters parameters;
    parameters.range = 20.0;
    BallScene scene = ball(8.0, parameters, 30.0);
    solver::SpeedInputs made_from;
    made_from.source = scene.source;
    made_from.parameters = parameters;
    const auto speed = solver::make_speed({{{"edges", {}}}}, made_from);
    QCOMPARE(failure(speed), QString());
    scene.inputs.speed = *speed;
    QVERIFY(!solver::PlaceBalance(scene.inputs, place_on_ball(8.0)).range_for(0.0));
  }

  // The data pushes outward at one end alone.
  void the_place_that_moves_most_is_found() {
    solver::Parameters parameters;
    parameters.alpha = 1.0;
    parameters.range = 100.0;
    BallScene scene = ball(9.0, parameters);
    scene.source =
        volume_of(scene.source->geometry, [](glm::dvec3 p) { return 100.0 - std::max(0.0, p.z - 20.0); });
    scene.inputs.source = scene.source;
    const auto place = solver::fastest_place(scene.inputs);
    QVERIFY(place);
    QVERIFY2(glm::distance(*place, glm::dvec3(19.5, 19.5, 28.5)) < 2.0,
             qPrintable(QString::number(place->z)));
    scene.inputs.phi = std::make_shared<const solver::Field>(
        solver::Field::empty(scene.source->geometry, scene.inputs.phi->band));
    QVERIFY(!solver::fastest_place(scene.inputs));
  }

  void places_lie_on_the_surface_and_in_the_slab() {
    const BallScene scene = ball(9.0, {});
    const solver::PlaneSlab slab{{0.0, 0.0, 1.0}, 19.0, 0.5};
    const auto all = solver::surface_places(*scene.inputs.phi, std::nullopt, 2.0);
    const auto cut = solver::surface_places(*scene.inputs.phi, slab, 2.0);
    QVERIFY(all.size() > 4 * cut.size() && cut.size() > 12);
    for (const glm::dvec3& place : all) QVERIFY(std::abs(glm::distance(place, glm::dvec3(19.5)) - 9.0) < 0.1);
    for (const glm::dvec3& place : cut) QVERIFY(std::abs(place.z - 19.0) <= 0.5);
  }

  void the_surface_is_found_from_the_band_and_along_a_line() {
    const BallScene scene = ball(9.0, {});
    const glm::dvec3 middle(19.5);
    const glm::dvec3 way = glm::normalize(glm::dvec3(1.0, 0.5, 0.25));
    const auto near = solver::surface_near(*scene.inputs.phi, middle + 10.5 * way, 4.0);
    QVERIFY(near && glm::distance(*near, middle + 9.0 * way) < 0.1);
    QVERIFY(!solver::surface_near(*scene.inputs.phi, middle + 14.0 * way, 4.0));
    const auto beyond = solver::surface_near(*scene.inputs.phi, middle + 14.0 * way, 8.0);
    QVERIFY(beyond && std::abs(glm::distance(*beyond, middle) - 9.0) < 0.1);
    const auto far = solver::surface_along(*scene.inputs.phi, middle + 14.0 * way, way, 6.0);
    QVERIFY(far && glm::distance(*far, middle + 9.0 * way) < 0.1);
    QVERIFY(!solver::surface_along(*scene.inputs.phi, middle + 14.0 * way, way, 4.0));
  }
};

TIDEMARK_TEST(BalanceTest)

}  // namespace tidemark::test::balance_test

#include "balance_test.moc"
