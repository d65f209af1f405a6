// A volume of one slice: the evolution is that of the plane, whatever the slice's thickness.
#include "settings.h"
#include "solver/distance_transform.h"
#include "solver/model.h"
#include "solver/statistics.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::single_slice_test {

namespace {

// Pixels of 1 mm.
Geometry slice_of(std::int64_t size, double thickness_mm) {
  return grid({size, size, 1}, {1.0, 1.0, thickness_mm});
}

void put_disc(solver::Executor& level_set, const Geometry& geometry, double radius_mm) {
  const glm::dvec3 centre = centre_of(geometry);
  set_phi(level_set, geometry, [&](glm::dvec3 p) { return radius_mm - glm::distance(p, centre); });
}

}  // namespace

class SingleSliceTest : public QObject {
  Q_OBJECT

 private slots:
  // kappa = div n is 1 / r in the plane (a ball's is 2 / r), so that r r' = -1.
  void a_disc_shrinks_as_sqrt_of_r0_squared_minus_2t_data() { add_all_rows(); }
  void a_disc_shrinks_as_sqrt_of_r0_squared_minus_2t() {
    const Setting setting = this_row();
    const Geometry geometry = slice_of(72, 5.0);
    solver::Parameters parameters;
    parameters.alpha = 0.0;
    const auto level_set = setting.make(zero_volume(geometry), parameters);
    const double r0 = 25.0;
    put_disc(*level_set, geometry, r0);
    double time = 0.0;
    for (const double part : {0.25, 0.5}) {
      const double until = part * r0 * r0 / 2.0;
      const auto steps = static_cast<std::int64_t>(std::round((until - time) / level_set->time_step()));
      run(*level_set, steps);
      time += static_cast<double>(steps) * level_set->time_step();
      const double exact = std::sqrt(r0 * r0 - 2.0 * time);
      const double radius = mean_radius(level_set->snapshot().value(), centre_of(geometry));
      qInfo("t %.1f: radius %.3f, exact %.3f", time, radius, exact);
      QVERIFY(std::abs(radius - exact) <= 0.015 * r0);  // T1b
    }
    QCOMPARE(failure(level_set->validate()), QString());
  }

  // Unclamped and without rescaling the law holds to the order of the scheme.
  void the_law_holds_to_second_order() {
    const auto error = [](solver::ExecutorKind kind, std::int64_t size) {
      const Geometry geometry = slice_of(size, 3.0);
      solver::Parameters parameters;
      parameters.alpha = 0.0;
      parameters.band = std::numeric_limits<double>::infinity();
      parameters.rescaling_term = false;
      const auto level_set = executor(kind, zero_volume(geometry), parameters);
      const double r0 = 0.35 * static_cast<double>(size);
      put_disc(*level_set, geometry, r0);
      const auto steps = static_cast<std::int64_t>(0.25 * r0 * r0 / level_set->time_step());
      run(*level_set, steps);
      const double exact = std::sqrt(r0 * r0 - 2.0 * static_cast<double>(steps) * level_set->time_step());
      return std::abs(mean_radius(level_set->snapshot().value(), centre_of(geometry)) - exact) / exact;
    };
    for (const auto kind : {solver::ExecutorKind::reference, solver::ExecutorKind::host}) {
      const double coarse = error(kind, 32);
      const double fine = error(kind, 64);
      qInfo("relative error %.2e at 32, %.2e at 64, order %.2f", coarse, fine, order(coarse, fine, 2.0));
      QVERIFY(fine < 1e-3);
      QVERIFY(order(coarse, fine, 2.0) > 1.5);
    }
  }

  // The level set in the plane, in stream's and compute's case in pages of 16 x 16 voxels, beside that of the
  // same picture drawn out along the third axis.
  void a_slice_evolves_as_each_of_equal_slices_does_data() { add_all_rows(); }
  void a_slice_evolves_as_each_of_equal_slices_does() {
    const Setting setting = this_row();
    const auto source = [](glm::dvec3 p) {
      return 100.0 - 3.0 * std::hypot(p.x - 19.0, p.y - 21.0) +
             12.0 * std::sin(p.x / 3.0) * std::cos(p.y / 4.0);
    };
    solver::Parameters parameters;
    parameters.target = 85.0;
    parameters.range = 25.0;
    parameters.alpha = 0.6;
    parameters.band = 4.0;  // that of the thick slices
    std::vector<std::vector<float>> results;
    for (const std::int64_t slices : {1, 5}) {
      const Geometry geometry = grid({40, 40, slices}, {1.0, 1.0, 2.0});
      const auto level_set = setting.make(volume_of(geometry, source), parameters);
      set_phi(*level_set, geometry, [](glm::dvec3 p) { return 8.0 - std::hypot(p.x - 18.3, p.y - 20.6); });
      run(*level_set, 60);
      results.push_back(level_set->snapshot().value().dense());
    }
    float largest = 0.0F;
    for (std::size_t v = 0; v < results[1].size(); ++v) {
      largest = std::max(largest, std::abs(results[1][v] - results[0][v % results[0].size()]));
    }
    qInfo("they differ by %.1e voxels at most", static_cast<double>(largest));
    QVERIFY(largest <= 1e-5F);  // rounding of 60 steps
  }

  void each_step_is_the_references_step_data() { add_rows_with_host(); }
  void each_step_is_the_references_step() {  // T5
    const Scene scene = lumpy_scene({61, 47, 1}, {1.0, 0.8, 5.0});
    const Setting setting = this_row();
    solver::ExecutorOptions options = setting.options();
    options.skip_quiet_pages = false;
    const auto tested = executor(setting.kind, scene.source, scene.parameters, options);
    const auto reference = executor(solver::ExecutorKind::reference, scene.source, scene.parameters);
    put_disc(*tested, scene.geometry, 9.0);
    QVERIFY(largest_difference_of_a_step(*tested, *reference, 30) <= 1e-5);
    QCOMPARE(failure(tested->validate()), QString());
  }

  void a_ball_meets_the_slice_as_a_disc_data() { add_all_rows(); }
  void a_ball_meets_the_slice_as_a_disc() {
    const Geometry geometry = slice_of(40, 2.0);
    const auto level_set = this_row().make(zero_volume(geometry), {});
    const glm::dvec3 centre = centre_of(geometry);
    const auto paint = [&](glm::dvec3 at, double radius_mm) {
      const Status painted = level_set->paint({at, radius_mm}, solver::Brush::add);
      QCOMPARE(failure(painted), QString());
    };
    paint(centre + glm::dvec3(0.0, 0.0, 9.0), 8.0);  // above it
    QCOMPARE(solver::measure(level_set->snapshot().value()).voxels_inside, std::int64_t{0});
    paint(centre + glm::dvec3(0.0, 0.0, 6.0), 10.0);  // a disc of 8 mm
    const double radius = mean_radius(level_set->snapshot().value(), centre);
    QVERIFY(std::abs(radius - 8.0) <= 0.05);  // phi is linear along grid lines but for the ball's curvature
  }

  void its_volume_is_area_times_thickness_and_its_surface_outline_times_thickness() {
    const Geometry geometry = slice_of(64, 7.0);
    const auto level_set = executor(solver::ExecutorKind::host, zero_volume(geometry), {});
    put_disc(*level_set, geometry, 20.0);
    const auto measured = solver::measure(level_set->snapshot().value());
    const double area = std::numbers::pi * 400.0;
    QVERIFY(std::abs(measured.volume_ml - area * 7.0 / 1000.0) < 0.005 * area * 7.0 / 1000.0);
    const double outline = 2.0 * std::numbers::pi * 20.0;
    QVERIFY(std::abs(measured.surface_mm2 - outline * 7.0) < 0.01 * outline * 7.0);
  }

  void a_slice_along_any_axis_has_the_same_volume_and_surface() {
    for (const Index3 page_shape : {Index3(8, 8, 8), Index3(16, 16, 1)}) {
      for (int axis = 0; axis < 3; ++axis) {
        Index3 size(64);
        glm::dvec3 spacing(1.0);
        size[axis] = 1;
        spacing[axis] = 7.0;
        const Geometry geometry = grid(size, spacing);
        const auto disc = [centre = centre_of(geometry)](glm::dvec3 p) {
          return 20.0 - glm::distance(p, centre);
        };
        const auto measured =
            solver::measure(solver::Field::from_dense(geometry, sample(geometry, disc), 2.5, page_shape));
        const double area = std::numbers::pi * 400.0;
        QVERIFY(std::abs(measured.volume_ml - area * 7.0 / 1000.0) < 0.005 * area * 7.0 / 1000.0);
        const double outline = 2.0 * std::numbers::pi * 20.0;
        QVERIFY2(std::abs(measured.surface_mm2 - outline * 7.0) < 0.01 * outline * 7.0,
                 qPrintable(QString::number(measured.surface_mm2)));
      }
    }
  }

  // No surface moves along k, where the band would have to be wide.
  void a_thick_slice_makes_the_band_no_wider() {
    QCOMPARE(solver::default_band(slice_of(40, 9.0)), 2.5);
    QCOMPARE(solver::default_band(grid({40, 40, 2}, {1.0, 1.0, 9.0})), 18.0);
  }

  void a_mask_becomes_its_distance_in_the_plane() {
    Mask mask;
    mask.geometry = slice_of(20, 3.0);
    for (std::int64_t v = 0; v < 400; ++v) mask.voxels.push_back(v % 20 < 8 ? 1 : 0);
    const solver::Field phi = solver::distance_transform(mask, 2.5);
    for (std::int64_t i = 0; i < 20; ++i) {
      const double exact = std::clamp(7.5 - static_cast<double>(i), -2.5, 2.5);
      QVERIFY(std::abs(phi.at({i, 11, 0}) - exact) < 1e-5);
    }
  }
};

TIDEMARK_TEST(SingleSliceTest)

}  // namespace tidemark::test::single_slice_test

#include "single_slice_test.moc"
