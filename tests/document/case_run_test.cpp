// The computation of a case of a cohort: what its remarks tell of the files of its row.
#include "document/cohort/case_run.h"

#include <algorithm>

#include "imaging/dicom/dicom.h"
#include "imaging/results/results.h"
#include "tests/document/cases.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::case_run_test {

class CaseRunTest : public QObject {
  Q_OBJECT

 private slots:
  void another_frame_of_reference_is_remarked() {
    const TemporaryFolder folder;
    const auto volume = lumpy_volume();
    QCOMPARE(failure(imaging::write_dicom_series(*volume, {}, folder / "series")), QString());
    const imaging::Series series = only_series(folder / "series");
    imaging::Segment segment;
    const Index3 size = volume->geometry.size;
    for (std::int64_t k = 8; k < 20; ++k)
      segment.slices[k] = std::vector<std::uint8_t>(static_cast<std::size_t>(size.x * size.y), 1);
    const imaging::Segments segments{volume->geometry, {segment}, {}};
    QCOMPARE(failure(imaging::write_segmentation(segments, series.files, folder / "own.dcm")), QString());
    QCOMPARE(failure(imaging::write_segmentation(segments, {}, folder / "other.dcm")), QString());
    const std::string says = "it names another frame of reference than the study";
    for (const char* name : {"own.dcm", "other.dcm"}) {
      cohort::WorkRow row;
      row.id = "one";
      row.input = folder / "series";
      row.mask = folder / name;
      row.speed_map = folder / name;
      row.target = 1000.0;
      row.range = 500.0;
      row.alpha = 0.8;
      row.steps = 1;
      const auto place = folder / (std::string(name) + "-case");
      std::filesystem::create_directories(place);
      cohort::CohortPlan plan;
      plan.pictures = false;
      const auto status = cohort::run_case({plan, 1, 0, "0"}, row, place);
      QCOMPARE(failure(status), QString());
      QCOMPARE(QString::fromStdString(status->reason), QString());
      for (const char* column : {"mask: ", "speed_map: "}) {
        const bool is_told = std::ranges::any_of(
            status->remarks, [&](const std::string& remark) { return remark.starts_with(column + says); });
        QCOMPARE(is_told, std::string(name) == "other.dcm");
      }
    }
  }
};

TIDEMARK_TEST(CaseRunTest)

}  // namespace tidemark::test::case_run_test

#include "case_run_test.moc"
