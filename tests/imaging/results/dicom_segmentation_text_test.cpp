// Text of DICOM Segmentations: names, codes, UIDs, and the loss of the source.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QJsonArray>
#include <array>
#include <set>

#include "imaging/dicom/element_text.h"
#include "tests/imaging/dicom/recode.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/results/sample_results.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::dicom_segmentation_text_test {

class DicomSegmentationTextTest : public QObject {
  Q_OBJECT

  static test::SampleSeries write_small_series(const test::TemporaryFolder& folder) {
    return test::write_sample_series(test::sample_grid({11, 7, 6}, glm::dmat3(1.0)), folder / "series");
  }

 private slots:
  void every_meaning_is_in_the_tables_of_the_standard() {
    const test::TemporaryFolder folder;
    const Geometry grid = test::sample_grid({3, 3, 2}, glm::dmat3(1.0));
    imaging::Segments segments{grid, {}, {}};
    for (const imaging::NamedMeaning& named : imaging::segment_meanings()) {
      imaging::Segment segment = test::ball_segment(grid, 2.0);
      segment.name = named.word;
      segment.meaning = named.meaning;
      segments.list.push_back(std::move(segment));
    }
    QCOMPARE(test::failure(imaging::write_segmentation(segments, {}, folder / "seg.dcm")), QString());
    const QJsonObject found = test::read_with_pydicom(folder / "seg.dcm", folder / "nowhere");
    for (const auto& segment : found["segments"].toArray()) {
      QVERIFY2(segment.toObject()["known"].toBool(), qPrintable(segment.toObject()["name"].toString()));
    }
    QCOMPARE(imaging::find_segment_meaning("no such thing").error().kind, ErrorKind::usage);
  }

  void a_volume_that_was_not_dicom_gets_an_anonymous_study() {
    const test::TemporaryFolder folder;
    Geometry left_handed = test::sample_grid({11, 7, 6}, test::orientations().back().direction);
    left_handed.direction[2] = -left_handed.direction[2];
    const imaging::Segments written = test::speckled_segments(left_handed);
    QCOMPARE(test::failure(imaging::write_segmentation(written, {}, folder / "seg.dcm")), QString());
    const QJsonObject found = test::read_with_pydicom(folder / "seg.dcm", folder / "nowhere");
    QCOMPARE(found["patient"].toString(), QString("Anonymous"));
    const auto read = imaging::read_segmentation(folder / "seg.dcm", &left_handed);
    QCOMPARE(test::failure(read), QString());
    test::verify_same(*read, written);
  }

  // As files are that were stripped of more than names.
  void a_source_without_uids_gets_new_ones() {
    const test::TemporaryFolder folder;
    const auto series = write_small_series(folder);
    for (const auto& file : series.files) {
      test::edit(file, [](DcmDataset& dataset) {
        for (const DcmTagKey& key :
             {DCM_StudyInstanceUID, DCM_SOPInstanceUID, DCM_FrameOfReferenceUID, DCM_PatientID}) {
          delete dataset.remove(key);
        }
      });
    }
    const imaging::Segments written = test::speckled_segments(series.geometry);
    for (const auto& [write, name] :
         {std::pair{&imaging::write_segmentation, "seg.dcm"}, {&imaging::write_structure_set, "set.dcm"}}) {
      QCOMPARE(test::failure(write(written, series.files, folder / name, {})), QString());
      const auto read = imaging::read_result(folder / name, &series.geometry);
      QCOMPARE(test::failure(read), QString());
      for (std::size_t n = 0; n < 3; ++n) QVERIFY(read->list[n].slices == written.list[n].slices);
    }
  }

  void the_patients_name_keeps_its_script_data() { test::add_script_rows(); }

  void the_patients_name_keeps_its_script() {
    QFETCH(QByteArray, character_set);
    QFETCH(QByteArray, bytes);
    QFETCH(QByteArray, name);
    const test::TemporaryFolder folder;
    const auto series = write_small_series(folder);
    for (const auto& file : series.files) {
      test::set_text(file, 0x0008, 0x0005, character_set);
      test::set_text(file, 0x0010, 0x0010, bytes);
    }
    const imaging::Segments segments = test::speckled_segments(series.geometry);
    for (const auto& write : {&imaging::write_segmentation, &imaging::write_structure_set}) {
      QCOMPARE(test::failure(write(segments, series.files, folder / "result.dcm", {})), QString());
      test::edit(folder / "result.dcm", [&](DcmDataset& dataset) {
        QCOMPARE(imaging::element_text(dataset, DCM_SpecificCharacterSet), std::string("ISO_IR 192"));
        QCOMPARE(QByteArray::fromStdString(imaging::element_text(dataset, DCM_PatientName)), name);
      });
    }
  }

  void a_segments_name_is_read_in_its_own_script_data() { test::add_script_rows(); }

  void a_segments_name_is_read_in_its_own_script() {
    QFETCH(QByteArray, character_set);
    QFETCH(QByteArray, bytes);
    QFETCH(QByteArray, name);
    const test::TemporaryFolder folder;
    const auto file = folder / "seg.dcm";
    const Geometry grid = test::sample_grid({11, 7, 6}, glm::dmat3(1.0));
    test::write_speckled_segmentation(file, grid);
    for (const bool has_item_its_own : {false, true}) {
      test::edit(file, [&](DcmDataset& dataset) {
        DcmItem* segment = nullptr;
        QVERIFY(dataset.findAndGetSequenceItem(DCM_SegmentSequence, segment).good());
        DcmItem& named = has_item_its_own ? *segment : dataset;
        dataset.putAndInsertString(DCM_SpecificCharacterSet, "ISO_IR 144");
        named.putAndInsertString(DCM_SpecificCharacterSet, character_set.constData());
        segment->putAndInsertString(DCM_SegmentLabel, bytes.constData());
      });
      const auto read = imaging::read_segmentation(file, &grid);
      QCOMPARE(test::failure(read), QString());
      QCOMPARE(QByteArray::fromStdString(read->list[0].name), name);
    }
  }

  void the_loss_of_the_source_is_said_data() {
    QTest::addColumn<QList<QByteArray>>("of_source");
    QTest::addColumn<QList<QByteArray>>("of_result");
    const auto row = [](const char* title, const QList<QByteArray>& of_source,
                        const QList<QByteArray>& of_result) {
      QTest::newRow(title) << of_source << of_result;
    };
    row("none", {}, {"00", "", ""});
    row("once", {"01", "12.5", "ISO_10918_1"}, {"01", "12.5", "ISO_10918_1"});
    row("twice", {"01", "12.5\\3", "ISO_10918_1\\ISO_15444_1"},
        {"01", "12.5\\3", "ISO_10918_1\\ISO_15444_1"});
    row("by what is not known", {"01"}, {"01", "", ""});
  }

  void the_loss_of_the_source_is_said() {
    QFETCH(QList<QByteArray>, of_source);
    QFETCH(QList<QByteArray>, of_result);
    const test::TemporaryFolder folder;
    const auto series = write_small_series(folder);
    const std::array elements{0x2110U, 0x2112U, 0x2114U};
    for (std::size_t n = 0; n < static_cast<std::size_t>(of_source.size()); ++n)
      test::set_text(series.files[2], 0x0028, elements[n], of_source[static_cast<qsizetype>(n)]);
    const auto file = folder / "seg.dcm";
    test::write_speckled_segmentation(file, series.geometry, series.files);
    test::edit(file, [&](DcmDataset& dataset) {
      const std::array keys{DCM_LossyImageCompression, DCM_LossyImageCompressionRatio,
                            DCM_LossyImageCompressionMethod};
      for (std::size_t n = 0; n < keys.size(); ++n) {
        QCOMPARE(QByteArray::fromStdString(imaging::element_text(dataset, keys[n])),
                 of_result[static_cast<qsizetype>(n)]);
      }
    });
    const QString said = test::validate(file);
    QVERIFY2(of_source.size() == 1 || !said.contains("Error"), qPrintable(said));
  }

  void a_loss_that_the_source_does_not_tell_is_that_of_its_pixels() {
    const test::TemporaryFolder folder;
    const auto series =
        test::write_sample_series(test::sample_grid({64, 64, 3}, glm::dmat3(1.0)), folder / "series");
    for (const auto& path : series.files) QVERIFY(test::recode(path, EXS_JPEG2000, true));
    const auto file = folder / "seg.dcm";
    test::write_speckled_segmentation(file, series.geometry, series.files);
    test::edit(file, [&](DcmDataset& dataset) {
      QCOMPARE(imaging::element_text(dataset, DCM_LossyImageCompression), std::string("01"));
      QCOMPARE(imaging::element_text(dataset, DCM_LossyImageCompressionMethod), std::string("ISO_15444_1"));
      const double ratio = std::stod(imaging::element_text(dataset, DCM_LossyImageCompressionRatio));
      const auto pixels = 2.0 * 64.0 * 64.0;  // bytes
      const auto stored = static_cast<double>(std::filesystem::file_size(series.files.front()));
      QVERIFY(ratio > pixels / stored && ratio < pixels);
    });
  }

  void new_uids_are_of_the_root_2_25() {
    const test::TemporaryFolder folder;
    const auto series =
        test::write_sample_series(test::sample_grid({5, 4, 3}, glm::dmat3(1.0)), folder / "series");
    const auto file = folder / "seg.dcm";
    std::set<std::string> sops;
    for (int time = 0; time < 2; ++time) {
      test::write_speckled_segmentation(file, series.geometry, series.files);
      test::edit(file, [&](DcmDataset& dataset) {
        for (const DcmTagKey& key :
             {DCM_SOPInstanceUID, DCM_SeriesInstanceUID, DCM_DimensionOrganizationUID}) {
          OFString uid;
          dataset.findAndGetOFString(key, uid, 0, key == DCM_DimensionOrganizationUID);
          QVERIFY2(uid.compare(0, 5, "2.25.") == 0, uid.c_str());
          sops.insert(uid.c_str());
        }
      });
    }
    QCOMPARE(sops.size(), std::size_t{6});
  }

  void another_frame_of_reference_than_the_studys_is_remarked() {
    const test::TemporaryFolder folder;
    const auto file = folder / "seg.dcm";
    const auto series = write_small_series(folder);
    const std::string study = test::only_series(series.folder).frame_of_reference_uid;
    QVERIFY(!study.empty());
    test::write_speckled_segmentation(file, series.geometry, series.files);
    const auto read = imaging::read_segmentation(file, &series.geometry);
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(read->frames_of_reference, std::vector<std::string>{study});
    QVERIFY(!imaging::frame_remark(read->frames_of_reference, study));
    QVERIFY(!imaging::frame_remark(read->frames_of_reference, {}));  // the study's is not known
    const auto remark = imaging::frame_remark(read->frames_of_reference, "1.2.3");
    QVERIFY(remark && remark->find("another frame of reference than the study") != std::string::npos);
    const auto mask = imaging::load_any_mask(file, &series.geometry);
    QCOMPARE(test::failure(mask), QString());
    QVERIFY(mask->frames_of_reference == read->frames_of_reference);

    test::set_text(file, 0x0020, 0x0052, "");
    const auto silent = imaging::read_segmentation(file, &series.geometry);
    QCOMPARE(test::failure(silent), QString());
    QVERIFY(!imaging::frame_remark(silent->frames_of_reference, study));
  }
};

TIDEMARK_TEST(DicomSegmentationTextTest)

}  // namespace tidemark::test::dicom_segmentation_text_test

#include "dicom_segmentation_text_test.moc"
