// The Dice against a known answer, taken page by page.
#include "engine/truth_overlap.h"

#include "tests/document/cases.h"
#include "tests/support/test_program.h"

namespace tidemark::test::truth_overlap_test {

class TruthOverlapTest : public QObject {
  Q_OBJECT

  // A ball of so many mm that is off the middle by so many mm along x.
  static std::shared_ptr<const BitMask> ball(const Geometry& geometry, double off_mm, double radius_mm) {
    auto mask = std::make_shared<BitMask>(geometry);
    const glm::dvec3 centre =
        geometry.to_patient(0.5 * glm::dvec3(geometry.size - Index3(1))) + glm::dvec3(off_mm, 0.0, 0.0);
    for (std::int64_t offset = 0; offset < geometry.voxel_count(); ++offset) {
      const glm::dvec3 middle = geometry.to_patient(glm::dvec3(geometry.voxel_at(offset)));
      if (glm::distance(middle, centre) < radius_mm) mask->add(offset);
    }
    return mask;
  }

 private slots:
  void it_is_the_dice_of_the_masks_data() {
    QTest::addColumn<double>("off_mm");
    QTest::addColumn<double>("radius_mm");
    QTest::newRow("the same") << 0.0 << 12.0;
    QTest::newRow("beside") << 5.0 << 9.0;
    QTest::newRow("within") << 1.0 << 4.0;
    QTest::newRow("apart") << 14.0 << 2.0;
  }

  // Sizes that are no multiples of a page, and a ball in whose middle there are pages without a surface.
  void it_is_the_dice_of_the_masks() {
    QFETCH(double, off_mm);
    QFETCH(double, radius_mm);
    const Geometry geometry{{43, 37, 45}, {1.0, 1.0, 1.0}, glm::dmat3(1.0), {3.0, -2.0, 7.0}};
    const auto inside = ball(geometry, 0.0, 15.0);
    std::vector<float> values;
    for (std::int64_t offset = 0; offset < geometry.voxel_count(); ++offset)
      values.push_back(inside->contains(offset) ? 2.5F : -2.5F);
    const solver::Field phi = solver::Field::from_dense(geometry, values, 2.5);
    std::int64_t constant = 0;  // pages inside throughout
    for (std::int64_t page = 0; page < phi.pages.size(); ++page)
      constant += phi.pages.kind(page) == solver::Field::Kind::inside ? 1 : 0;
    QVERIFY(constant > 0);
    const auto truth = ball(geometry, off_mm, radius_mm);
    engine::TruthOverlap overlap(truth);
    const double expected = dice(Region(phi.mask()), Region(*truth));
    QCOMPARE(overlap.dice(phi), expected);
    QCOMPARE(overlap.dice(phi), expected);  // with what it knows by now
    QVERIFY(expected < 1.0 && expected > 0.0);
    // Other pages.
    QCOMPARE(overlap.dice(solver::Field::from_dense(geometry, values, 2.5, {4, 8, 16})), expected);
  }

  void of_nothing_and_nothing_it_is_one() {
    const Geometry geometry{{9, 9, 9}, {1.0, 1.0, 1.0}, glm::dmat3(1.0), {}};
    engine::TruthOverlap overlap(ball(geometry, 0.0, 0.0));
    QCOMPARE(overlap.dice(solver::Field::empty(geometry, 2.5)), 1.0);
    QCOMPARE(engine::TruthOverlap(ball(geometry, 0.0, 3.0)).dice(solver::Field::empty(geometry, 2.5)), 0.0);
  }
};

TIDEMARK_TEST(TruthOverlapTest)

}  // namespace tidemark::test::truth_overlap_test

#include "truth_overlap_test.moc"
