// Truths out of files with several segments: the one that is meant.
#include "document/truth.h"
#include "imaging/results/results.h"
#include "tests/imaging/results/sample_results.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::truth_test {

class TruthTest : public QObject {
  Q_OBJECT

  // One of the segments.
  [[nodiscard]] Region region(std::size_t place) const {
    return Region(imaging::union_of({grid_, {segments_.list[place]}, {}}));
  }

 private slots:
  void a_segment_is_meant_by_its_number() {
    const auto file = folder_ / "seg.dcm";
    QCOMPARE(failure(imaging::write_segmentation(segments_, {}, file)), QString());
    renumber_segments(file, {2, 1, 9});
    for (const auto& [number, place] : {std::pair(1, 1), std::pair(2, 0), std::pair(9, 2)}) {
      const auto truth = document::load_truth(file, number, grid_);
      QCOMPARE(failure(truth), QString());
      QVERIFY(Region(*truth) == region(static_cast<std::size_t>(place)));
    }
    const auto all = document::load_truth(file, {}, grid_);
    QCOMPARE(failure(all), QString());
    QVERIFY(Region(*all) == Region(imaging::union_of(segments_)));
    const auto none = document::load_truth(file, 3, grid_);
    QVERIFY(!none);
    QCOMPARE(none.error().kind, ErrorKind::usage);
    QVERIFY2(failure(none).contains("seg.dcm has no segment of that number"), qPrintable(failure(none)));
  }

  void a_region_of_a_structure_set_is_meant_by_its_place() {
    const auto file = folder_ / "set.dcm";
    QCOMPARE(failure(imaging::write_structure_set(segments_, {}, file)), QString());
    const auto truth = document::load_truth(file, 3, grid_);
    QCOMPARE(failure(truth), QString());
    QVERIFY(Region(*truth) == region(2));
    for (const int number : {0, 4}) QVERIFY(!document::load_truth(file, number, grid_));
  }

 private:
  TemporaryFolder folder_;
  Geometry grid_ = sample_grid({21, 17, 6}, glm::dmat3(1.0));
  imaging::Segments segments_ = speckled_segments(grid_);
};

TIDEMARK_TEST(TruthTest)

}  // namespace tidemark::test::truth_test

#include "truth_test.moc"
