// Motions with known answers: T1, T1b, T1c, T2, T2b, T3 and T10 of the numerics.
#include "level_sets.h"
#include "tests/support/support.h"

#include "imaging/regions/islands.h"
#include "solver/inside_region.h"
#include "tests/support/test_program.h"

namespace tidemark::test::motion_test {

namespace {

solver::Parameters curvature_alone() {
  solver::Parameters p;
  p.alpha = 0.0;
  return p;
}

solver::Parameters unclamped(solver::Parameters p) {
  p.band = std::numeric_limits<double>::infinity();
  p.rescaling_term = false;
  return p;
}

// Chooses the time step so that `time` is a whole number of steps; returns that number.
std::int64_t divide_time(solver::Parameters& parameters, const std::shared_ptr<const Volume>& source,
                         double time) {
  const double largest = executor(solver::ExecutorKind::reference, source, parameters)->time_step();
  const auto steps = static_cast<std::int64_t>(std::ceil(time / largest));
  parameters.time_step_factor = time / (static_cast<double>(steps) * largest);
  return steps;
}

// Relative error of the radius after a ball (or a cylinder along z, extent 8) of radius 0.35 n has lost half
// of its cross-section under curvature, r^2 = r0^2 - rate t.
double shrinking_error(solver::ExecutorKind kind, int n, double rate, bool clamped) {
  const bool cylinder = rate == 2.0;
  const Geometry geometry = grid({n, n, cylinder ? 8 : n});
  const auto source = zero_volume(geometry);
  const double r0 = 0.35 * n;
  const double time = 0.5 * r0 * r0 / rate;
  solver::Parameters parameters = curvature_alone();
  if (!clamped) parameters = unclamped(parameters);
  const std::int64_t steps = divide_time(parameters, source, time);
  const auto level_set = executor(kind, source, parameters);
  glm::dvec3 centre = centre_of(geometry);
  const auto radius = [&](glm::dvec3 p) {
    if (cylinder) p.z = centre.z;
    return glm::distance(p, centre);
  };
  set_phi(*level_set, geometry, [&](glm::dvec3 p) { return r0 - radius(p); });
  run(*level_set, steps);
  if (!level_set->validate()) return 1.0;
  // Every level set shrinks alike, so that phi itself is known: its mean error at the surface is the
  // radius's.
  const solver::Field phi = level_set->snapshot().value();
  double sum = 0.0;
  int count = 0;
  for (std::int64_t i = 0; i < geometry.voxel_count(); ++i) {
    const Index3 v(i % n, i / n % n, i / (n * n));
    const double r = radius(geometry.to_patient(v));
    const double exact = r0 - std::sqrt(r * r + rate * time);
    if (std::abs(exact) > 1.0) continue;
    sum += phi.at(v) - exact;
    ++count;
  }
  return std::abs(sum / count) / std::sqrt(r0 * r0 - rate * time);
}

}  // namespace

class MotionTest : public QObject {
  Q_OBJECT

 private slots:
  void a_sphere_shrinks_as_sqrt_of_r0_squared_minus_4t() {  // T1
    const double e24 = shrinking_error(solver::ExecutorKind::host, 24, 4.0, false);
    const double e48 = shrinking_error(solver::ExecutorKind::host, 48, 4.0, false);
    const double e72 = shrinking_error(solver::ExecutorKind::host, 72, 4.0, false);
    qInfo("T1: relative error %.2e, %.2e, %.2e at n = 24, 48, 72; order %.2f", e24, e48, e72,
          order(e24, e72, 3.0));
    QVERIFY(order(e24, e72, 3.0) >= 1.7);
    QVERIFY(e24 < 1.5e-3 && e72 < 1.6e-4);
    const double reference = shrinking_error(solver::ExecutorKind::reference, 24, 4.0, false);
    QVERIFY(std::abs(reference - e24) < 2e-5);
  }

  void a_sphere_in_its_band_shrinks_likewise() {  // T1b
    const double error = shrinking_error(solver::ExecutorKind::host, 48, 4.0, true);
    qInfo("T1b: relative error %.2e", error);
    QVERIFY(error <= 0.015);
  }

  void a_cylinder_shrinks_as_sqrt_of_r0_squared_minus_2t() {  // T1c
    const double e24 = shrinking_error(solver::ExecutorKind::host, 24, 2.0, false);
    const double e72 = shrinking_error(solver::ExecutorKind::host, 72, 2.0, false);
    qInfo("T1c: relative error %.2e, %.2e at n = 24, 72; order %.2f", e24, e72, order(e24, e72, 3.0));
    QVERIFY(order(e24, e72, 3.0) >= 1.7);
    QVERIFY(e72 < 5e-4);
  }

  void a_sphere_grows_and_shrinks_at_unit_speed() {  // T2
    const Geometry geometry = grid({64, 64, 64});
    const glm::dvec3 centre = centre_of(geometry);
    for (const bool grow : {true, false}) {
      // The source is at T, or so far from it that D = -1.
      const auto source = volume_of(geometry, [&](glm::dvec3) { return grow ? 0.0 : 10.0; });
      solver::Parameters parameters;
      parameters.alpha = 1.0;
      const std::int64_t steps = divide_time(parameters, source, 14.0);
      const auto level_set = executor(solver::ExecutorKind::host, source, parameters);
      const double r0 = grow ? 10.0 : 24.0;
      set_phi(*level_set, geometry, [&](glm::dvec3 p) { return r0 - glm::distance(p, centre); });
      run(*level_set, steps);
      const double radius = mean_radius(level_set->snapshot().value(), centre);
      const double exact = grow ? 24.0 : 10.0;
      qInfo("T2: radius %.3f, exact %.0f", radius, exact);
      QVERIFY(std::abs(radius - exact) < 0.6);
      QVERIFY(level_set->validate());
    }
  }

  void a_plane_moves_exactly() {  // T2b
    const Geometry geometry = grid({64, 9, 9});
    const auto source = zero_volume(geometry);
    for (const bool clamped : {false, true}) {
      solver::Parameters parameters;
      parameters.alpha = 1.0;
      if (!clamped) parameters = unclamped(parameters);
      const std::int64_t steps = divide_time(parameters, source, 20.0);
      const auto level_set = executor(solver::ExecutorKind::host, source, parameters);
      // Away from the border, where nothing is upwind.
      set_phi(*level_set, geometry, [](glm::dvec3 p) { return 30.25 - p.x; });
      run(*level_set, steps);
      double position = 0.0;
      for_each_crossing(level_set->snapshot().value(), [&](glm::dvec3 p) { position = p.x; });
      qInfo("T2b: plane at %.5f, exact 50.25 (%s)", position, clamped ? "in the band" : "unclamped");
      QVERIFY(std::abs(position - 50.25) < (clamped ? 0.025 * 20.0 : 2e-4));
      QVERIFY(level_set->validate());
    }
  }

  void two_spheres_merge_without_overshoot() {  // T2b
    const Geometry geometry = grid({72, 40, 40});
    const glm::dvec3 c = centre_of(geometry);
    const glm::dvec3 a = c - glm::dvec3(14, 0, 0);
    const glm::dvec3 b = c + glm::dvec3(14, 0, 0);
    const auto exact = [&](glm::dvec3 p, double t) {
      return std::max(10.0 - glm::distance(p, a), 10.0 - glm::distance(p, b)) + t;
    };
    const auto source = zero_volume(geometry);
    solver::Parameters parameters;
    parameters.alpha = 1.0;
    parameters = unclamped(parameters);
    const std::int64_t steps = divide_time(parameters, source, 7.0);
    const auto level_set = executor(solver::ExecutorKind::host, source, parameters);
    set_phi(*level_set, geometry, [&](glm::dvec3 p) { return exact(p, 0.0); });
    run(*level_set, steps);
    const solver::Field phi = level_set->snapshot().value();
    double overshoot = 0.0;
    double surface_error = 0.0;
    for (std::int64_t x = 0; x < geometry.size.x; ++x) {
      for (std::int64_t y = 0; y < geometry.size.y; ++y) {
        const Index3 v(x, y, 20);
        const double e = exact(geometry.to_patient(v), 7.0);
        overshoot = std::max(overshoot, phi.at(v) - e);
        if (std::abs(e) < 1.0) surface_error = std::max(surface_error, std::abs(phi.at(v) - e));
      }
    }
    qInfo("T2b: merge: overshoot %.4f, largest error at the surface %.3f", overshoot, surface_error);
    QVERIFY(overshoot < 0.05);
    QVERIFY(surface_error < 0.6);
  }

  void data_and_curvature_balance_where_the_equation_says() {  // T3
    const Geometry geometry = grid({56, 56, 56});
    const glm::dvec3 centre = centre_of(geometry);
    const auto source = volume_of(geometry, [&](glm::dvec3 p) { return glm::distance(p, centre); });
    for (const auto& [alpha, exact] : {std::pair(1.0, 18.0), {0.7, 17.952}, {0.4, 17.832}}) {
      solver::Parameters parameters;
      parameters.target = 14.0;
      parameters.range = 4.0;
      parameters.alpha = alpha;
      parameters.data_form = solver::DataForm::raw;
      const auto level_set = executor(solver::ExecutorKind::host, source, parameters);
      QVERIFY(level_set->paint({centre, 15.0}, solver::Brush::add));
      const solver::AdvanceReport report = run(*level_set, 20000, true);
      const double radius = mean_radius(level_set->snapshot().value(), centre);
      qInfo("T3: alpha %.1f: radius %.3f, exact %.3f, after %lld steps", alpha, radius, exact,
            static_cast<long long>(report.steps));
      QVERIFY(report.converged);
      QVERIFY(std::abs(radius - exact) <= 0.1);
      QVERIFY(level_set->validate());
    }
  }

  void a_dumbbell_splits_in_two_under_curvature() {  // T10
    const Geometry geometry = grid({72, 40, 40});
    const glm::dvec3 c = centre_of(geometry);
    const auto level_set = executor(solver::ExecutorKind::host, zero_volume(geometry), curvature_alone());
    for (const double side : {-1.0, 1.0}) {
      QVERIFY(level_set->paint({c + glm::dvec3(side * 20, 0, 0), 12.0}, solver::Brush::add));
    }
    for (double x = -14; x <= 14; x += 1) {
      QVERIFY(level_set->paint({c + glm::dvec3(x, 0, 0), 3.5}, solver::Brush::add));
    }
    const auto components_now = [&] {
      return imaging::Islands(solver::inside_region(level_set->snapshot().value())).count();
    };
    QCOMPARE(components_now(), std::size_t{1});
    std::size_t components = 1;
    for (int i = 0; i < 60 && components == 1; ++i) {
      run(*level_set, 5);
      components = components_now();
    }
    QCOMPARE(components, std::size_t{2});
    QVERIFY(level_set->validate());
  }

  void a_sphere_loses_volume_at_8_pi_r() {  // T10
    const Geometry geometry = grid({64, 64, 64});
    const glm::dvec3 centre = centre_of(geometry);
    solver::Parameters parameters = curvature_alone();
    parameters.rescaling_term = false;
    const auto level_set = executor(solver::ExecutorKind::host, zero_volume(geometry), parameters);
    set_phi(*level_set, geometry, [&](glm::dvec3 p) { return 20.0 - glm::distance(p, centre); });
    const double before = smooth_volume(level_set->snapshot().value());
    const solver::AdvanceReport report = run(*level_set, 20);
    const double time = static_cast<double>(report.steps) * level_set->time_step();
    const double after = smooth_volume(level_set->snapshot().value());
    const double radius = std::sqrt(20.0 * 20.0 - 4.0 * time / 2.0);  // at half time
    const double rate = (after - before) / time;
    const double exact = -8.0 * std::numbers::pi * radius;
    qInfo("T10: volume rate %.2f, exact %.2f", rate, exact);
    QVERIFY(std::abs(rate - exact) < 0.02 * std::abs(exact));
  }
};

TIDEMARK_TEST(MotionTest)

}  // namespace tidemark::test::motion_test

#include "motion_test.moc"
