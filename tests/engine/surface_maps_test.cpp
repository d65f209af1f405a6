// The maps of distances that colour the surface.
#include "engine/surface_maps.h"

#include "tests/support/test_program.h"

namespace tidemark::test::surface_maps_test {
namespace {

// A ball around the middle of the grid.
Region ball(const Geometry& grid, double radius_mm) {
  Mask mask{grid, {}};
  const glm::dvec3 middle = grid.to_patient(0.5 * glm::dvec3(grid.size - Index3(1)));
  for (std::int64_t i = 0; i < grid.voxel_count(); ++i)
    mask.voxels.push_back(glm::distance(grid.to_patient(grid.voxel_at(i)), middle) < radius_mm ? 1 : 0);
  return Region(mask);
}

}  // namespace

class SurfaceMapsTest : public QObject {
  Q_OBJECT

  const Geometry grid_{{41, 41, 41}, {1.0, 1.0, 1.0}, glm::dmat3(1.0), {3.0, -2.0, 7.0}};

  [[nodiscard]] static document::Agreement of(const std::vector<Region>& runs, const Geometry& grid) {
    std::vector<const Region*> pointers;
    for (const Region& run : runs) pointers.push_back(&run);
    return {pointers, grid.size};
  }
  // Along x from the middle of the grid.
  [[nodiscard]] static double at(const solver::SpeedFunction& map, const Geometry& grid, std::int64_t x) {
    double value = 0.0;
    map.evaluate({grid.size / std::int64_t{2} + Index3(x, 0, 0), Index3(1)}, &value);
    return value;
  }

 private slots:
  void where_all_runs_agree_the_surface_is_blue() {
    const auto runs = of({ball(grid_, 10.5), ball(grid_, 10.5), ball(grid_, 10.5)}, grid_);
    const auto map = engine::spread_map(runs, grid_);
    for (const std::int64_t x : {10, 11}) QCOMPARE(at(*map, grid_, x), -1.0);
  }

  void it_tells_how_far_the_surfaces_are_apart() {
    const auto runs = of({ball(grid_, 9.5), ball(grid_, 10.5), ball(grid_, 11.5)}, grid_);
    QCOMPARE(engine::distance_range_mm(grid_), 3.0);
    const auto map = engine::spread_map(runs, grid_);
    for (const std::int64_t x : {10, 11})
      QVERIFY(std::abs(at(*map, grid_, x) - (2.0 * 2.0 / 3.0 - 1.0)) < 1e-6);
    const auto wide = engine::spread_map(of({ball(grid_, 6.5), ball(grid_, 11.5)}, grid_), grid_);
    QCOMPARE(at(*wide, grid_, 9), 1.0);
  }

  // The surface of a case need not be that of a run.
  void away_from_all_runs_nothing_is_blue() {
    const auto map = engine::spread_map(of({ball(grid_, 10.5), ball(grid_, 10.5)}, grid_), grid_);
    for (const std::int64_t x : {2, 5, 16, 20}) QCOMPARE(at(*map, grid_, x), 1.0);
    QVERIFY(at(*map, grid_, 13) > -0.5 && at(*map, grid_, 13) < 1.0);
  }

  void a_surface_that_has_vanished_is_nowhere() {
    const auto runs = of({ball(grid_, 10.5), Region(), ball(grid_, 10.5)}, grid_);
    QCOMPARE(runs.surfaces(), 3);
    QCOMPARE(runs.not_empty(), 2);
    QCOMPARE(at(*engine::spread_map(runs, grid_), grid_, 10), -1.0);
  }

  void distances_are_in_mm_whatever_the_spacing() {
    const Geometry thick{{41, 41, 15}, {1.0, 1.0, 3.0}, glm::dmat3(1.0), {}};
    const auto map = engine::spread_map(of({ball(thick, 9.5), ball(thick, 12.5)}, thick), thick);
    QCOMPARE(engine::distance_range_mm(thick), 9.0);
    QVERIFY(std::abs(at(*map, thick, 11) - (2.0 * 3.0 / 9.0 - 1.0)) < 1e-6);
  }
};

TIDEMARK_TEST(SurfaceMapsTest)

}  // namespace tidemark::test::surface_maps_test

#include "surface_maps_test.moc"
