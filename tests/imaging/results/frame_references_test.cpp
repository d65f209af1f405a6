// Results of an image of many frames refer to those frames.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "imaging/dicom/dicom.h"
#include "tests/imaging/dicom/enhanced_files.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/results/sample_results.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::frame_references_test {

namespace {

// All values of ReferencedFrameNumber (0008,1160) below the sequence, one text a reference.
QStringList frame_numbers(const std::filesystem::path& file, const DcmTagKey& sequence) {
  DcmFileFormat loaded;
  if (loaded.loadFile(file.c_str()).bad()) return {"the file cannot be read"};
  QStringList numbers;
  DcmStack stack;
  while (loaded.getDataset()->nextObject(stack, OFTrue).good()) {
    if (stack.top()->getTag() != sequence) continue;
    DcmItem* reference = static_cast<DcmSequenceOfItems*>(stack.top())->getItem(0);
    OFString value;
    reference->findAndGetOFStringArray(DCM_ReferencedFrameNumber, value);
    numbers.append(QString::fromLatin1(value.c_str()));
  }
  return numbers;
}

}  // namespace

class FrameReferencesTest : public QObject {
  Q_OBJECT

  // Of a segment in every slice of the only series, or of the first part of it.
  static void verify_references(const std::filesystem::path& folder, const imaging::Series& series,
                                const QStringList& numbers) {
    imaging::Segment segment;
    segment.name = "all";
    const auto area = static_cast<std::size_t>(series.geometry.size.x * series.geometry.size.y);
    for (std::int64_t k = 0; k < series.geometry.size.z; ++k) {
      segment.slices[k] = std::vector<std::uint8_t>(area, 1);
    }
    const imaging::Segments segments{series.geometry, {segment}, {}};
    QCOMPARE(test::failure(imaging::write_segmentation(segments, series.files, folder / "seg.dcm")),
             QString());
    QCOMPARE(frame_numbers(folder / "seg.dcm", DCM_SourceImageSequence), numbers);
    QCOMPARE(test::failure(imaging::write_structure_set(segments, series.files, folder / "set.dcm")),
             QString());
    // The first is the list of all images.
    QCOMPARE(frame_numbers(folder / "set.dcm", DCM_ContourImageSequence).mid(1), numbers);
  }

 private slots:
  void each_slice_refers_to_its_frame() {
    const Volume volume = test::sample_volume({7, 5, 4});
    auto frames = test::frames_of(volume);
    std::swap(frames[0], frames[2]);
    const test::TemporaryFolder folder;
    test::write_enhanced(frames, folder.path() / "image" / "image.dcm");
    verify_references(folder.path(), test::only_series(folder / "image"), {"3", "2", "1", "4"});
  }

  void where_there_are_several_frames_each_of_them_is_named() {
    const Volume volume = test::sample_volume({7, 5, 3});
    auto frames = test::frames_of(volume);
    const auto first = frames;
    frames.insert(frames.end(), first.begin(), first.end());
    test::Enhanced enhanced;
    enhanced.frame = [](DcmItem& groups, std::size_t frame) {
      test::group(groups, DCM_FrameContentSequence)
          .putAndInsertUint32(DCM_TemporalPositionIndex, static_cast<Uint32>(frame / 3 + 1));
    };
    const test::TemporaryFolder folder;
    test::write_enhanced(frames, folder.path() / "image" / "image.dcm", enhanced);
    const auto found = imaging::scan_dicom(folder / "image");
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{2});
    verify_references(folder.path(), found->series[0], {"1\\4", "2\\5", "3\\6"});
  }

  void frames_of_another_stack_are_not_named() {
    const Volume left = test::sample_volume({7, 5, 3});
    Volume right = left;
    right.geometry.origin_mm += 100.0 * right.geometry.direction[0];
    auto frames = test::frames_of(left);
    for (const test::EnhancedFrame& frame : test::frames_of(right)) frames.push_back(frame);
    test::Enhanced enhanced;
    enhanced.frame = [](DcmItem& groups, std::size_t frame) {
      test::group(groups, DCM_FrameContentSequence)
          .putAndInsertString(DCM_StackID, frame < 3 ? "left" : "right");
    };
    const test::TemporaryFolder folder;
    test::write_enhanced(frames, folder.path() / "image" / "image.dcm", enhanced);
    const auto found = imaging::scan_dicom(folder / "image");
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{2});
    verify_references(folder.path(), found->series[1], {"4", "5", "6"});
  }

  void a_classic_series_refers_to_no_frames() {
    const test::TemporaryFolder folder;
    test::write_series(test::sample_volume({7, 5, 3}), folder / "series");
    verify_references(folder.path(), test::only_series(folder / "series"), {"", "", ""});
  }
};

TIDEMARK_TEST(FrameReferencesTest)

}  // namespace tidemark::test::frame_references_test

#include "frame_references_test.moc"
