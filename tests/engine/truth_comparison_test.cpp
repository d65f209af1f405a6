// The distances to a known answer, asked for while a surface moves.
#include "engine/truth_comparison.h"

#include <QSignalSpy>

#include "core/region.h"
#include "solver/distance_transform.h"
#include "tests/support/test_program.h"

namespace tidemark::test::truth_comparison_test {

class TruthComparisonTest : public QObject {
  Q_OBJECT

  // All voxels with x below so many.
  static std::shared_ptr<const BitMask> block(std::int64_t voxels) {
    const Geometry grid{{24, 16, 16}, {0.5, 1.0, 1.0}, glm::dmat3(1.0), {}};
    return std::make_shared<const BitMask>(grid, whole({Index3(0), {voxels, 16, 16}}));
  }
  static std::shared_ptr<const solver::Field> surface_of(const BitMask& mask) {
    return std::make_shared<const solver::Field>(solver::distance_transform(inside_of(mask), 2.5));
  }

 private slots:
  void the_newest_surface_is_compared_with_the_newest_truth() {
    engine::TruthComparison comparison;
    const QSignalSpy answered(&comparison, &engine::TruthComparison::answered);
    QVERIFY(!comparison.distance());
    const auto truth = block(12);
    for (const std::int64_t voxels : {4, 6, 8}) comparison.ask(truth, surface_of(*block(voxels)));
    // Flat faces that are 4 voxels of 0.5 mm apart.
    QTRY_VERIFY(comparison.distance() && std::abs(comparison.distance()->mean_mm - 2.0) < 1e-5);
    QVERIFY(std::abs(comparison.distance()->most_mm - 2.0) < 1e-5);
    QVERIFY(answered.size() < 3);  // it rests in between
    comparison.ask(block(10), surface_of(*block(8)));
    QTRY_VERIFY(comparison.distance() && std::abs(comparison.distance()->mean_mm - 1.0) < 1e-5);
    comparison.forget();
    QVERIFY(!comparison.distance());
  }

  void what_has_no_surface_has_no_distance() {
    engine::TruthComparison comparison;
    const QSignalSpy answered(&comparison, &engine::TruthComparison::answered);
    comparison.ask(block(12), surface_of(*block(0)));
    QTRY_COMPARE(answered.size(), 1);
    QVERIFY(!comparison.distance());
  }

  void it_may_be_gone_before_the_answer() {
    engine::TruthComparison comparison;
    comparison.ask(block(12), surface_of(*block(5)));
  }
};

TIDEMARK_TEST(TruthComparisonTest)

}  // namespace tidemark::test::truth_comparison_test

#include "truth_comparison_test.moc"
