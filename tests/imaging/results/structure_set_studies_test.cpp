// A structure set that another program wrote, against the mask that another one made of it.
#include "imaging/load_study.h"
#include "imaging/onto_grid.h"
#include "imaging/results/results.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::structure_set_studies_test {

class StructureSetStudiesTest : public QObject {
  Q_OBJECT

 private slots:
  void the_sarcoma_of_a_planning_system_is_its_mask() {
    const auto study = test::studies_folder() / "d21_sarcoma_mr_rtstruct";
    const auto found = imaging::find_series(study / "MR_T1" / "image");
    QCOMPARE(test::failure(found), QString());
    const Geometry& grid = found->series.front().geometry;
    auto mask = imaging::load_mask(study / "MR_T1_mask.nii.gz");
    QCOMPARE(test::failure(mask), QString());
    const auto truth = imaging::onto_grid(std::move(*mask), grid, "mask");
    QCOMPARE(test::failure(truth), QString());
    const auto read = imaging::read_result(study / "MR_T1" / "mask" / "RS.dcm", &grid);
    QCOMPARE(test::failure(read), QString());
    for (const std::string& change : read->changes) qInfo("%s", change.c_str());
    for (const imaging::Segment& segment : read->list) {
      qInfo("%s: %lld voxels", segment.name.c_str(), static_cast<long long>(segment.count()));
    }
    const double overlap = dice(imaging::union_of(*read), *truth);
    qInfo("Dice %.5f", overlap);
    QVERIFY(overlap > 0.99);
  }
};

TIDEMARK_STUDY_TEST(StructureSetStudiesTest)

}  // namespace tidemark::test::structure_set_studies_test

#include "structure_set_studies_test.moc"
