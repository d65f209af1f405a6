// When a surface counts as stopped, row by row: what begins a new window of steps, and what keeps it open.
#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "settings.h"
#include "solver/convergence.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::convergence_test {

namespace {

// Slabs that rest where D is 0, and a tube from the side of one in which a front creeps at `kSpeed`. D
// changes slowly across the slabs' faces: where it jumps, phi is so steep that no voxel counts as beside the
// surface.
struct CreepingFront {
  static constexpr double kSpeed = 0.24;
  static constexpr double kSlabsEnd = 39.5;

  CreepingFront() {
    parameters.alpha = 1.0;
    parameters.range = 1.0;
  }
  // With T = 0 and epsilon = 1, D = 1 - |I|.
  [[nodiscard]] std::shared_ptr<const Volume> source() const {
    return volume_of(geometry, [](glm::dvec3 p) {
      const double speed = std::max(0.1 * in_slabs(p), std::min(kSpeed, in_tube(p)));
      return 1.0 - std::clamp(speed, -1.0, 1.0);
    });
  }
  [[nodiscard]] static double in_slabs(glm::dvec3 p) {
    const double y = std::fmod(p.y, 8.0);
    return std::min(kSlabsEnd - p.x, 2.0 - std::abs(y - 3.5));
  }
  [[nodiscard]] static double in_tube(glm::dvec3 p) {
    return p.x < kSlabsEnd ? -3.0 : 3.0 - glm::distance(glm::dvec2(p.y, p.z), glm::dvec2(19.5, 19.5));
  }
  // The slabs and the tube's first voxels.
  [[nodiscard]] static double start(glm::dvec3 p) {
    return std::max(in_slabs(p), std::min(in_tube(p), kSlabsEnd + 3.0 - p.x));
  }

  Geometry geometry = grid({64, 40, 40});
  solver::Parameters parameters;
};

double furthest_in_x(const solver::Executor& level_set) {
  double furthest = 0.0;
  for_each_crossing(level_set.snapshot().value(), [&](glm::dvec3 p) { furthest = std::max(furthest, p.x); });
  return furthest;
}

// A ball that rests where its brightness ends, and a vessel of three voxels from its side that is a little
// dimmer: curvature nearly holds the front in it.
struct Vessel {
  static constexpr double kBall = 56.0;  // where the vessel begins, along x
  static constexpr double kEnd = 116.0;

  Vessel() {
    parameters.target = 1000.0;
    parameters.range = 200.0;
    parameters.alpha = 0.9;
  }
  [[nodiscard]] static double ball(glm::dvec3 p) { return 26.0 - glm::distance(p, glm::dvec3(30.0)); }
  [[nodiscard]] std::shared_ptr<const Volume> source() const {
    return volume_of(geometry, [](glm::dvec3 p) {
      if (ball(p) >= 0.0) return 1000.0;
      const bool in_vessel =
          p.x > 50.0 && p.x <= kEnd && glm::distance(glm::dvec2(p.y, p.z), glm::dvec2(30.0)) < 1.5;
      return in_vessel ? 900.0 : 0.0;
    });
  }
  [[nodiscard]] static double start(glm::dvec3 p) { return ball(p); }
  // To rest.
  [[nodiscard]] std::int64_t steps_of_host() const {
    const auto host = executor(solver::ExecutorKind::host, source(), parameters);
    set_phi(*host, geometry, start);
    return run(*host, 20000, true).steps;
  }

  Geometry geometry = grid({128, 61, 61});
  solver::Parameters parameters;
};

// Cells of a chessboard that turn inside out: phi is as steep as the band allows, and so it changes as much
// in a step as it can.
struct Turmoil {
  explicit Turmoil(glm::dvec3 spacing) : geometry(grid({40, 37, 21}, spacing)) { parameters.alpha = 0.9; }
  [[nodiscard]] bool is_inside(glm::dvec3 mm) const {
    const glm::ivec3 cell(glm::floor(glm::round(mm / geometry.spacing_mm) / 3.0));
    return (cell.x + cell.y + cell.z) % 2 == 0;
  }
  // With T = 0 and epsilon = 1, D is 1 and -1.
  [[nodiscard]] std::shared_ptr<const Volume> source() const {
    return volume_of(geometry, [this](glm::dvec3 mm) { return is_inside(mm) ? 0.0 : 2.0; });
  }

  Geometry geometry;
  solver::Parameters parameters;
};

}  // namespace

class ConvergenceTest : public QObject {
  Q_OBJECT

 private slots:
  void every_change_begins_a_new_window_data() { add_all_rows(); }
  void every_change_begins_a_new_window() {
    const Setting setting = this_row();
    const Scene scene = resting_scene({40, 37, 29});
    const auto level_set = setting.make(scene.source, scene.parameters);
    QCOMPARE(failure(level_set->paint(scene.seed, solver::Brush::add)), QString());
    QVERIFY(run(*level_set, 2000, true).converged);
    const solver::Field at_rest = level_set->snapshot().value();
    const solver::Sphere nowhere{centre_of(scene.geometry) - glm::dvec3(15.0), 1.0};
    const std::function<Status()> changes[] = {
        [&] { return level_set->set_parameters(scene.parameters); },
        [&] { return level_set->paint(nowhere, solver::Brush::erase); },
        [&] { return level_set->restore(at_rest); }};
    for (const auto& change : changes) {
      // In the middle of a window at rest: what rested before the change says nothing about what comes.
      run(*level_set, 7);
      QCOMPARE(failure(change()), QString());
      const solver::AdvanceReport report = run(*level_set, 100, true);
      QVERIFY(report.converged);
      const int windows =
          solver::RestRule::of(level_set->time_step(), scene.parameters.alpha, 1.0, 512).windows_to_rest + 1;
      QCOMPARE(report.steps, std::int64_t{windows * solver::kConvergenceWindow});
      QCOMPARE(report.moving_pages, std::int64_t{0});
    }
  }

  void a_slow_start_after_a_change_is_no_rest_data() { add_all_rows(); }
  void a_slow_start_after_a_change_is_no_rest() {
    const Setting setting = this_row();
    const Geometry geometry = grid({32, 32, 32});
    const glm::dvec3 centre = centre_of(geometry);
    const auto source = volume_of(geometry, [&](glm::dvec3 p) { return glm::distance(p, centre); });
    solver::Parameters parameters;
    parameters.target = 5.0;
    parameters.range = 4.0;
    parameters.alpha = 0.9;
    const auto level_set = setting.make(source, parameters);
    QCOMPARE(failure(level_set->paint({centre, 8.0}, solver::Brush::add)), QString());
    QVERIFY(run(*level_set, 2000, true).converged);
    run(*level_set, solver::kConvergenceWindow - 1);
    const double before = mean_radius(level_set->snapshot().value(), centre);
    // The surface now has D = 0.02 to go on: twice the speed that counts as none.
    parameters.target += 0.1;
    QCOMPARE(failure(level_set->set_parameters(parameters)), QString());
    QVERIFY(run(*level_set, 2000, true).converged);
    const double radius = mean_radius(level_set->snapshot().value(), centre);
    QVERIFY2(radius > before + 0.05, qPrintable(QString("%1, then %2").arg(before).arg(radius)));
  }

  void a_front_that_creeps_on_a_large_resting_surface_counts_data() { add_all_rows(); }
  void a_front_that_creeps_on_a_large_resting_surface_counts() {
    const Setting setting = this_row();
    const CreepingFront scene;
    const auto level_set = setting.make(scene.source(), scene.parameters);
    set_phi(*level_set, scene.geometry, CreepingFront::start);
    run(*level_set, 4 * solver::kConvergenceWindow);
    const double before = furthest_in_x(*level_set);
    const solver::AdvanceReport report = run(*level_set, 4 * solver::kConvergenceWindow, true);
    qInfo("the tip goes from %.2f to %.2f, the surface's speed is %.4f", before, furthest_in_x(*level_set),
          report.surface_speed);
    QVERIFY(!report.converged);
    QCOMPARE(report.steps, std::int64_t{4 * solver::kConvergenceWindow});
    QVERIFY(furthest_in_x(*level_set) > before + 1.0);
  }

  void a_creeping_front_goes_to_its_end_data() { add_rows_with_host(); }
  void a_creeping_front_goes_to_its_end() {
    const Setting setting = this_row();
    const Vessel scene;
    const auto level_set = setting.make(scene.source(), scene.parameters);
    set_phi(*level_set, scene.geometry, Vessel::start);
    // While it is on its way, the pages that move are those of the vessel.
    QVERIFY(!run(*level_set, 1500, true).converged);
    const double on_its_way = furthest_in_x(*level_set);
    QVERIFY2(on_its_way > Vessel::kBall + 2.0 && on_its_way < Vessel::kEnd - 10.0,
             qPrintable(QString::number(on_its_way)));
    const auto moving = level_set->moving_pages().value();
    QVERIFY(!moving.empty() && moving.size() <= 16);
    const PageLayout layout(scene.geometry.size, level_set->memory().page_shape);
    for (const std::int64_t page : moving) {
      const Index3 first = layout.page_coordinates(page) * layout.page_shape();
      QVERIFY2(first.x + layout.page_shape().x > Vessel::kBall,
               qPrintable(QString("page at %1").arg(first.x)));
    }

    const solver::AdvanceReport report = run(*level_set, 20000, true);
    const double end = furthest_in_x(*level_set);
    qInfo("%lld steps to rest, %g s, the tip at %.2f then %.2f", static_cast<long long>(1500 + report.steps),
          report.seconds, on_its_way, end);
    QVERIFY(report.converged);
    QVERIFY2(end > Vessel::kEnd - 2.0, qPrintable(QString::number(end)));
    QVERIFY(level_set->moving_pages().value().empty());

    static const auto steps_of_host = static_cast<double>(scene.steps_of_host());
    const auto steps = static_cast<double>(1500 + report.steps);
    QVERIFY2(std::abs(steps - steps_of_host) <= 0.05 * steps_of_host,
             qPrintable(QString("%1 steps, host %2").arg(steps).arg(steps_of_host)));
  }

  void motion_is_measured_alike_at_any_spacing_data() { add_rows_with_host(); }
  void motion_is_measured_alike_at_any_spacing() {
    const Setting setting = this_row();
    for (const glm::dvec3 spacing : {glm::dvec3(0.01), glm::dvec3(100.0), glm::dvec3(1.0, 1.0, 20.0),
                                     glm::dvec3(20.0, 1.0, 1.0), glm::dvec3(0.01, 100.0, 0.01)}) {
      const Turmoil scene(spacing);
      double speed[2];
      int i = 0;
      for (const solver::ExecutorKind kind : {setting.kind, solver::ExecutorKind::reference}) {
        const auto level_set = Setting{kind, setting.page_shape}.make(scene.source(), scene.parameters);
        const double band = level_set->band();
        set_phi(*level_set, scene.geometry,
                [&](glm::dvec3 mm) { return scene.is_inside(mm) ? -band : band; });
        // Against the first window.
        speed[i++] = run(*level_set, 2 * solver::kConvergenceWindow).surface_speed;
      }
      qInfo("%g x %g x %g mm: speed %.5g and %.5g", spacing.x, spacing.y, spacing.z, speed[0], speed[1]);
      QVERIFY(speed[1] > 0.0 && std::abs(speed[0] - speed[1]) < 1e-3 * speed[1]);
    }
  }

  void all_executors_stop_at_the_same_step_data() { add_rows_with_host(); }
  void all_executors_stop_at_the_same_step() {
    const Setting setting = this_row();
    const Scene scene = resting_scene({40, 37, 29});
    solver::ExecutorOptions options = setting.options();
    options.skip_quiet_pages = false;  // the reference has none
    const auto tested = executor(setting.kind, scene.source, scene.parameters, options);
    const auto reference =
        Setting{solver::ExecutorKind::reference, setting.page_shape}.make(scene.source, scene.parameters);
    solver::AdvanceReport reports[2];
    int i = 0;
    for (solver::Executor* level_set : {tested.get(), reference.get()}) {
      QCOMPARE(failure(level_set->paint(scene.seed, solver::Brush::add)), QString());
      reports[i++] = run(*level_set, 2000, true);
    }
    QVERIFY(reports[0].converged && reports[1].converged);
    QCOMPARE(reports[0].steps, reports[1].steps);
    qInfo("%lld steps, speed %.5f and %.5f", static_cast<long long>(reports[0].steps),
          reports[0].surface_speed, reports[1].surface_speed);
    QVERIFY(std::abs(reports[0].surface_speed - reports[1].surface_speed) < 1e-4);
  }
};

TIDEMARK_TEST(ConvergenceTest)

}  // namespace tidemark::test::convergence_test

#include "convergence_test.moc"
