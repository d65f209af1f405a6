// Files of several slices that do not say well where those are.
#include <fstream>

#include "imaging/dicom/dicom.h"
#include "tests/imaging/dicom/bad_dicom.h"
#include "tests/imaging/dicom/frame_bytes.h"
#include "tests/support/test_program.h"

namespace tidemark::test::bad_dicom_frames_test {

namespace {

constexpr std::uint32_t kFrames = 0x00280008;

std::string with_groups(const std::vector<std::string>& groups) {
  return file(enhanced(2).put(kFrameGroups, sequence(kFrameGroups, groups)));
}

std::string with_shared(const std::string& groups) {
  return file(enhanced(2).put(kSharedGroups, sequence(kSharedGroups, {groups})));
}

std::vector<BadDicom> group_rows() {
  const std::string good = frame_groups("0\\0\\0");
  const std::string no_slope = sequence(0x00289145, {text(0x00281053, "DS", "0")});
  const std::string orientation = sequence(0x00209116, {text(0x00200037, "DS", "1\\0\\0\\0\\1")});
  const std::string spacing = sequence(0x00289110, {text(0x00280030, "DS", "wide")});
  return {
      {"no groups of frames", file(enhanced(2).remove(kFrameGroups)), "(5200,9230) has 0 items for 2 frames"},
      {"groups in words", file(enhanced(2).put_text(kFrameGroups, "LT", "none")),
       "(5200,9230) has 0 items for 2 frames"},
      {"groups of one frame", with_groups({good}), "(5200,9230) has 1 items for 2 frames"},
      {"groups of three frames", with_groups({good, good, good}), "(5200,9230) has 3 items for 2 frames"},
      {"groups of a thousand frames", with_groups(std::vector<std::string>(1000, good)),
       "(5200,9230) has 1000 items for 2 frames"},
      {"empty groups", with_groups({good, ""}), "frame 2: PlanePositionSequence (0020,9113) is missing"},
      {"an empty position", with_groups({good, sequence(0x00209113, {})}), "(0020,9113) is missing"},
      {"a position of two numbers", with_groups({good, frame_groups("1\\2")}), "(0020,0032) is '1\\2'"},
      {"a position in words", with_groups({frame_groups("here"), good}), "frame 1: ImagePositionPatient"},
      {"a position beyond numbers", with_groups({frame_groups("0\\0\\1e400"), good}), "(0020,0032) is"},
      {"a slope of 0", with_groups({good, frame_groups("0\\0\\1", {}, no_slope)}),
       "frame 2: RescaleSlope (0028,1053) is 0"},
      {"an orientation of five numbers", with_shared(orientation), "(0020,0037) is '1\\0\\0\\0\\1'"},
      {"a spacing in words", with_shared(spacing), "PixelSpacing (0028,0030) is 'wide'"},
      {"70,000 frames", file(enhanced(2).put_text(kFrames, "IS", "70000")), "70000 frames, more than"},
      {"60,000 frames in the bytes of two", file(enhanced(2).put_text(kFrames, "IS", "60000")),
       "has 2 items for 60000 frames"},
      {"the pixels of one frame",
       file(enhanced(2).put(kPixels, element(kPixels, "OW", std::string(24, 'x')))),
       "holds 24 bytes where 2 frames of 4 x 3 pixels"},
      {"segments", file(enhanced(2).put_text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.66.4")),
       "is a DICOM segmentation"},
      {"ultrasound",
       file(enhanced(2)
                .put_text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.3.1")
                .remove(kSharedGroups)
                .remove(kFrameGroups)),
       "(UltrasoundMultiframeImageStorage, 2 frames)"},
  };
}

std::vector<BadDicom> mosaic_rows() {
  const auto cut = [](std::size_t bytes) { return file(mosaic(csa_of_mosaic().substr(0, bytes))); };
  std::string endless = csa_of_mosaic();
  endless.replace(8, 4, "\xff\xff\xff\xff");
  endless.replace(16, 1, "X");
  std::string long_item = csa_of_mosaic();
  long_item.replace(16 + 84 + 4, 4, "\xff\xff\xff\x7f");
  return {
      {"no CSA header", cut(0), "of how many slices"},
      {"the beginning of a CSA header", cut(10), "of how many slices"},
      {"half a CSA header", cut(150), "in which direction"},
      {"a CSA header of 4 billion values", file(mosaic(endless)), "of how many slices"},
      {"a value of 2 GB", file(mosaic(long_item)), "of how many slices"},
      {"no distance", file(mosaic(csa_of_mosaic()).remove(0x00180088)), "how far its slices are apart"},
      {"a distance in words", file(mosaic(csa_of_mosaic()).put_text(0x00180088, "DS", "far")), "how far"},
      {"no orientation", file(mosaic(csa_of_mosaic()).remove(0x00200037)), "(0020,0037)"},
      {"other numbers of slices", file(mosaic(csa_of_mosaic()).put_number(0x0019100a, 3)), "of 3 slices"},
  };
}

// Frames that can be decoded, and make no volume.
std::vector<BadDicom> place_rows() {
  const std::string good = frame_groups("0\\0\\0");
  return {
      {"no shared groups", file(enhanced(2).remove(kSharedGroups)), "(0020,0037) is missing"},
      {"two frames at one place", with_groups({good, good}), "lie at the same position"},
      {"a distance beyond numbers", file(mosaic(csa_of_mosaic()).put_text(0x00180088, "DS", "1e300")),
       "(0018,0088)"},
  };
}

}  // namespace

class BadDicomFramesTest : public QObject {
  Q_OBJECT

 private slots:
  void what_is_well_is_read() {
    for (const Dataset& image : {enhanced(3), mosaic(csa_of_mosaic())}) {
      const TemporaryFolder folder;
      const std::string bytes = file(image);
      std::ofstream(folder / "good.dcm", std::ios::binary)
          .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      const auto found = tidemark::imaging::scan_dicom(folder.path());
      QCOMPARE(failure(found), QString());
      QCOMPARE(found->series.size(), std::size_t{1});
      QVERIFY2(found->series[0].loadable, found->series[0].reason.c_str());
      QCOMPARE(failure(tidemark::imaging::load_dicom(found->series[0])), QString());
    }
  }
  void frames_that_lie_nowhere_are_refused_data() { add_rows(group_rows()); }
  void frames_that_lie_nowhere_are_refused() { verify_refused(); }
  void frames_that_make_no_volume_are_refused_data() { add_rows(place_rows()); }
  void frames_that_make_no_volume_are_refused() {
    QFETCH(QByteArray, bytes);
    QFETCH(QString, field);
    const TemporaryFolder folder;
    std::ofstream(folder / "bad.dcm", std::ios::binary).write(bytes.data(), bytes.size());
    const auto found = tidemark::imaging::scan_dicom(folder.path());
    QCOMPARE(failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{1});
    const tidemark::imaging::Series& series = found->series.front();
    QVERIFY(!series.loadable);
    QVERIFY2(QString::fromStdString(series.reason).contains(field), series.reason.c_str());
  }
  void a_mosaic_of_unknown_slices_is_refused_data() { add_rows(mosaic_rows()); }
  void a_mosaic_of_unknown_slices_is_refused() { verify_refused(); }
};

TIDEMARK_TEST(BadDicomFramesTest)

}  // namespace tidemark::test::bad_dicom_frames_test

#include "bad_dicom_frames_test.moc"
