// Images of several frames: where each lies, what its values mean, and how they are decoded.
#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <random>

#include "imaging/dicom/dicom.h"
#include "imaging/dicom/header_reader.h"
#include "imaging/dicom/pixels.h"
#include "imaging/load_study.h"
#include "tests/imaging/dicom/enhanced_files.h"
#include "tests/imaging/dicom/recode.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::dicom_frames_test {

namespace fs = std::filesystem;

namespace {

// With the axes i and j along patient axes, or against them.
Volume turned_volume(int i_axis, int j_axis, bool i_back, bool j_back) {
  Volume volume = test::sample_volume({7, 5, 4});
  glm::dvec3 i(0.0);
  glm::dvec3 j(0.0);
  i[i_axis] = i_back ? -1.0 : 1.0;
  j[j_axis] = j_back ? -1.0 : 1.0;
  volume.geometry.direction = {i, j, glm::cross(i, j)};
  return volume;
}

void use_file_of(const Volume& volume, const fs::path& file, const test::Enhanced& enhanced = {}) {
  test::write_enhanced(test::frames_of(volume), file, enhanced);
}

}  // namespace

class DicomFramesTest : public QObject {
  Q_OBJECT

  static void verify_reads(const fs::path& path, const Volume& written) {
    const imaging::Series series = test::only_series(path);
    QVERIFY2(series.loadable, series.reason.c_str());
    const auto read = imaging::load_dicom(series);
    QCOMPARE(test::failure(read), QString());
    test::verify_same(*read, written);
  }

  static void verify_refused(const fs::path& path, const QStringList& parts) {
    const auto found = imaging::scan_dicom(path);
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), std::size_t{1});
    QVERIFY(!found->series.front().loadable);
    const QString reason = QString::fromStdString(found->series.front().reason);
    for (const QString& part : parts) QVERIFY2(reason.contains(part), qPrintable(reason));
  }

 private slots:
  void initTestCase() { test::register_encoders(); }

  void an_enhanced_image_is_read_in_every_orientation_and_order_data() {
    QTest::addColumn<int>("turn");
    for (int turn = 0; turn < 24; ++turn) QTest::addRow("orientation %d", turn) << turn;
  }

  void an_enhanced_image_is_read_in_every_orientation_and_order() {
    QFETCH(int, turn);
    constexpr std::array<std::array<int, 2>, 6> kAxes{{{0, 1}, {0, 2}, {1, 0}, {1, 2}, {2, 0}, {2, 1}}};
    const auto [i, j] = kAxes[static_cast<std::size_t>(turn / 4)];
    const Volume written = turned_volume(i, j, turn % 2 == 1, turn % 4 > 1);
    auto frames = test::frames_of(written);
    std::shuffle(frames.begin(), frames.end(), std::mt19937(static_cast<unsigned>(turn)));
    const test::TemporaryFolder folder;
    const std::array kClasses{UID_EnhancedMRImageStorage, UID_EnhancedCTImageStorage,
                              UID_LegacyConvertedEnhancedCTImageStorage};
    test::Enhanced enhanced;
    enhanced.sop_class = kClasses[static_cast<std::size_t>(turn) % 3];
    test::write_enhanced(frames, folder / "image.dcm", enhanced);
    verify_reads(folder.path(), written);
  }

  void rescale_of_each_frame_is_applied() {
    const Volume written = test::sample_volume({7, 5, 3});
    const test::TemporaryFolder folder;
    test::Enhanced enhanced;
    enhanced.frame = [](DcmItem& groups, std::size_t frame) {
      if (frame != 1) return;
      DcmItem& values = test::group(groups, DCM_PixelValueTransformationSequence);
      values.putAndInsertString(DCM_RescaleSlope, "0.25");
      values.putAndInsertString(DCM_RescaleIntercept, "100");
    };
    use_file_of(written, folder / "image.dcm", enhanced);
    const imaging::Series series = test::only_series(folder.path());
    QCOMPARE(series.scalar, std::string("float"));
    const auto read = imaging::load_dicom(series);
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(read->value(Index3{3, 2, 0}), written.value(Index3{3, 2, 0}));
    QCOMPARE(read->value(Index3{3, 2, 1}), 0.25F * written.value(Index3{3, 2, 1}) + 100.0F);
    QCOMPARE(read->value(Index3{3, 2, 2}), written.value(Index3{3, 2, 2}));
  }

  void a_window_of_its_own_and_one_slice_alone() {
    const Volume written = test::sample_volume({7, 5, 3});
    const test::TemporaryFolder folder;
    test::Enhanced enhanced;
    enhanced.frame = [](DcmItem& groups, std::size_t) {
      DcmItem& window = test::group(groups, DCM_FrameVOILUTSequence);
      window.putAndInsertString(DCM_WindowCenter, "300");
      window.putAndInsertString(DCM_WindowWidth, "900");
    };
    use_file_of(written, folder / "image.dcm", enhanced);
    const imaging::Series series = test::only_series(folder.path());
    QCOMPARE(series.files.size(), std::size_t{1});
    QCOMPARE(series.sources.size(), std::size_t{3});
    const auto slice = imaging::load_slice(series, 1);
    QCOMPARE(test::failure(slice), QString());
    QCOMPARE(slice->geometry.size, Index3(7, 5, 1));
    QVERIFY(glm::length(slice->geometry.origin_mm - written.geometry.to_patient({0.0, 0.0, 1.0})) < 1e-6);
    QCOMPARE(slice->value(Index3{3, 2, 0}), written.value(Index3{3, 2, 1}));
    QVERIFY(slice->window.has_value());
    QCOMPARE(slice->window->centre, 300.0);
    QCOMPARE(slice->window->width, 900.0);
  }

  void two_stacks_and_three_times_are_volumes_of_their_own() {
    std::vector<Volume> written(6, test::sample_volume({7, 5, 4}));
    for (std::size_t v = 0; v < written.size(); ++v) {
      std::get<std::vector<std::int16_t>>(written[v].voxels)[17] = static_cast<std::int16_t>(v);
      if (v >= 3) written[v].geometry.origin_mm += glm::dvec3(0.0, 90.0, 1.0);
    }
    std::vector<test::EnhancedFrame> frames;
    for (std::int64_t k = 0; k < 4; ++k) {
      for (const Volume& volume : written) frames.push_back({&volume, k});
    }
    test::Enhanced enhanced;
    enhanced.frame = [](DcmItem& groups, std::size_t frame) {
      DcmItem& content = test::group(groups, DCM_FrameContentSequence);
      content.putAndInsertString(DCM_StackID, frame % 6 < 3 ? "1" : "2");
      content.putAndInsertUint32(DCM_TemporalPositionIndex, static_cast<Uint32>(frame % 3 + 1));
    };
    const test::TemporaryFolder folder;
    test::write_enhanced(frames, folder / "image.dcm", enhanced);
    const auto found = imaging::scan_dicom(folder.path());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), written.size());
    for (std::size_t v = 0; v < written.size(); ++v) {
      const imaging::Series& series = found->series[v];
      const std::string label = fmt::format("stack {}, time {} of 3", v / 3 + 1, v % 3 + 1);
      QCOMPARE(series.description, "Sample, " + label);
      const auto read = imaging::load_volume(folder.path(), series.uid);
      QCOMPARE(test::failure(read), QString());
      test::verify_same(*read, written[v]);
    }
    // Without a number the UID stands for all of them.
    const std::string uid = found->series[0].uid.substr(0, found->series[0].uid.find('#'));
    const auto any = imaging::load_volume(folder.path(), uid);
    QCOMPARE(test::failure(any), QString());
    QVERIFY2(any->changes.front().find("6 volumes of this series can be loaded") == 0,
             any->changes.front().c_str());
  }

  void compressed_frames_are_decoded_one_by_one_data() {
    QTest::addColumn<int>("syntax");
    for (const E_TransferSyntax syntax :
         {EXS_LittleEndianImplicit, EXS_BigEndianExplicit, EXS_DeflatedLittleEndianExplicit, EXS_RLELossless,
          EXS_JPEGProcess14SV1, EXS_JPEGLSLossless}) {
      QTest::newRow(DcmXfer(syntax).getXferName()) << static_cast<int>(syntax);
    }
  }

  void compressed_frames_are_decoded_one_by_one() {
    QFETCH(int, syntax);
    const Volume written = test::sample_volume_uint16({17, 13, 5});
    const test::TemporaryFolder folder;
    use_file_of(written, folder / "image.dcm");
    QVERIFY(test::recode(folder / "image.dcm", static_cast<E_TransferSyntax>(syntax), false));
    verify_reads(folder.path(), written);
  }

  void fragments_are_put_together_with_an_offset_table_and_without_data() {
    QTest::addColumn<int>("pieces");
    QTest::addColumn<bool>("has_table");
    for (const int pieces : {1, 3}) {
      QTest::addRow("%d a frame", pieces) << pieces << false;
      QTest::addRow("%d a frame, table", pieces) << pieces << true;
    }
  }

  void fragments_are_put_together_with_an_offset_table_and_without() {
    QFETCH(int, pieces);
    QFETCH(bool, has_table);
    const Volume written = test::sample_volume_uint16({17, 13, 5});
    const test::TemporaryFolder folder;
    const fs::path file = folder / "image.dcm";
    use_file_of(written, file);
    DcmFileFormat loaded;
    QVERIFY(loaded.loadFile(file.c_str()).good());
    loaded.loadAllDataIntoMemory();
    test::encode_frames_j2k(*loaded.getDataset(), pieces, has_table);
    QVERIFY(loaded.saveFile(file.c_str(), EXS_JPEG2000LosslessOnly).good());
    verify_reads(folder.path(), written);
  }

  // Frames of 35 bytes begin in the middle of a word.
  void bytes_in_words_of_either_order_are_read_frame_by_frame() {
    const Volume written = test::sample_volume_uint16({7, 5, 3});
    for (const E_TransferSyntax syntax : {EXS_LittleEndianExplicit, EXS_BigEndianExplicit}) {
      const test::TemporaryFolder folder;
      test::Enhanced enhanced;
      enhanced.whole = [](DcmDataset& dataset) {
        std::vector<Uint16> words(53);  // the first byte in the low half
        for (std::size_t w = 0; w < words.size(); ++w) {
          const auto byte = [](std::size_t i) { return static_cast<Uint16>((i * 2 + 5) % 256); };
          words[w] = static_cast<Uint16>(byte(2 * w) | byte(2 * w + 1) << 8);
        }
        dataset.putAndInsertUint16(DCM_BitsAllocated, 8);
        dataset.putAndInsertUint16(DCM_BitsStored, 8);
        dataset.putAndInsertUint16(DCM_HighBit, 7);
        dataset.putAndInsertUint16Array(DcmTag(DCM_PixelData, EVR_OW), words.data(), 53);
      };
      use_file_of(written, folder / "image.dcm", enhanced);
      QVERIFY(test::recode(folder / "image.dcm", syntax, false));
      const auto read = imaging::load_dicom(test::only_series(folder.path()));
      QCOMPARE(test::failure(read), QString());
      for (const Index3 v : {Index3{0, 0, 0}, Index3{3, 2, 1}, Index3{6, 4, 2}}) {
        QCOMPARE(read->value(v), static_cast<float>(read->geometry.offset(v) * 2 + 5));
      }
    }
  }

  void a_reconstruction_of_nuclear_medicine_is_read_along_its_normal() {
    for (const double distance : {2.5, -2.5}) {
      Volume written = test::sample_volume({7, 5, 4});
      const test::TemporaryFolder folder;
      test::Enhanced nuclear;
      nuclear.sop_class = UID_NuclearMedicineImageStorage;
      nuclear.whole = [&](DcmDataset& dataset) {
        for (const DcmTagKey& key :
             {DCM_SharedFunctionalGroupsSequence, DCM_PerFrameFunctionalGroupsSequence}) {
          delete dataset.remove(key);
        }
        dataset.putAndInsertString(DCM_ImageType, "ORIGINAL\\PRIMARY\\RECON TOMO\\EMISSION");
        dataset.putAndInsertString(DCM_FrameIncrementPointer, "(0054,0080)");
        const Uint16 slices[] = {1, 2, 3, 4};
        dataset.putAndInsertUint16Array(DCM_SliceVector, slices, 4);
        dataset.putAndInsertString(DCM_PixelSpacing, "0.9\\0.7");
        dataset.putAndInsertString(DCM_SpacingBetweenSlices, distance > 0.0 ? "2.5" : "-2.5");
        DcmItem& detector = test::group(dataset, DCM_DetectorInformationSequence);
        detector.putAndInsertString(DCM_ImagePositionPatient, "1\\2\\3");
        detector.putAndInsertString(DCM_ImageOrientationPatient, "1\\0\\0\\0\\1\\0");
      };
      use_file_of(written, folder / "image.dcm", nuclear);
      const imaging::Series series = test::only_series(folder.path());
      QVERIFY2(series.loadable, series.reason.c_str());
      const double lowest = distance > 0.0 ? 3.0 : 3.0 - 7.5;
      QVERIFY(glm::length(series.geometry.origin_mm - glm::dvec3(1.0, 2.0, lowest)) < 1e-9);
      QCOMPARE(series.sources.front().frame, std::int64_t{distance > 0.0 ? 0 : 3});
      // A projection is not a slice.
      test::set_text(folder / "image.dcm", 0x0008, 0x0008, "ORIGINAL\\PRIMARY\\TOMO\\EMISSION");
      verify_refused(folder.path(), {"NuclearMedicineImageStorage, 4 frames", "where the frames lie"});
    }
  }

  void fragments_that_are_not_the_frames_promised_are_refused() {
    const Volume written = test::sample_volume_uint16({17, 13, 2});
    const auto values = std::get<std::vector<std::uint16_t>>(written.voxels);
    const std::vector<std::int32_t> first(values.begin(), values.begin() + 17 * 13);
    const auto stream = test::encode_j2k(first, 17, 13, 16, false, false);
    for (const int pieces : {2, 3}) {
      const test::TemporaryFolder folder;
      const fs::path file = folder / "image.dcm";
      use_file_of(written, file);
      DcmFileFormat loaded;
      QVERIFY(loaded.loadFile(file.c_str()).good());
      loaded.loadAllDataIntoMemory();
      test::encapsulate(*loaded.getDataset(), EXS_JPEG2000LosslessOnly, stream, pieces);
      QVERIFY(loaded.saveFile(file.c_str(), EXS_JPEG2000LosslessOnly).good());
      const auto frame = imaging::decode_frame(file, 1);
      QVERIFY(!frame);
      const QString message = QString::fromStdString(frame.error().message);
      const QString expected = pieces == 2 ? "PixelData (7FE0,0010), frame 2, holds no JPEG 2000 stream"
                                           : "PixelData (7FE0,0010) holds 3 fragments for 2 frames";
      QVERIFY2(message.contains(expected), qPrintable(message));
    }
  }

  // Each frame's header holds what the file says once.
  void long_texts_are_kept_short() {
    const std::string text(60'000, 'x');
    const test::TemporaryFolder folder;
    test::Enhanced enhanced;
    enhanced.whole = [&](DcmDataset& dataset) {
      for (const DcmTagKey& key : {DCM_SeriesDescription, DCM_Modality, DCM_ImageType, DCM_PatientID}) {
        dataset.putAndInsertString(DcmTag(key, EVR_LT), text.c_str());
      }
    };
    use_file_of(test::sample_volume({7, 5, 3}), folder / "image.dcm", enhanced);
    const auto slices = imaging::read_slice_headers(folder / "image.dcm");
    QVERIFY2(slices, slices ? "" : slices.error().message.c_str());
    QCOMPARE(slices->size(), std::size_t{3});
    const imaging::SliceHeader& slice = slices->back();
    for (const std::string& kept :
         {slice.description, slice.modality, slice.traits.image_type, slice.patient.id}) {
      QVERIFY2(!kept.empty() && kept.size() <= 800, kept.c_str());
    }
  }

  void frames_without_a_place_are_refused_by_name() {
    const Volume written = test::sample_volume({7, 5, 3});
    const auto refused = [&](const test::Enhanced& enhanced, const QStringList& parts) {
      const test::TemporaryFolder folder;
      use_file_of(written, folder / "image.dcm", enhanced);
      verify_refused(folder.path(), parts);
    };
    test::Enhanced enhanced;
    enhanced.whole = [](DcmDataset& dataset) {
      delete dataset.remove(DCM_SharedFunctionalGroupsSequence);
      delete dataset.remove(DCM_PerFrameFunctionalGroupsSequence);
    };
    enhanced.sop_class = UID_UltrasoundMultiframeImageStorage;
    refused(enhanced, {"UltrasoundMultiframeImageStorage, 3 frames", "PerFrameFunctionalGroupsSequence"});
    enhanced = {};
    enhanced.frame = [](DcmItem& groups, std::size_t frame) {
      if (frame == 1) delete groups.remove(DCM_PlanePositionSequence);
    };
    refused(enhanced, {"image.dcm: frame 2: PlanePositionSequence (0020,9113) is missing"});
    enhanced.frame = [](DcmItem& groups, std::size_t frame) {
      DcmItem& position = test::group(groups, DCM_PlanePositionSequence);
      if (frame == 2) position.putAndInsertString(DCM_ImagePositionPatient, "1\\2");
    };
    refused(enhanced, {"frame 3: ImagePositionPatient (0020,0032) is '1\\2'"});
    enhanced = {};
    enhanced.whole = [](DcmDataset& dataset) {
      DcmSequenceOfItems* frames = nullptr;
      dataset.findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, frames);
      delete frames->remove(0UL);
    };
    refused(enhanced, {"PerFrameFunctionalGroupsSequence (5200,9230) has 2 items for 3 frames"});
    enhanced = {};
    enhanced.sop_class = UID_SegmentationStorage;
    refused(enhanced, {"is a DICOM segmentation"});
    enhanced.sop_class = UID_ParametricMapStorage;
    refused(enhanced, {"parametric map"});
  }
};

TIDEMARK_TEST(DicomFramesTest)

}  // namespace tidemark::test::dicom_frames_test

#include "dicom_frames_test.moc"
