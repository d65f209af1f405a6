// The rescaling term and the distance transform: T4 and T12c of the numerics.
#include <glm/common.hpp>

#include "level_sets.h"
#include "solver/distance_transform.h"
#include "solver/statistics.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::rescaling_test {

namespace {

solver::Parameters rescaling_alone() {
  solver::Parameters parameters;
  parameters.data_term = false;
  parameters.curvature_term = false;
  return parameters;
}

// The mean of | |grad phi| - 1 | over the voxels with |phi| <= 1, by central differences.
double gradient_error(const solver::Field& phi) {
  double sum = 0.0;
  int count = 0;
  const Index3 size = phi.geometry.size;
  for (std::int64_t z = 1; z + 1 < size.z; ++z) {
    for (std::int64_t y = 1; y + 1 < size.y; ++y) {
      for (std::int64_t x = 1; x + 1 < size.x; ++x) {
        if (std::abs(phi.at({x, y, z})) > 1.0F) continue;
        const glm::dvec3 gradient(phi.at({x + 1, y, z}) - phi.at({x - 1, y, z}),
                                  phi.at({x, y + 1, z}) - phi.at({x, y - 1, z}),
                                  phi.at({x, y, z + 1}) - phi.at({x, y, z - 1}));
        sum += std::abs(0.5 * glm::length(gradient) - 1.0);
        ++count;
      }
    }
  }
  return sum / count;
}

Mask mask_of(const Geometry& geometry, const Function& inside) {
  Mask mask{geometry, {}};
  for (const float value : sample(geometry, inside)) mask.voxels.push_back(value > 0.0F ? 1 : 0);
  return mask;
}

// The distance from a voxel's centre to the boundary between voxels of the mask, by looking at every voxel.
double brute_force_distance(const Mask& mask, Index3 v, double band) {
  const Geometry& g = mask.geometry;
  const double smallest = std::min({g.spacing_mm.x, g.spacing_mm.y, g.spacing_mm.z});
  const bool inside = mask.voxels[static_cast<std::size_t>(g.offset(v))] != 0;
  double nearest = band;
  for (std::int64_t i = 0; i < g.voxel_count(); ++i) {
    if ((mask.voxels[static_cast<std::size_t>(i)] != 0) == inside) continue;
    const Index3 other = g.voxel_at(i);
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double steps = std::abs(static_cast<double>(other[axis] - v[axis]));
      const double gap = std::max(0.0, steps - 0.5) * g.spacing_mm[axis] / smallest;
      squared += gap * gap;
    }
    nearest = std::min(nearest, std::sqrt(squared));
  }
  return inside ? nearest : -nearest;
}

}  // namespace

class RescalingTest : public QObject {
  Q_OBJECT

 private slots:
  void rescaling_restores_the_gradient_and_keeps_the_surface() {  // T4
    const Geometry geometry = grid({56, 56, 56});
    const glm::dvec3 centre = centre_of(geometry);
    for (const double factor : {3.0, 0.3}) {
      const auto level_set = executor(solver::ExecutorKind::host, zero_volume(geometry), rescaling_alone());
      set_phi(*level_set, geometry, [&](glm::dvec3 p) { return factor * (18.0 - glm::distance(p, centre)); });
      double time = 0.0;
      for (const auto& [until, allowed] : {std::pair(20.0, 0.02), {150.0, 0.05}}) {
        const auto steps = static_cast<std::int64_t>(std::ceil((until - time) / level_set->time_step()));
        run(*level_set, steps);
        time += static_cast<double>(steps) * level_set->time_step();
        const solver::Field phi = level_set->snapshot().value();
        const double drift = std::abs(mean_radius(phi, centre) - 18.0);
        const double error = gradient_error(phi);
        qInfo("T4: from phi x %.1f, at time %.0f: drift %.3f voxel, mean | |grad| - 1 | %.4f", factor, time,
              drift, error);
        QVERIFY(drift <= 0.2);
        QVERIFY(error <= allowed);
        QCOMPARE(failure(level_set->validate()), QString());
      }
    }
  }

  void the_distance_transform_is_exact_in_the_band() {
    for (const glm::dvec3 spacing : {glm::dvec3(1, 1, 1), glm::dvec3(0.8, 0.8, 2.4), glm::dvec3(3, 1, 1.5)}) {
      const Geometry geometry = grid({14, 13, 12}, spacing);
      const Mask mask = mask_of(geometry, [&](glm::dvec3 p) {
        return 4.0 - glm::distance(p, centre_of(geometry)) + std::sin(p.x * 3.0) + std::sin(p.y * 2.0);
      });
      QVERIFY(mask.count() > 20);
      const double band = std::max(2.5, 2.0 * std::max({spacing.x, spacing.y, spacing.z}) /
                                            std::min({spacing.x, spacing.y, spacing.z}));
      const solver::Field phi = solver::distance_transform(mask, band);
      for (std::int64_t i = 0; i < geometry.voxel_count(); ++i) {
        const Index3 v(i % 14, i / 14 % 13, i / (14 * 13));
        QVERIFY(std::abs(phi.at(v) - brute_force_distance(mask, v, band)) < 1e-5);
      }
      QCOMPARE(phi.mask().voxels, mask.voxels);
    }
  }

  void rescaling_alone_computes_and_keeps_the_exact_distance_of_a_mask() {  // T12c
    const Geometry geometry = grid({48, 48, 48});
    // Shapes whose boundary is that of their mask, so that the distance is known everywhere.
    const auto half_space = [](glm::dvec3 p) { return 20.5 - p.x; };
    const auto box = [](glm::dvec3 p) {
      const glm::dvec3 beyond = glm::abs(p - glm::dvec3(23.5)) - glm::dvec3(12.0, 10.0, 9.0);
      const double outside = glm::length(glm::max(beyond, glm::dvec3(0.0)));
      return -outside - std::min(0.0, std::max({beyond.x, beyond.y, beyond.z}));
    };
    // The box's edges are kinks, which the rescaling term rounds off; its faces are judged three voxels away.
    const auto beside_an_edge = [](glm::dvec3 p) {
      const glm::dvec3 beyond = glm::abs(p - glm::dvec3(23.5)) - glm::dvec3(12.0, 10.0, 9.0);
      return (beyond.x > -5.5) + (beyond.y > -5.5) + (beyond.z > -5.5) > 1;
    };
    for (const auto& [is_box, factor] : {std::pair(false, 1.0F), {false, 1.6F}, {true, 1.0F}, {true, 1.6F}}) {
      const Function shape = is_box ? Function(box) : Function(half_space);
      const auto level_set = executor(solver::ExecutorKind::host, zero_volume(geometry), rescaling_alone());
      solver::Field start = solver::distance_transform(mask_of(geometry, shape), level_set->band());
      const auto band = static_cast<float>(start.band);
      for (const std::int64_t page : start.pages.stored_pages()) {
        float* const values = start.pages.change(page);
        for (std::int64_t i = 0; i < start.layout.voxels_per_page(); ++i)
          values[i] = std::clamp(factor * values[i], -band, band);
      }
      QVERIFY(level_set->restore(start));
      run(*level_set, 300);
      const std::vector<float> phi = level_set->snapshot().value().dense();
      const std::vector<float> exact = sample(geometry, shape);
      double worst = 0.0;
      for (std::size_t i = 0; i < phi.size(); ++i) {
        const auto n = static_cast<std::int64_t>(i);
        if (is_box && beside_an_edge(glm::dvec3(n % 48, n / 48 % 48, n / (48 * 48)))) continue;
        worst = std::max(worst, std::abs(static_cast<double>(phi[i] - std::clamp(exact[i], -2.5F, 2.5F))));
      }
      qInfo("T12c: from %.1f times the distance of a mask: largest error %.3f voxel", double(factor), worst);
      QVERIFY(worst <= 0.1);
    }
  }

  void rescaling_alone_computes_the_distance_for_any_target_gradient() {  // T12c
    const Geometry geometry = grid({48, 48, 48});
    const glm::dvec3 centre = centre_of(geometry);
    for (const double gradient : {0.8, 1.0, 1.5}) {
      solver::Parameters parameters = rescaling_alone();
      parameters.target_gradient = gradient;
      parameters.band = 2.5 * std::max(1.0, gradient);  // two and a half voxels to each side
      const auto ball = executor(solver::ExecutorKind::host, zero_volume(geometry), parameters);
      set_phi(*ball, geometry, [&](glm::dvec3 p) { return 0.5 * (15.0 - glm::distance(p, centre)); });
      run(*ball, 60);
      const solver::Field distance = ball->snapshot().value();
      double sum = 0.0;
      double worst = 0.0;
      int count = 0;
      for (std::int64_t i = 0; i < geometry.voxel_count(); ++i) {
        const Index3 v(i % 48, i / 48 % 48, i / (48 * 48));
        const double d = 15.0 - glm::distance(geometry.to_patient(v), centre);
        if (std::abs(d) > 2.0 || std::abs(d) * gradient > 2.0) continue;
        const double error = std::abs(distance.at(v) / gradient - d);
        worst = std::max(worst, error);
        sum += error;
        ++count;
      }
      qInfo("T12c: gradient %.1f: error of the distance %.3f voxel in the mean, %.3f at most", gradient,
            sum / count, worst);
      QVERIFY(sum / count <= 0.1);
      QVERIFY(worst <= 0.1);
    }
  }

  void volume_and_area_of_a_ball_are_right() {
    for (const glm::dvec3 spacing : {glm::dvec3(1, 1, 1), glm::dvec3(0.5, 0.5, 1.5)}) {
      const Geometry geometry = grid({80, 80, 80}, spacing);
      const double smallest = std::min({spacing.x, spacing.y, spacing.z});
      const auto level_set =
          executor(solver::ExecutorKind::host, zero_volume(geometry), solver::Parameters());
      set_phi(*level_set, geometry,
              [&](glm::dvec3 p) { return (15.0 - glm::distance(p, centre_of(geometry))) / smallest; });
      const solver::SurfaceStatistics statistics = solver::measure(level_set->snapshot().value());
      const double volume = 4.0 / 3.0 * std::numbers::pi * 15.0 * 15.0 * 15.0 / 1000.0;
      const double area = 4.0 * std::numbers::pi * 15.0 * 15.0;
      qInfo("ball: %.4f ml of %.4f, %.1f mm2 of %.1f", statistics.volume_ml, volume, statistics.surface_mm2,
            area);
      QVERIFY(std::abs(statistics.volume_ml - volume) < 0.01 * volume);
      QVERIFY(std::abs(statistics.surface_mm2 - area) < 0.02 * area);
      QCOMPARE(statistics.voxels_inside, level_set->snapshot().value().mask().count());

      // The measure does not take phi for a distance.
      set_phi(*level_set, geometry,
              [&](glm::dvec3 p) { return 2.5 * (15.0 - glm::distance(p, centre_of(geometry))) / smallest; });
      const solver::SurfaceStatistics steep = solver::measure(level_set->snapshot().value());
      QVERIFY(std::abs(steep.volume_ml - volume) < 0.01 * volume);
      QVERIFY(std::abs(steep.surface_mm2 - area) < 0.02 * area);
    }
  }
};

TIDEMARK_TEST(RescalingTest)

}  // namespace tidemark::test::rescaling_test

#include "rescaling_test.moc"
