// Coarser grids: where their blocks lie, and what masks, speeds, parameters, walls and phi become on them.
#include "solver/coarse_grid.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include "formula_speed.h"
#include "level_sets.h"
#include "solver/speed/coarse_speed.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::coarse_grid_test {

namespace {

constexpr double kRadius_mm = 14.0;

double ball(const Geometry& geometry, glm::dvec3 patient_mm) {
  const glm::dvec3 middle = geometry.to_patient(0.5 * glm::dvec3(geometry.size - Index3(1)));
  return kRadius_mm - glm::distance(patient_mm, middle);
}

// The distance to a ball's surface that `fine` has in its middle, on another grid over it.
solver::Field ball_on(const Geometry& geometry, const Geometry& fine, double band, Index3 page_shape) {
  const double unit = std::min({geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z});
  std::vector<float> values;
  for (std::int64_t offset = 0; offset < geometry.voxel_count(); ++offset) {
    const glm::dvec3 place = geometry.to_patient(glm::dvec3(geometry.voxel_at(offset)));
    values.push_back(static_cast<float>(ball(fine, place) / unit));
  }
  return solver::Field::from_dense(geometry, values, band, page_shape);
}

Geometry oblique(Index3 size, glm::dvec3 spacing_mm) {
  Geometry geometry = grid(size, spacing_mm);
  geometry.direction = glm::dmat3({0.8, 0.6, 0.0}, {-0.6, 0.8, 0.0}, {0.0, 0.0, 1.0});
  geometry.origin_mm = {-31.0, 12.5, 140.0};
  return geometry;
}

}  // namespace

class CoarseGridTest : public QObject {
  Q_OBJECT

 private slots:
  void axes_are_halved_until_voxels_are_cubes_data() {
    QTest::addColumn<Index3>("size");
    QTest::addColumn<glm::dvec3>("spacing");
    QTest::addColumn<int>("halvings");
    QTest::addColumn<Index3>("factor");
    QTest::addColumn<double>("scale");
    QTest::newRow("none") << Index3(40, 40, 40) << glm::dvec3(1, 1, 1) << 0 << Index3(1, 1, 1) << 1.0;
    QTest::newRow("cubes") << Index3(41, 40, 39) << glm::dvec3(1, 1, 1.25) << 1 << Index3(2, 2, 2) << 2.0;
    QTest::newRow("cubes twice") << Index3(41, 40, 39) << glm::dvec3(1, 1, 1) << 2 << Index3(4, 4, 4) << 4.0;
    QTest::newRow("thick slices") << Index3(64, 64, 20) << glm::dvec3(1, 1, 5) << 2 << Index3(4, 4, 1) << 4.0;
    QTest::newRow("then cubes") << Index3(64, 64, 20) << glm::dvec3(1, 1, 2) << 2 << Index3(4, 4, 2) << 4.0;
    QTest::newRow("one slice") << Index3(64, 64, 1) << glm::dvec3(1, 1, 1) << 1 << Index3(2, 2, 1) << 1.0;
  }
  void axes_are_halved_until_voxels_are_cubes() {
    QFETCH(Index3, size);
    QFETCH(glm::dvec3, spacing);
    QFETCH(int, halvings);
    QFETCH(Index3, factor);
    QFETCH(double, scale);
    const Geometry fine = oblique(size, spacing);
    const solver::CoarseGrid grid(fine, halvings);
    QCOMPARE(grid.factor(), factor);
    QCOMPARE(grid.scale(), scale);
    QCOMPARE(grid.coarse().size, (size + factor - Index3(1)) / factor);
    // A block's centre is the middle of its voxels' centres.
    const glm::dvec3 first = fine.to_patient({0, 0, 0});
    const glm::dvec3 last = fine.to_patient(glm::dvec3(factor - Index3(1)));
    QVERIFY(glm::distance(grid.coarse().to_patient({0, 0, 0}), 0.5 * (first + last)) < 1e-9);
    // Block by block it goes on by as many voxels.
    const glm::dvec3 third = fine.to_patient(2.0 * glm::dvec3(factor));
    QVERIFY(glm::distance(grid.coarse().to_patient({2, 2, 2}) - grid.coarse().to_patient({0, 0, 0}),
                          third - first) < 1e-9);
  }

  void levels_bring_a_volume_to_two_million_voxels() {
    const auto levels = [](Index3 size) { return solver::levels_for(grid(size, {1, 1, 1})); };
    QCOMPARE(levels({64, 64, 64}), 1);
    QCOMPARE(levels({128, 128, 128}), 1);
    QCOMPARE(levels({256, 256, 175}), 2);
    QCOMPARE(levels({512, 512, 275}), 3);
    QCOMPARE(levels({2048, 2048, 1000}), solver::CoarseGrid::kMostLevels);
  }

  void a_ball_is_where_it_was_on_the_finer_grid_data() {
    QTest::addColumn<Index3>("size");
    QTest::addColumn<glm::dvec3>("spacing");
    QTest::addColumn<Index3>("page_shape");
    QTest::newRow("cubes") << Index3(48, 48, 48) << glm::dvec3(1, 1, 1) << Index3(8, 8, 8);
    QTest::newRow("odd") << Index3(45, 47, 43) << glm::dvec3(1, 1, 1.2) << Index3(8, 8, 8);
    QTest::newRow("thick") << Index3(45, 47, 19) << glm::dvec3(1, 1, 3) << Index3(16, 16, 1);
  }
  void a_ball_is_where_it_was_on_the_finer_grid() {
    QFETCH(Index3, size);
    QFETCH(glm::dvec3, spacing);
    QFETCH(Index3, page_shape);
    const Geometry fine = oblique(size, spacing);
    const solver::CoarseGrid grid(fine, 1);
    constexpr double kBand = 2.5;
    const auto coarse = ball_on(grid.coarse(), fine, 4.0, page_shape);
    const auto made = solver::refined(coarse, grid, kBand, page_shape);
    const auto wanted = ball_on(fine, fine, kBand, page_shape);
    QCOMPARE(failure(made.check_fits(fine, kBand)), QString());
    const std::vector<float> is = made.dense();
    const std::vector<float> should_be = wanted.dense();
    // Between voxels h apart linear interpolation of a distance errs by h^2 / 8r along each of two
    // directions; at the grid's end it is constant.
    float most = 0.0F;
    for (std::size_t i = 0; i < is.size(); ++i) {
      const Index3 voxel = fine.voxel_at(static_cast<std::int64_t>(i));
      const bool at_end =
          glm::any(glm::equal(voxel, Index3(0))) || glm::any(glm::equal(voxel, size - Index3(1)));
      if (!at_end) most = std::max(most, std::abs(is[i] - should_be[i]));
    }
    QVERIFY2(most < 0.25F, qPrintable(QString::number(static_cast<double>(most))));
    // Pages that are all inside or all outside are not kept.
    QVERIFY(made.pages.stored() <= wanted.pages.stored() + wanted.pages.stored() / 10);
    QVERIFY(made.pages.stored() > 0);
  }

  // Executors look for the surface on stored pages alone.
  void a_surface_between_two_pages_is_on_one_of_them() {
    const Geometry fine = grid({64, 64, 20}, {1, 1, 5});
    const solver::CoarseGrid grid(fine, 1);
    QCOMPARE(grid.factor(), Index3(2, 2, 1));
    const auto values = sample(grid.coarse(), [](glm::dvec3 p) { return p.z < 37.5 ? 1.25 : -1.25; });
    const auto coarse = solver::Field::from_dense(grid.coarse(), values, 2.0, {8, 8, 8});
    const auto made = solver::refined(coarse, grid, 2.0, {8, 8, 8});
    QCOMPARE(made.mask().count(), std::int64_t{64 * 64 * 8});
    QVERIFY(made.pages.stored() > 0);
    const auto wanted = solver::Field::from_dense(fine, made.dense(), 2.0, {8, 8, 8});
    QVERIFY(made.pages.stored_pages() == wanted.pages.stored_pages());
  }

  void a_block_is_inside_where_half_of_it_is() {
    const Geometry fine = grid({5, 4, 4}, {1, 1, 1});
    Mask mask{fine, std::vector<std::uint8_t>(static_cast<std::size_t>(fine.voxel_count()))};
    const auto put = [&](Index3 voxel) { mask.voxels[static_cast<std::size_t>(fine.offset(voxel))] = 1; };
    for (const Index3 voxel : {Index3(0, 0, 0), Index3(1, 0, 0), Index3(0, 1, 0), Index3(1, 1, 1)})
      put(voxel);
    put({2, 2, 2});
    // The last block of a row of five has half as many voxels.
    for (const Index3 voxel : {Index3(4, 2, 2), Index3(4, 3, 3)}) put(voxel);
    const solver::CoarseGrid grid(fine, 1);
    const Mask coarse = solver::coarsened(inside_of(mask), grid);
    QCOMPARE(coarse.geometry.size, Index3(3, 2, 2));
    QCOMPARE(coarse.count(), std::int64_t{2});
    QCOMPARE(coarse.voxels[static_cast<std::size_t>(coarse.geometry.offset({0, 0, 0}))], std::uint8_t{1});
    QCOMPARE(coarse.voxels[static_cast<std::size_t>(coarse.geometry.offset({2, 1, 1}))], std::uint8_t{1});
  }

  void walls_stay_closed_and_anchors_stay_within() {
    const Geometry fine = grid({20, 12, 12}, {1, 1, 1});
    solver::Constraints constraints(fine.size);
    std::vector<Index3> wall;
    for (std::int64_t k = 0; k < 12; ++k) {
      for (std::int64_t j = 0; j < 12; ++j) wall.push_back({9, j, k});  // one voxel thick
    }
    constraints.set(wall, solver::Constraint::wall);
    std::vector<Index3> anchor;
    for (std::int64_t offset = 0; offset < 8; ++offset) {
      anchor.push_back(Index3(14, 2, 2) + Index3(offset & 1, offset >> 1 & 1, offset >> 2));
    }
    anchor.push_back({17, 5, 5});
    constraints.set(anchor, solver::Constraint::anchor);
    const auto coarse = solver::coarsened(constraints, solver::CoarseGrid(fine, 1));
    QCOMPARE(coarse.count(solver::Constraint::wall), std::int64_t{36});
    for (std::int64_t k = 0; k < 6; ++k) {
      for (std::int64_t j = 0; j < 6; ++j) QCOMPARE(coarse.at({4, j, k}), solver::Constraint::wall);
    }
    QCOMPARE(coarse.count(solver::Constraint::anchor), std::int64_t{1});
    QCOMPARE(coarse.at({7, 1, 1}), solver::Constraint::anchor);
  }

  // In a place with D = 1 a ball of radius r neither grows nor shrinks where alpha = (1 - alpha) 2 / r.
  void terms_balance_at_the_same_radius() {
    solver::Parameters parameters;
    const solver::CoarseGrid grid(test::grid({64, 64, 64}, {0.7, 0.7, 0.7}), 2);
    for (const double alpha : {0.1, 0.5, 0.9}) {
      parameters.alpha = alpha;
      const double coarse = solver::coarsened(parameters, grid).alpha;
      const double radius = 2.0 * (1.0 - alpha) / alpha;                          // in fine voxels
      const double coarse_radius = grid.scale() * 2.0 * (1.0 - coarse) / coarse;  // in fine voxels, too
      QVERIFY(std::abs(radius - coarse_radius) < 1e-12 * radius);
      // A velocity grows as the weights of the other two do.
      const double factor = solver::velocity_factor(parameters, grid);
      QVERIFY(std::abs(factor - coarse / alpha) < 1e-12 * factor);
      QVERIFY(std::abs(factor - grid.scale() * (1.0 - coarse) / (1.0 - alpha)) < 1e-12 * factor);
    }
    for (const double alpha : {0.0, 1.0}) {
      parameters.alpha = alpha;
      QCOMPARE(solver::coarsened(parameters, grid).alpha, alpha);
      QCOMPARE(solver::velocity_factor(parameters, grid), alpha == 0.0 ? grid.scale() : 1.0);
    }
  }

  // With D = 1 and a flow inward of k r a ball rests where alpha = (1 - alpha) 2 / r + k r; by upwind
  // differences about a voxel further in. Were the flow not faster on the coarse grid it would rest at 15.4
  // mm there.
  void a_flow_holds_a_ball_at_the_same_radius() {
    constexpr double kRest_mm = 12.0;
    solver::Parameters parameters;
    parameters.alpha = 0.6;
    const double inward = (parameters.alpha - (1.0 - parameters.alpha) * 2.0 / kRest_mm) / kRest_mm;
    const Geometry fine = grid({48, 48, 48}, {1, 1, 1});
    const solver::CoarseGrid half(fine, 1);
    const glm::dvec3 middle = centre_of(fine);
    const auto function = std::make_shared<const FormulaSpeed>(
        [](glm::dvec3) { return 1.0; },
        [&](glm::dvec3 voxel) { return glm::vec3(-inward * (voxel - middle)); },
        inward * glm::length(middle));
    const auto radius_at_rest = [&](const Geometry& geometry, const solver::Parameters& balanced,
                                    std::shared_ptr<const solver::SpeedFunction> speed) {
      const auto level_set = executor(solver::ExecutorKind::host, zero_volume(geometry), balanced);
      if (!level_set->set_speed(std::move(speed)) ||
          !level_set->paint({middle, kRest_mm}, solver::Brush::add)) {
        qFatal("the ball cannot be placed");
      }
      run(*level_set, 600);
      return mean_radius(level_set->snapshot().value(), middle);
    };
    const double alone_mm = radius_at_rest(fine, parameters, function);
    const auto on_coarse_grid = [&](double factor) {
      return radius_at_rest(half.coarse(), solver::coarsened(parameters, half),
                            std::make_shared<const solver::CoarseSpeed>(function, half, factor));
    };
    const double coarse_mm = on_coarse_grid(solver::velocity_factor(parameters, half));
    const double unscaled_mm = on_coarse_grid(1.0);
    qInfo("at rest at %.2f mm, on the coarse grid at %.2f mm; by the fine grid's velocity there at %.2f mm",
          alone_mm, coarse_mm, unscaled_mm);
    QVERIFY(std::abs(alone_mm - kRest_mm) < 1.25);
    QVERIFY(std::abs(coarse_mm - kRest_mm) < 1.25 * 2.0);  // of voxels twice as large
    QVERIFY(unscaled_mm > coarse_mm + 3.0);
  }

  void speed_is_the_mean_of_a_block_in_every_box() {
    const Geometry fine = grid({13, 10, 9}, {1, 1, 1});
    const solver::CoarseGrid grid(fine, 1);
    const auto function = std::make_shared<const FormulaSpeed>(
        [](glm::dvec3 v) { return std::sin(0.7 * (v.x + 3.0 * v.y + 5.0 * v.z)); },
        [](glm::dvec3 v) { return glm::vec3(0.1 * v.x, 0.0, -0.05 * v.z); }, 1.3);
    constexpr double kFaster = 1.25;
    const solver::CoarseSpeed coarse(function, grid, kFaster);
    QVERIFY(coarse.advects());
    QCOMPARE(coarse.fastest_advection(), kFaster * function->fastest_advection());
    const solver::VoxelBox all{{0, 0, 0}, grid.coarse().size};
    std::vector<double> speed(static_cast<std::size_t>(all.voxels()));
    std::vector<glm::vec3> velocity(static_cast<std::size_t>(all.voxels()));
    coarse.evaluate(all, speed.data());
    coarse.evaluate_advection(all, velocity.data());
    for (std::int64_t offset = 0; offset < all.voxels(); ++offset) {
      const Index3 block = grid.coarse().voxel_at(offset);
      const Index3 size = grid.size_of(block);
      double sum = 0.0;
      glm::dvec3 drift(0.0);
      for (std::int64_t k = 0; k < size.z; ++k) {
        for (std::int64_t j = 0; j < size.y; ++j) {
          for (std::int64_t i = 0; i < size.x; ++i) {
            const Index3 voxel = grid.first_of(block) + Index3(i, j, k);
            double one = 0.0;
            glm::vec3 v;
            function->evaluate({voxel, Index3(1)}, &one);
            function->evaluate_advection({voxel, Index3(1)}, &v);
            sum += one;
            drift += glm::dvec3(v);
          }
        }
      }
      const auto count = static_cast<double>(size.x * size.y * size.z);
      const auto i = static_cast<std::size_t>(offset);
      QVERIFY(std::abs(speed[i] - sum / count) < 1e-12);
      QVERIFY(glm::distance(glm::dvec3(velocity[i]), kFaster * drift / count) < 1e-6);
      double alone = 0.0;
      coarse.evaluate({block, Index3(1)}, &alone);
      QCOMPARE(alone, speed[i]);
    }
  }
};

TIDEMARK_TEST(CoarseGridTest)

}  // namespace tidemark::test::coarse_grid_test

#include "coarse_grid_test.moc"
