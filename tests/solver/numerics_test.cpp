// Time step, curvature, symmetry, anisotropy, quiet pages: T7, T8, T9 and T11 of the numerics.
#include <array>
#include <random>

#include "level_sets.h"
#include "solver/statistics.h"
#include "tests/support/support.h"

// After the standard headers: defines functions of these names.
#include "solver/speed/curvature-inl.h"
#include "tests/support/test_program.h"

namespace tidemark::test::numerics_test {

namespace {

solver::HWY_NAMESPACE::Stencil<double> stencil_of(const Function& phi, glm::dvec3 p) {
  const auto at = [&](int x, int y, int z) { return phi(p + glm::dvec3(x, y, z)); };
  const auto dx = [&](int y, int z) { return at(1, y, z) - at(-1, y, z); };
  return {at(0, 0, 0), at(-1, 0, 0),  at(1, 0, 0),  at(0, -1, 0), at(0, 1, 0), at(0, 0, -1),
          at(0, 0, 1), at(0, -1, -1), at(0, -1, 1), at(0, 1, -1), at(0, 1, 1), dx(0, 0),
          dx(-1, 0),   dx(1, 0),      dx(0, -1),    dx(0, 1)};
}

double kappa(const Function& phi, glm::dvec3 p) {
  const double inverse_spacing[3] = {1.0, 1.0, 1.0};
  return solver::HWY_NAMESPACE::curvature<double>(
      solver::HWY_NAMESPACE::differences<false, double>(stencil_of(phi, p), inverse_spacing));
}

// The largest relative error of kappa at points of the surface, off the axes.
double curvature_error(const Function& phi, const std::function<glm::dvec3(double, double)>& surface,
                       const std::function<double(double, double)>& exact) {
  double worst = 0.0;
  for (double u = 0.1; u < 6.2; u += 0.37) {
    for (double v = -1.3; v < 1.4; v += 0.31) {
      const double expected = exact(u, v);
      worst = std::max(worst, std::abs(kappa(phi, surface(u, v)) - expected) / std::abs(expected));
    }
  }
  return worst;
}

// Maps a voxel by one of the 48 permutations and flips of the axes of a cube of n voxels.
Index3 transformed(Index3 v, const std::array<int, 3>& axes, int flips, std::int64_t n) {
  Index3 result;
  for (int axis = 0; axis < 3; ++axis) {
    result[axis] = v[axes[static_cast<std::size_t>(axis)]];
    if ((flips >> axis & 1) != 0) result[axis] = n - 1 - result[axis];
  }
  return result;
}

std::vector<float> transformed(const std::vector<float>& values, const Geometry& g,
                               const std::array<int, 3>& axes, int flips) {
  std::vector<float> result(values.size());
  for (std::int64_t i = 0; i < g.voxel_count(); ++i) {
    const Index3 v = g.voxel_at(i);
    result[static_cast<std::size_t>(g.offset(transformed(v, axes, flips, g.size.x)))] =
        values[static_cast<std::size_t>(i)];
  }
  return result;
}

std::vector<float> evolved(const Geometry& geometry, const std::vector<float>& source,
                           const std::vector<float>& phi, const solver::Parameters& parameters, int steps) {
  auto volume = std::make_shared<Volume>();
  volume->geometry = geometry;
  volume->voxels = source;
  const auto level_set = executor(solver::ExecutorKind::host, volume, parameters);
  if (!level_set->restore(solver::Field::from_dense(geometry, phi, level_set->band())))
    qFatal("restore failed");
  run(*level_set, steps);
  return level_set->snapshot().value().dense();
}

}  // namespace

class NumericsTest : public QObject {
  Q_OBJECT

 private slots:
  void the_time_step_is_stable_and_not_much_too_small() {  // T7
    const Geometry geometry = grid({24, 24, 24});
    // A plane with a checkerboard ripple: the mode that grows first.
    const auto ripple = [](glm::dvec3 p) {
      const int parity = static_cast<int>(p.y) + static_cast<int>(p.z);
      return 12.0 - p.x + 0.05 * (parity % 2 == 0 ? 1.0 : -1.0);
    };
    const auto roughness = [&](double factor) {
      solver::Parameters parameters;
      parameters.alpha = 0.0;
      parameters.rescaling_term = false;
      parameters.band = std::numeric_limits<double>::infinity();
      parameters.time_step_factor = factor;
      const auto level_set = executor(solver::ExecutorKind::host, zero_volume(geometry), parameters);
      set_phi(*level_set, geometry, ripple);
      run(*level_set, 200);
      const solver::Field phi = level_set->snapshot().value();
      double worst = 0.0;
      for (std::int64_t y = 4; y < 20; ++y) {
        worst = std::max(worst, std::abs(static_cast<double>(phi.at({12, y, 12}) - phi.at({12, y + 1, 12}))));
      }
      return worst;
    };
    const double stable = roughness(1.0);
    const double unstable = roughness(1.3);
    qInfo("T7: ripple of 0.1 becomes %.2e at the time step, %.2e at 1.3 times it", stable, unstable);
    QVERIFY(stable < 0.01);
    QVERIFY(!(unstable < 0.1));
  }

  void the_time_step_is_stable_for_any_parameters() {  // T7
    std::mt19937 random(2);
    const auto uniform = [&](double low, double high) {
      return low + (high - low) * (random() / 4294967296.0);
    };
    for (int trial = 0; trial < 32; ++trial) {
      const Geometry geometry = grid({24, 24, 20}, {1.0, uniform(1.0, 2.0), uniform(1.0, 4.0)});
      const auto source = volume_of(geometry, [&](glm::dvec3) { return uniform(-100, 100); });
      solver::Parameters parameters;
      parameters.alpha = trial % 8 == 0 ? 0.0 : uniform(0, 1);
      parameters.range = uniform(10, 80);
      parameters.scheme = trial % 4 == 3 ? solver::Scheme::paper : solver::Scheme::split;
      const auto level_set = executor(solver::ExecutorKind::host, source, parameters);
      QVERIFY(level_set->paint({centre_of(geometry), 8.0}, solver::Brush::add));
      // Unstable runs flip voxels to and fro by much of the band in every step.
      run(*level_set, 300);
      const std::vector<float> before = level_set->snapshot().value().dense();
      run(*level_set, 1);
      const double jump = largest_difference(before, level_set->snapshot().value().dense());
      QVERIFY2(jump < 0.5, qPrintable(QString("trial %1: %2").arg(trial).arg(jump)));
      QCOMPARE(failure(level_set->validate()), QString());
    }
  }

  void curvature_of_sphere_cylinder_and_torus() {  // T8
    const auto sphere = [](double r) {
      return curvature_error([=](glm::dvec3 p) { return r - glm::length(p); },
                             [=](double u, double v) {
                               return r * glm::dvec3(std::cos(u) * std::cos(v), std::sin(u) * std::cos(v),
                                                     std::sin(v));
                             },
                             [=](double, double) { return -2.0 / r; });
    };
    const auto cylinder = [](double r) {
      return curvature_error(
          [=](glm::dvec3 p) { return r - std::hypot(p.x, p.y); },
          [=](double u, double v) { return glm::dvec3(r * std::cos(u), r * std::sin(u), v); },
          [=](double, double) { return -1.0 / r; });
    };
    const auto torus = [](double r) {
      const double big = 3.0 * r;
      return curvature_error(
          [=](glm::dvec3 p) { return r - std::hypot(std::hypot(p.x, p.y) - big, p.z); },
          [=](double u, double v) {
            const double ring = big + r * std::cos(v);
            return glm::dvec3(ring * std::cos(u), ring * std::sin(u), r * std::sin(v));
          },
          [=](double, double v) { return -(1.0 / r + std::cos(v) / (big + r * std::cos(v))); });
    };
    const auto check_shape = [](const char* name, const std::function<double(double)>& error) {
      const double e5 = error(5.0);
      const double e10 = error(10.0);
      const double e20 = error(20.0);
      qInfo("T8: %s: relative error %.4f, %.4f, %.4f at r = 5, 10, 20; order %.2f", name, e5, e10, e20,
            order(e5, e20, 4.0));
      return e5 < 0.05 && order(e5, e20, 4.0) >= 1.8;
    };
    QVERIFY(check_shape("sphere", sphere));
    QVERIFY(check_shape("cylinder", cylinder));
    QVERIFY(check_shape("torus", torus));
  }

  void mirrored_and_turned_fields_evolve_alike() {  // T9
    const Geometry geometry = grid({24, 24, 24});
    std::mt19937 random(4);
    const auto source = sample(geometry, [&](glm::dvec3 p) {
      return 50.0 * std::sin(p.x / 3.0) * std::cos(p.y / 4.0) + 30.0 * std::sin(p.z) +
             static_cast<double>(random() % 20);
    });
    const auto phi = sample(geometry, [&](glm::dvec3 p) {
      return std::clamp(8.0 - glm::distance(p, glm::dvec3(10, 12, 13)) + std::sin(p.x), -2.5, 2.5);
    });
    solver::Parameters parameters;
    parameters.range = 40.0;
    parameters.alpha = 0.6;
    const auto one = evolved(geometry, source, phi, parameters, 1);
    const auto many = evolved(geometry, source, phi, parameters, 40);
    constexpr std::array<std::array<int, 3>, 6> kPermutations = {
        {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    for (const auto& axes : kPermutations) {
      for (int flips = 0; flips < 8; ++flips) {
        const auto turned_source = transformed(source, geometry, axes, flips);
        const auto turned_phi = transformed(phi, geometry, axes, flips);
        const auto result = evolved(geometry, turned_source, turned_phi, parameters, 1);
        QVERIFY(largest_difference(result, transformed(one, geometry, axes, flips)) <= 1e-6);
        if (axes == kPermutations[0]) {
          const auto far = evolved(geometry, turned_source, turned_phi, parameters, 40);
          QCOMPARE(far, transformed(many, geometry, axes, flips));
        }
      }
    }
  }

  void inside_and_outside_are_alike() {  // T9: phi -> -phi with D -> -D
    const Geometry geometry = grid({24, 24, 24});
    // Raw D = 4 - |I| and |I'| = 8 - |I| give D' = -D without rounding.
    std::vector<float> source;
    std::vector<float> opposite;
    std::mt19937 random(9);
    for (std::int64_t i = 0; i < geometry.voxel_count(); ++i) {
      const auto value = static_cast<float>(random() % 9);
      source.push_back(value);
      opposite.push_back(8.0F - value);
    }
    auto phi = sample(geometry, [&](glm::dvec3 p) {
      return std::clamp(8.0 - glm::distance(p, glm::dvec3(10, 12, 13)) + std::sin(p.x), -2.5, 2.5);
    });
    solver::Parameters parameters;
    parameters.target = 0.0;
    parameters.range = 4.0;
    parameters.alpha = 0.5;
    parameters.data_form = solver::DataForm::raw;
    auto result = evolved(geometry, source, phi, parameters, 30);
    for (float& value : phi) value = -value;
    const auto mirrored = evolved(geometry, opposite, phi, parameters, 30);
    for (float& value : result) value = -value;
    QCOMPARE(result, mirrored);
  }

  void a_plane_keeps_its_speed_along_a_coarse_axis() {  // T11
    for (const double spacing : {3.0, 6.0, 7.5}) {
      const Geometry geometry = grid({9, 9, 24}, {1.0, 1.0, spacing});
      solver::Parameters parameters;
      parameters.alpha = 0.1;
      const auto level_set = executor(solver::ExecutorKind::host, zero_volume(geometry), parameters);
      const double start = 8.3 * spacing;
      set_phi(*level_set, geometry, [&](glm::dvec3 p) { return start - p.z; });
      const double way = 6.0 * spacing;  // at speed 0.1
      run(*level_set, static_cast<std::int64_t>(way / 0.1 / level_set->time_step()));
      double position = 0.0;
      for_each_crossing(level_set->snapshot().value(), [&](glm::dvec3 p) { position = p.z; });
      const double share = (position - start) / way;
      qInfo("T11: spacing 1:%.1f: %.1f %% of the way", spacing, 100.0 * share);
      QVERIFY(share >= 0.9 && share <= 1.05);
    }
  }

  void anisotropic_grids_give_the_same_surface() {  // T11
    const double size_mm = 60.0;
    const glm::dvec3 centre(29.5, 29.5, 29.5);
    const Function source = [&](glm::dvec3 p) {
      const glm::dvec3 d = p - centre;
      return std::sqrt(d.x * d.x + d.y * d.y * 1.3 + d.z * d.z * 0.8);
    };
    solver::Parameters parameters;
    parameters.target = 14.0;
    parameters.range = 5.0;
    parameters.alpha = 0.6;
    const auto converge = [&](double spacing) {
      const auto slices = static_cast<std::int64_t>(std::round(size_mm / spacing));
      Geometry geometry = grid({60, 60, slices}, {1.0, 1.0, spacing});
      geometry.origin_mm.z = 0.5 * (spacing - 1.0);
      const auto level_set = executor(solver::ExecutorKind::host, volume_of(geometry, source), parameters);
      if (!level_set->paint({centre, 12.0}, solver::Brush::add)) qFatal("paint failed");
      run(*level_set, 4000, true);
      if (!level_set->validate()) qFatal("validate failed");
      return level_set->snapshot().value();
    };
    const solver::Field isotropic = converge(1.0);
    const double exact_volume = smooth_volume(isotropic);
    std::vector<glm::dvec3> surface;
    for_each_crossing(isotropic, [&](glm::dvec3 p) { surface.push_back(p); });
    for (const double spacing : {3.0, 6.0, 7.5}) {
      const solver::Field phi = converge(spacing);
      double worst = 0.0;
      // To the nearest point, not by phi, which says no distance beyond its band.
      for_each_crossing(phi, [&](glm::dvec3 p) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const glm::dvec3 other : surface) nearest = std::min(nearest, glm::distance(p, other));
        worst = std::max(worst, nearest);
      });
      double volume = 0.0;  // a ramp of one coarse voxel's size along the normal
      for (const float value : phi.dense()) volume += std::clamp(0.5 + value / spacing, 0.0, 1.0) * spacing;
      qInfo("T11: spacing 1:%.1f: volume %.1f %% off, surface at most %.2f mm off", spacing,
            100.0 * (volume / exact_volume - 1.0), worst);
      QVERIFY(std::abs(volume / exact_volume - 1.0) < 0.02);
      QVERIFY(worst < 0.5 * spacing);
    }
  }

  void skipping_quiet_pages_changes_no_radius_and_saves_the_work() {
    const Geometry geometry = grid({56, 56, 56});
    const glm::dvec3 centre = centre_of(geometry);
    const auto source = volume_of(geometry, [&](glm::dvec3 p) { return glm::distance(p, centre); });
    solver::Parameters parameters;
    parameters.target = 14.0;
    parameters.range = 4.0;
    parameters.alpha = 0.4;
    double radius[2];
    for (const bool skip : {false, true}) {
      solver::ExecutorOptions options;
      options.skip_quiet_pages = skip;
      const auto level_set = executor(solver::ExecutorKind::host, source, parameters, options);
      QVERIFY(level_set->paint({centre, 13.0}, solver::Brush::add));
      const solver::AdvanceReport active = run(*level_set, 20);
      run(*level_set, 3000);
      radius[skip ? 1 : 0] = mean_radius(level_set->snapshot().value(), centre);
      const solver::AdvanceReport rest = run(*level_set, 20);
      if (skip) {
        qInfo("at rest %lld voxel updates in 20 steps, %lld while it moved",
              static_cast<long long>(rest.voxel_updates), static_cast<long long>(active.voxel_updates));
        QVERIFY(static_cast<double>(rest.voxel_updates) < 0.02 * static_cast<double>(active.voxel_updates));
        // New parameters wake everything.
        solver::Parameters wider = parameters;
        wider.target = 16.0;
        QVERIFY(level_set->set_parameters(wider));
        run(*level_set, 1500, true);
        const double wider_radius = mean_radius(level_set->snapshot().value(), centre);
        qInfo("radius %.3f, then %.3f", radius[1], wider_radius);
        QVERIFY(wider_radius > radius[1] + 1.5);
      }
      QCOMPARE(failure(level_set->validate()), QString());
    }
    qInfo("radius %.4f without skipping, %.4f with it", radius[0], radius[1]);
    QVERIFY(std::abs(radius[0] - radius[1]) <= 0.1);
  }

  void parameters_that_make_no_sense_are_refused_by_name() {
    const auto refused = [](auto change, const char* name) {
      solver::Parameters parameters;
      change(parameters);
      const auto status = solver::check(parameters);
      return !status && status.error().kind == ErrorKind::usage &&
             status.error().message.find(name) != std::string::npos;
    };
    QVERIFY(refused([](solver::Parameters& p) { p.range = 0.0; }, "epsilon"));
    QVERIFY(refused([](solver::Parameters& p) { p.range = std::nan(""); }, "epsilon"));
    QVERIFY(refused([](solver::Parameters& p) { p.alpha = 1.5; }, "alpha"));
    QVERIFY(refused([](solver::Parameters& p) { p.band = 1.0; }, "band"));
    QVERIFY(refused([](solver::Parameters& p) { p.rescale = -1.0; }, "rescale"));
    QVERIFY(refused([](solver::Parameters& p) { p.target = std::nan(""); }, "target"));
    QCOMPARE(failure(solver::check(solver::Parameters())), QString());
  }

  void alpha_converts_to_the_papers() {
    solver::Parameters parameters;
    parameters.alpha = 0.5;
    parameters.range = 100.0;
    QVERIFY(std::abs(solver::paper_alpha(parameters) - 0.5 / 50.5) < 1e-12);
  }
};

TIDEMARK_TEST(NumericsTest)

}  // namespace tidemark::test::numerics_test

#include "numerics_test.moc"
