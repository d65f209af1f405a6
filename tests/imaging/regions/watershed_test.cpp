// Regions divided at their necks: where the parts meet, and what no seed reaches.
#include "imaging/regions/watershed.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <stop_token>

#include "tests/support/grid.h"
#include "tests/support/test_program.h"

namespace tidemark::test::watershed_test {

namespace {

Region ball(const Geometry& grid, glm::dvec3 centre_mm, double radius_mm) {
  Region region(VoxelRange{Index3(0), grid.size});
  for (std::int64_t at = 0; at < grid.voxel_count(); ++at) {
    const Index3 voxel = grid.voxel_at(at);
    if (glm::distance(grid.to_patient(glm::dvec3(voxel)), centre_mm) <= radius_mm) region.add(voxel);
  }
  return region;
}

Region voxel(Index3 at) {
  return whole({at, at + Index3(1)});
}

}  // namespace

class WatershedTest : public QObject {
  Q_OBJECT

 private slots:
  void parts_meet_at_the_neck_data();
  void parts_meet_at_the_neck();
  void a_voxel_is_in_one_part_and_parts_hang_together();
  void what_no_seed_reaches_is_in_no_part();
  void a_seed_beside_the_region_keeps_to_itself();
  void it_ends_when_it_is_told_to();
};

void WatershedTest::parts_meet_at_the_neck_data() {
  QTest::addColumn<glm::dvec3>("spacing_mm");
  QTest::addColumn<std::int64_t>("second_seed");
  QTest::newRow("seeds on either side") << glm::dvec3(1.0) << std::int64_t{50};
  QTest::newRow("a seed near the border") << glm::dvec3(1.0) << std::int64_t{55};
  QTest::newRow("thick slices") << glm::dvec3(1.0, 1.0, 3.0) << std::int64_t{50};
}

// A large and a small ball: half way between the seeds lies far from the neck.
void WatershedTest::parts_meet_at_the_neck() {
  QFETCH(glm::dvec3, spacing_mm);
  QFETCH(std::int64_t, second_seed);
  const Geometry grid = grid_of({70, 40, static_cast<std::int64_t>(40.0 / spacing_mm.z)}, spacing_mm);
  constexpr double kNeckMm = 38.7;  // where both spheres meet
  const Region large = ball(grid, {22.0, 20.0, 20.0}, 18.0);
  const Region small = ball(grid, {46.0, 20.0, 20.0}, 10.0);
  const Region both = united(large, small);
  const auto deep = static_cast<std::int64_t>(20.0 / spacing_mm.z);
  const auto parts =
      imaging::watershed(both, united(voxel({10, 20, deep}), voxel({second_seed, 20, deep})), grid);
  QVERIFY(parts);
  QCOMPARE(parts->size(), std::size_t{2});
  QVERIFY(united(parts->front(), parts->back()) == both);
  const double reach = static_cast<double>(parts->front().bounds().high.x - 1);
  const double begin = static_cast<double>(parts->back().bounds().low.x);
  QVERIFY2(std::abs(reach - kNeckMm) <= 2.0, qPrintable(QString::number(reach)));
  QVERIFY2(std::abs(begin - kNeckMm) <= 2.0, qPrintable(QString::number(begin)));
}

void WatershedTest::a_voxel_is_in_one_part_and_parts_hang_together() {
  const Geometry grid = grid_of({60, 60, 30});
  Region chain;
  Region seeds;
  for (int n = 0; n < 4; ++n) {
    const glm::dvec3 centre(10.0 + 12.0 * n, 20.0 + 9.0 * (n % 2), 15.0);
    chain = united(chain, ball(grid, centre, 8.0));
    seeds = united(seeds, ball(grid, centre, 2.0));
  }
  const auto parts = imaging::watershed(chain, seeds, grid);
  QVERIFY(parts);
  QCOMPARE(parts->size(), std::size_t{4});
  std::int64_t voxels = 0;
  for (const Region& part : *parts) {
    voxels += part.count();
    QVERIFY(!intersection(part, seeds).empty());
    QVERIFY(difference(part, chain).empty());
  }
  QCOMPARE(voxels, chain.count());
}

void WatershedTest::what_no_seed_reaches_is_in_no_part() {
  const Geometry grid = grid_of({40, 20, 20});
  const Region near = ball(grid, {8.0, 10.0, 10.0}, 6.0);
  const Region far = ball(grid, {30.0, 10.0, 10.0}, 6.0);
  const auto parts = imaging::watershed(united(near, far), voxel({8, 10, 10}), grid);
  QVERIFY(parts);
  QCOMPARE(parts->size(), std::size_t{1});
  QVERIFY(parts->front() == near);
  const auto none = imaging::watershed(near, Region(), grid);
  QVERIFY(none && none->empty());
}

void WatershedTest::a_seed_beside_the_region_keeps_to_itself() {
  const Geometry grid = grid_of({40, 20, 20});
  const Region region = ball(grid, {8.0, 10.0, 10.0}, 6.0);
  const Region apart = voxel({30, 10, 10});
  // This one touches the region, and is no part of it.
  const Region beside = whole({{15, 10, 10}, {16, 11, 11}});
  const auto parts = imaging::watershed(region, united(apart, beside), grid);
  QVERIFY(parts);
  QCOMPARE(parts->size(), std::size_t{2});
  QVERIFY(parts->at(0) == united(region, beside));
  QVERIFY(parts->at(1) == apart);
}

void WatershedTest::it_ends_when_it_is_told_to() {
  const Geometry grid = grid_of({40, 20, 20});
  const Region region = ball(grid, {8.0, 10.0, 10.0}, 6.0);
  std::stop_source stop;
  stop.request_stop();
  const auto parts =
      imaging::watershed(region, voxel({8, 10, 10}), grid, Progress{nullptr, stop.get_token()});
  QVERIFY(!parts);
  QVERIFY(parts.error().kind == ErrorKind::cancelled);
}

TIDEMARK_TEST(WatershedTest)

}  // namespace tidemark::test::watershed_test

#include "watershed_test.moc"
