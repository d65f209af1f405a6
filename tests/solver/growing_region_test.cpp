// The voxels where a speed function lets the surface grow.
#include "solver/speed/growing_region.h"

#include "solver/speed/combined_speed.h"
#include "tests/solver/formula_speed.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::growing_region_test {

using namespace tidemark::solver;

namespace {

// No multiple of what is evaluated at a time.
Geometry grid() {
  Geometry geometry;
  geometry.size = {13, 11, 70};
  return geometry;
}

double wave(glm::dvec3 voxel) {
  return std::sin(0.9 * voxel.x + 0.7 * voxel.y) * std::cos(0.31 * voxel.z);
}

}  // namespace

class GrowingRegionTest : public QObject {
  Q_OBJECT
 private slots:
  void it_has_the_voxels_whose_speed_is_above_0() {
    const BitMask region = growing_region(FormulaSpeed(wave), grid(), {}).value();
    std::int64_t inside = 0;
    for (std::int64_t offset = 0; offset < grid().voxel_count(); ++offset) {
      const bool grows = speed_of(quantised_speed(wave(glm::dvec3(grid().voxel_at(offset))))) > 0.0;
      QCOMPARE(region.contains(offset), grows);
      inside += grows ? 1 : 0;
    }
    QVERIFY(inside > 3000 && inside < 7000);
    const BitMask none = growing_region(FormulaSpeed([](glm::dvec3) { return 0.0; }), grid(), {}).value();
    QCOMPARE(none.count(), std::int64_t{0});
  }

  void a_cache_is_not_filled() {
    const auto function = std::make_shared<FormulaSpeed>(wave);
    const CachedSpeed cached(function, grid().size);
    const std::int64_t before = cached.memory();
    const BitMask region = growing_region(cached, grid(), {}).value();
    QCOMPARE(region.count(), growing_region(*function, grid(), {}).value().count());
    QCOMPARE(cached.memory(), before);
    QCOMPARE(function->evaluated(), 2 * grid().voxel_count());
  }

  void caches_of_joined_functions_are_not_filled() {
    const auto first = std::make_shared<FormulaSpeed>(wave);
    const auto second =
        std::make_shared<FormulaSpeed>([](glm::dvec3 voxel) { return std::cos(0.2 * voxel.y); });
    const auto cached_first = std::make_shared<CachedSpeed>(first, grid().size);
    const auto cached_second = std::make_shared<CachedSpeed>(second, grid().size);
    const std::int64_t before = cached_first->memory();
    for (const Combine combine : {Combine::least, Combine::product}) {
      const BitMask region =
          growing_region(CombinedSpeed({cached_first, cached_second}, combine), grid(), {}).value();
      const BitMask without = growing_region(CombinedSpeed({first, second}, combine), grid(), {}).value();
      QVERIFY(region.count() > 1000);
      QCOMPARE(region.count(), without.count());
    }
    QCOMPARE(cached_first->memory(), before);
    QCOMPARE(cached_second->memory(), before);
  }

  void it_says_how_far_it_is_and_can_be_cancelled() {
    std::vector<double> said;
    const FormulaSpeed function(wave);
    QVERIFY(
        growing_region(function, grid(), {[&](double done, std::string_view) { said.push_back(done); }, {}}));
    QCOMPARE(said.size(), std::size_t{9});  // slabs of 8 slices
    QVERIFY(std::is_sorted(said.begin(), said.end()));
    QCOMPARE(said.back(), 1.0);
    std::stop_source stop;
    const auto cut = growing_region(
        function, grid(), {[&](double, std::string_view) { stop.request_stop(); }, stop.get_token()});
    QVERIFY(!cut);
    QCOMPARE(cut.error().kind, ErrorKind::cancelled);
    QVERIFY(function.evaluated() < 2 * grid().voxel_count());
  }
};

TIDEMARK_TEST(GrowingRegionTest)

}  // namespace tidemark::test::growing_region_test

#include "growing_region_test.moc"
