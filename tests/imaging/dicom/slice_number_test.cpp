// The numbers of slices are those that other systems show.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "imaging/dicom/slice_number.h"
#include "imaging/load_study.h"
#include "tests/imaging/dicom/enhanced_files.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::slice_number_test {

using Numbers = std::vector<imaging::SliceNumber>;

namespace {

// Against the order of slices, from 101 on.
void number_backwards(const std::vector<std::filesystem::path>& files) {
  for (std::size_t k = 0; k < files.size(); ++k) {
    test::set_text(files[k], 0x0020, 0x0013, std::to_string(101 + files.size() - 1 - k).c_str());
  }
}

}  // namespace

class SliceNumberTest : public QObject {
  Q_OBJECT

 private slots:
  void instances_may_count_down_and_from_any_number() {
    const test::TemporaryFolder folder;
    number_backwards(test::write_series(test::sample_volume({7, 5, 4}), folder.path()));
    QVERIFY(imaging::slice_numbers(test::only_series(folder.path())) ==
            (Numbers{{104, {}}, {103, {}}, {102, {}}, {101, {}}}));
  }

  void a_file_without_a_number_has_none_data() {
    QTest::addColumn<QString>("text");
    QTest::newRow("absent") << "";
    QTest::newRow("no number") << "three";
    QTest::newRow("no integer") << "2.5";
    QTest::newRow("beyond 32 bits") << "1e30";
  }

  void a_file_without_a_number_has_none() {
    QFETCH(QString, text);
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({7, 5, 3}), folder.path());
    number_backwards(files);
    test::set_text(files[1], 0x0020, 0x0013, text.toUtf8());
    QVERIFY(imaging::slice_numbers(test::only_series(folder.path())) == (Numbers{{103, {}}, {}, {101, {}}}));
  }

  void slices_made_between_images_have_none() {
    const test::TemporaryFolder folder;
    const auto files = test::write_series(test::sample_volume({7, 5, 5}), folder.path());
    number_backwards(files);
    std::filesystem::remove(files[2]);
    imaging::GridPolicy policy;
    policy.gaps = imaging::GridPolicy::Gaps::fill;
    const imaging::Series series = imaging::by_policy(test::only_series(folder.path()), policy);
    QCOMPARE(QString::fromStdString(series.reason), QString());
    QVERIFY(imaging::slice_numbers(series) == (Numbers{{105, {}}, {104, {}}, {}, {102, {}}, {101, {}}}));
  }

  void slices_that_a_tilt_moved_keep_theirs() {
    const test::TemporaryFolder folder;
    const Volume volume = test::sample_volume({7, 5, 3});
    const auto files = test::write_series(volume, folder.path());
    number_backwards(files);
    test::tilt(files, volume.geometry, 0.5);
    const imaging::Series series = test::only_series(folder.path());
    QVERIFY(!series.grid.slices.empty());
    QVERIFY(imaging::slice_numbers(series) == (Numbers{{103, {}}, {102, {}}, {101, {}}}));
  }

  void a_file_of_many_frames_numbers_its_frames() {
    const test::TemporaryFolder folder;
    const Volume volume = test::sample_volume({7, 5, 3});
    auto frames = test::frames_of(volume);
    std::swap(frames.front(), frames.back());
    test::Enhanced enhanced;
    enhanced.whole = [](DcmDataset& whole) { whole.putAndInsertString(DCM_InstanceNumber, "7"); };
    test::write_enhanced(frames, folder / "one.dcm", enhanced);
    QVERIFY(imaging::slice_numbers(test::only_series(folder.path())) == (Numbers{{{}, 3}, {{}, 2}, {{}, 1}}));
  }

  void a_volume_file_has_none() { QVERIFY(imaging::slice_numbers(imaging::Series()).empty()); }
};

TIDEMARK_TEST(SliceNumberTest)

}  // namespace tidemark::test::slice_number_test

#include "slice_number_test.moc"
