// Frames and voxels of DICOM Segmentations: out, in again, and as others see them.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <QJsonArray>
#include <glm/geometric.hpp>

#include "imaging/dicom/dicom.h"
#include "imaging/dicom/dicom_values.h"
#include "imaging/results/segment_frames.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/results/sample_results.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::dicom_segmentation_test {

class DicomSegmentationTest : public QObject {
  Q_OBJECT

 private slots:
  void what_is_written_is_read_back_in_every_orientation_data() { test::add_orientation_rows(); }

  void what_is_written_is_read_back_in_every_orientation() {
    QFETCH(int, index);
    const test::TemporaryFolder folder;
    // 77 pixels a frame: frames do not end at whole bytes.
    const auto series = test::write_oriented_series(index, {11, 7, 6}, folder / "series");
    const imaging::Segments written = test::speckled_segments(series.geometry);
    const auto file = folder / "seg.dcm";
    QCOMPARE(test::failure(imaging::write_segmentation(written, series.files, file)), QString());
    QVERIFY(imaging::result_form_of(file) == imaging::ResultForm::segmentation);
    const auto found = imaging::scan_dicom(file);
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.front().reason,
             std::string("seg.dcm: is a DICOM segmentation, which can be imported as labels"));
    const auto read = imaging::read_segmentation(file, &series.geometry);
    QCOMPARE(test::failure(read), QString());
    test::verify_same(*read, written);
    QCOMPARE(read->list[0].name, std::string("Leber \xc3\xbc"));
    QCOMPARE(read->list[2].name, std::string("a third, with backslash"));

    // Alone it is on the same voxels, as far as it reaches.
    const auto alone = imaging::read_segmentation(file);
    QCOMPARE(test::failure(alone), QString());
    QVERIFY(same_grid(alone->geometry, series.geometry, 1e-4));
    test::verify_same(*alone, written);
  }

  void pydicom_finds_the_same_voxels_in_every_orientation_data() {
    what_is_written_is_read_back_in_every_orientation_data();
  }

  void pydicom_finds_the_same_voxels_in_every_orientation() {
    QFETCH(int, index);
    const test::TemporaryFolder folder;
    const auto series = test::write_oriented_series(index, {11, 7, 6}, folder / "series");
    const imaging::Segments written = test::speckled_segments(series.geometry);
    QCOMPARE(test::failure(imaging::write_segmentation(written, series.files, folder / "seg.dcm")),
             QString());
    const QJsonObject found = test::read_with_pydicom(folder / "seg.dcm", series.folder);
    for (const char* what :
         {"same_patient", "same_study", "same_frame_of_reference", "own_series", "at_their_images"}) {
      QVERIFY2(found[what].toBool(), what);
    }
    const QJsonArray segments = found["segments"].toArray();
    QCOMPARE(segments.size(), 3);
    std::size_t frames = 0;
    for (std::size_t n = 0; n < 3; ++n) {
      const imaging::Segment& segment = written.list[n];
      const QJsonObject seen = segments[static_cast<qsizetype>(n)].toObject();
      frames += segment.slices.size();
      QVERIFY(seen["known"].toBool());
      QCOMPARE(seen["type"].toString().toStdString(), segment.meaning.type.meaning);
      for (int channel = 0; channel < 3; ++channel) {
        const int wanted = (*segment.colour)[static_cast<std::size_t>(channel)];
        QVERIFY(std::abs(seen["colour"].toArray()[channel].toInt() - wanted) <= 1);
      }
      const QJsonArray voxels = seen["voxels"].toArray();
      QCOMPARE(voxels.size(), segment.count());
      for (const auto& voxel : voxels) {
        const QJsonArray mm = voxel.toArray();
        const glm::dvec3 at =
            series.geometry.to_voxel({mm[0].toDouble(), mm[1].toDouble(), mm[2].toDouble()});
        const Index3 nearest(glm::round(at));
        QVERIFY(glm::distance(at, glm::dvec3(nearest)) < 1e-4);
        const auto slice = segment.slices.find(nearest.z);
        QVERIFY(slice != segment.slices.end());
        QCOMPARE(slice->second[static_cast<std::size_t>(nearest.x + 11 * nearest.y)], std::uint8_t{1});
      }
    }
    QCOMPARE(static_cast<std::size_t>(found["frames"].toInt()), frames);  // none is empty
  }

  void the_validator_finds_no_error() {
    const test::TemporaryFolder folder;
    const auto series =
        test::write_sample_series(test::sample_grid({11, 7, 6}, glm::dmat3(1.0)), folder / "series");
    const imaging::Segments segments = test::speckled_segments(series.geometry);
    for (const bool with_source : {true, false}) {
      const auto file = folder / "seg.dcm";
      const imaging::SourceFiles source =
          with_source ? imaging::SourceFiles(series.files) : imaging::SourceFiles();
      QCOMPARE(test::failure(imaging::write_segmentation(segments, source, file)), QString());
      const QString said = test::validate(file);
      QVERIFY2(said.contains("Segmentation"), qPrintable(said));
      QVERIFY2(!said.contains("Error"), qPrintable(said));
    }
  }

  void a_segmentation_lies_right_on_a_grid_with_other_axes() {
    const test::TemporaryFolder folder;
    const Geometry written_on = test::sample_grid({11, 7, 6}, glm::dmat3(1.0));
    const imaging::Segments written = test::speckled_segments(written_on);
    QCOMPARE(test::failure(imaging::write_segmentation(written, {}, folder / "seg.dcm")), QString());
    Geometry turned;  // the same voxels: k, then i backwards, then j
    turned.size = {6, 11, 7};
    turned.spacing_mm = {2.5, 0.7, 0.9};
    turned.direction = {glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0)};
    turned.origin_mm = written_on.to_patient({10, 0, 0});
    const auto read = imaging::read_segmentation(folder / "seg.dcm", &turned);
    QCOMPARE(test::failure(read), QString());
    const Mask before = imaging::union_of(written);
    const Mask after = imaging::union_of(*read);
    QCOMPARE(after.count(), before.count());
    for (std::int64_t k = 0; k < 6; ++k) {
      for (std::int64_t j = 0; j < 7; ++j) {
        for (std::int64_t i = 0; i < 11; ++i) {
          QCOMPARE(after.voxels[static_cast<std::size_t>(turned.offset({k, 10 - i, j}))],
                   before.voxels[static_cast<std::size_t>(written_on.offset({i, j, k}))]);
        }
      }
    }
  }

  void another_grid_is_refused_with_the_reason() {
    const test::TemporaryFolder folder;
    const Geometry grid = test::sample_grid({11, 7, 6}, glm::dmat3(1.0));
    test::write_speckled_segmentation(folder / "seg.dcm", grid);
    Geometry coarser = grid;
    coarser.spacing_mm *= 1.2;
    Geometry shifted = grid;
    shifted.origin_mm.x += 0.3;
    for (const Geometry& other : {coarser, shifted}) {
      const auto refused = imaging::read_segmentation(folder / "seg.dcm", &other);
      QVERIFY(!refused);
      QCOMPARE(refused.error().kind, ErrorKind::input);
      QVERIFY2(refused.error().message.find("do not lie on the voxels") != std::string::npos,
               refused.error().message.c_str());
    }
    Geometry shorter = grid;
    shorter.size.z = 2;
    const auto refused = imaging::read_segmentation(folder / "seg.dcm", &shorter);
    QVERIFY(!refused);
    QVERIFY2(refused.error().message.find("beyond the volume") != std::string::npos,
             refused.error().message.c_str());
  }

  void a_part_of_the_grid_is_enough() {
    const test::TemporaryFolder folder;
    const Geometry grid = test::sample_grid({11, 7, 6}, test::orientations().back().direction);
    Geometry part = grid;  // columns 2 to 8, rows 1 to 5, slices 3 and 4
    part.size = {7, 5, 2};
    part.origin_mm = grid.to_patient({2, 1, 3});
    const imaging::Segments written = test::speckled_segments(part);
    QCOMPARE(test::failure(imaging::write_segmentation(written, {}, folder / "seg.dcm")), QString());
    const auto read = imaging::read_segmentation(folder / "seg.dcm", &grid);
    QCOMPARE(test::failure(read), QString());
    for (std::size_t n = 0; n < 3; ++n) {
      QCOMPARE(read->list[n].count(), written.list[n].count());
      for (const auto& [k, slice] : written.list[n].slices) {
        for (std::size_t v = 0; v < slice.size(); ++v) {
          const std::size_t there = 2 + v % 7 + 11 * (1 + v / 7);
          QCOMPARE(read->list[n].slices.at(k + 3)[there], slice[v]);
        }
      }
    }
  }

  // As they do where an oblique orientation is rounded to three decimals.
  void results_may_lie_on_slices_that_drift_by_rounding() {
    const test::TemporaryFolder folder;
    Geometry grid = test::sample_grid({5, 4, 176}, test::orientations().back().direction);
    grid.spacing_mm = {0.5, 0.5, 1.0};
    const auto written = test::write_sample_series(grid, folder / "series");
    constexpr double kDrift = 6e-4;  // mm a slice
    test::tilt(written.files, grid, kDrift);
    const imaging::Series series = test::only_series(folder / "series");
    QVERIFY2(series.loadable, series.reason.c_str());
    QVERIFY(same_grid(series.geometry, grid, 1e-6));
    imaging::Segments segments{series.geometry, {imaging::Segment()}, {}};
    for (std::int64_t k = 0; k < grid.size.z; ++k)
      segments.list[0].slices[k] = std::vector<std::uint8_t>(20, 1);
    const auto file = folder / "seg.dcm";
    QCOMPARE(test::failure(imaging::write_segmentation(segments, series.files, file)), QString());

    // Another program's frames lie where the images do.
    test::edit(file, [&](DcmDataset& dataset) {
      DcmSequenceOfItems* frames = nullptr;
      QVERIFY(dataset.findAndGetSequence(DCM_PerFrameFunctionalGroupsSequence, frames).good());
      for (unsigned long k = 0; k < frames->card(); ++k) {
        DcmItem* plane = nullptr;
        QVERIFY(frames->getItem(k)->findAndGetSequenceItem(DCM_PlanePositionSequence, plane).good());
        const auto step = static_cast<double>(k);
        const glm::dvec3 p = grid.to_patient({0.0, 0.0, step}) + kDrift * step * grid.direction[1];
        plane->putAndInsertString(DCM_ImagePositionPatient, imaging::decimals(p.x, p.y, p.z).c_str());
      }
    });
    const auto read = imaging::read_segmentation(file, &series.geometry);
    QCOMPARE(test::failure(read), QString());
    QVERIFY(read->list[0].slices == segments.list[0].slices);

    imaging::SegmentFrame frame{1, 5, 4, {}, 0.5 * grid.direction[0], 0.5 * grid.direction[1]};
    frame.position_mm = grid.to_patient({0.0, 0.3, 175.0});
    QVERIFY(imaging::map_frame(frame, grid, "seg.dcm"));
    frame.position_mm = grid.to_patient({0.0, 0.3, 17.0});
    QVERIFY(!imaging::map_frame(frame, grid, "seg.dcm"));
    frame.position_mm = grid.to_patient({0.0, 0.4, 175.0});
    QVERIFY(!imaging::map_frame(frame, grid, "seg.dcm"));
  }

  void slices_far_apart_stay_where_they_are() {
    const test::TemporaryFolder folder;
    const Geometry grid = test::sample_grid({5, 4, 20}, glm::dmat3(1.0));
    imaging::Segments written{grid, {imaging::Segment()}, {}};
    for (const std::int64_t k : {3, 9, 18}) written.list[0].slices[k] = std::vector<std::uint8_t>(20, 1);
    QCOMPARE(test::failure(imaging::write_segmentation(written, {}, folder / "seg.dcm")), QString());
    const auto alone = imaging::read_segmentation(folder / "seg.dcm");
    QCOMPARE(test::failure(alone), QString());
    QCOMPARE(alone->geometry.size.z, std::int64_t{16});
    QCOMPARE(alone->geometry.spacing_mm.z, 2.5);
    QCOMPARE(alone->list[0].slices.size(), std::size_t{3});
    QVERIFY(alone->list[0].slices.contains(6));
    QCOMPARE(alone->list[0].name, std::string("Segment"));
  }

  void frames_too_far_apart_for_a_volume_of_their_own_are_refused() {
    const test::TemporaryFolder folder;
    const Geometry grid = test::sample_grid({300, 300, 3500}, glm::dmat3(1.0));
    imaging::Segments written{grid, {imaging::Segment()}, {}};
    for (const std::int64_t k : {0, 1, 3499})
      written.list[0].slices[k] = std::vector<std::uint8_t>(90'000, 1);
    QCOMPARE(test::failure(imaging::write_segmentation(written, {}, folder / "seg.dcm")), QString());
    const auto alone = imaging::read_segmentation(folder / "seg.dcm");
    QVERIFY(!alone);
    QCOMPARE(alone.error().kind, ErrorKind::input);
    QVERIFY2(alone.error().message.find("too large a volume: 3500 slices of 300 x 300") != std::string::npos,
             alone.error().message.c_str());
    const auto in_its_study = imaging::read_segmentation(folder / "seg.dcm", &grid);
    QCOMPARE(test::failure(in_its_study), QString());
    QVERIFY(in_its_study->list[0].slices == written.list[0].slices);
  }

  void frames_across_each_other_make_no_volume_of_their_own() {
    imaging::SegmentFrame axial{1, 5, 4};
    imaging::SegmentFrame sagittal = axial;
    sagittal.step_column_mm = {0.0, 1.0, 0.0};
    sagittal.step_row_mm = {0.0, 0.0, 1.0};
    QVERIFY(imaging::grid_of_frames({axial, axial}, {}, 1.0, "seg.dcm"));
    const auto refused = imaging::grid_of_frames({axial, sagittal}, {}, 1.0, "seg.dcm");
    QVERIFY(!refused);
    QCOMPARE(refused.error().message, std::string("seg.dcm: its frames are not parallel"));
  }

  void a_thickness_without_end_is_none() {
    const test::TemporaryFolder folder;
    const imaging::Segments written{test::sample_grid({5, 4, 1}, glm::dmat3(1.0)), {imaging::Segment()}, {}};
    QCOMPARE(test::failure(imaging::write_segmentation(written, {}, folder / "seg.dcm")), QString());
    test::edit(folder / "seg.dcm", [](DcmDataset& dataset) {
      DcmItem* shared = nullptr;
      DcmItem* measures = nullptr;
      QVERIFY(dataset.findAndGetSequenceItem(DCM_SharedFunctionalGroupsSequence, shared).good());
      QVERIFY(shared->findAndGetSequenceItem(DCM_PixelMeasuresSequence, measures).good());
      measures->putAndInsertString(DCM_SliceThickness, "1e400");
      measures->putAndInsertString(DCM_SpacingBetweenSlices, "1e400");
    });
    const auto read = imaging::read_segmentation(folder / "seg.dcm");
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(read->geometry.spacing_mm.z, 1.0);
  }

  void nothing_at_all_is_one_empty_frame() {
    const test::TemporaryFolder folder;
    const Geometry grid = test::sample_grid({5, 4, 3}, glm::dmat3(1.0));
    const imaging::Segments nothing{grid, {imaging::Segment()}, {}};
    QCOMPARE(test::failure(imaging::write_segmentation(nothing, {}, folder / "seg.dcm")), QString());
    const auto read = imaging::read_segmentation(folder / "seg.dcm", &grid);
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(read->list.size(), std::size_t{1});
    QVERIFY(read->list[0].slices.empty());
  }

  // As in files that leave out empty segments, or list them in another order.
  void frames_name_their_segment_by_its_number_data() {
    QTest::addColumn<QList<int>>("numbers");
    QTest::newRow("another order") << QList<int>{2, 3, 1};
    QTest::newRow("two swapped") << QList<int>{1, 3, 2};
    QTest::newRow("some left out") << QList<int>{1, 3, 65'535};
    QTest::newRow("all but one left out") << QList<int>{2};
  }

  void frames_name_their_segment_by_its_number() {
    QFETCH(QList<int>, numbers);
    const test::TemporaryFolder folder;
    const auto file = folder / "seg.dcm";
    const Geometry grid = test::sample_grid({11, 7, 6}, glm::dmat3(1.0));
    imaging::Segments written = test::speckled_segments(grid);
    written.list.resize(static_cast<std::size_t>(numbers.size()));
    QCOMPARE(test::failure(imaging::write_segmentation(written, {}, file)), QString());
    const auto in_order = imaging::read_segmentation(file, &grid);
    QCOMPARE(test::failure(in_order), QString());
    test::renumber_segments(file, {numbers.begin(), numbers.end()});
    const auto read = imaging::read_segmentation(file, &grid);
    QCOMPARE(test::failure(read), QString());
    test::verify_same(*read, written);
    for (std::size_t n = 0; n < written.list.size(); ++n) {
      QCOMPARE(read->list[n].name, in_order->list[n].name);
      QCOMPARE(int{read->list[n].number}, numbers[static_cast<qsizetype>(n)]);
    }
  }

  void a_segment_without_a_number_of_its_own_is_refused() {
    const test::TemporaryFolder folder;
    const auto file = folder / "seg.dcm";
    const Geometry grid = test::sample_grid({11, 7, 6}, glm::dmat3(1.0));
    const auto refusal = [&](const std::vector<std::uint16_t>& numbers) {
      if (!imaging::write_segmentation(test::speckled_segments(grid), {}, file))
        return QString("not written");
      test::renumber_segments(file, numbers);
      return test::failure(imaging::read_segmentation(file, &grid));
    };
    const QString none = refusal({1, 0, 2});
    QVERIFY2(none.contains("seg.dcm: SegmentNumber (0062,0004) of segment 2 is missing"), qPrintable(none));
    const QString twice = refusal({4, 7, 4});
    QVERIFY2(twice.contains("seg.dcm: SegmentNumber (0062,0004) of segment 3 is 4"), qPrintable(twice));
    QCOMPARE(refusal({1, 2, 3}), QString());
    test::edit(file, [](DcmDataset& dataset) {
      DcmItem* second = nullptr;
      QVERIFY(dataset.findAndGetSequenceItem(DCM_SegmentSequence, second, 1).good());
      second->putAndInsertUint16(DCM_SegmentNumber, 4);
    });
    const QString undescribed = test::failure(imaging::read_segmentation(file, &grid));
    QVERIFY2(undescribed.contains("belongs to a segment that is not described"), qPrintable(undescribed));
  }

  void damage_is_refused_by_name_data() {
    QTest::addColumn<QString>("field");
    QTest::addColumn<unsigned>("group");
    QTest::addColumn<unsigned>("element");
    QTest::addColumn<QString>("value");
    QTest::newRow("no type") << "SegmentationType" << 0x0062U << 0x0001U << "";
    QTest::newRow("a type of later years") << "SegmentationType" << 0x0062U << 0x0001U << "LABELMAP";
    QTest::newRow("no number of several frames")
        << "NumberOfFrames (0028,0008) is missing, and" << 0x0028U << 0x0008U << "";
    QTest::newRow("no frames") << "NumberOfFrames" << 0x0028U << 0x0008U << "0";
    QTest::newRow("too many frames") << "PixelData" << 0x0028U << 0x0008U << "2000000000";
    QTest::newRow("another class") << "no DICOM segmentation" << 0x0008U << 0x0016U << "1.2.3";
  }

  void damage_is_refused_by_name() {
    QFETCH(QString, field);
    QFETCH(unsigned, group);
    QFETCH(unsigned, element);
    QFETCH(QString, value);
    const test::TemporaryFolder folder;
    const auto file = folder / "seg.dcm";
    const Geometry grid = test::sample_grid({11, 7, 6}, glm::dmat3(1.0));
    test::write_speckled_segmentation(file, grid);
    test::set_text(file, group, element, value.toUtf8());
    const auto refused = imaging::read_segmentation(file, &grid);
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::input);
    QVERIFY2(refused.error().message.find(field.toStdString()) != std::string::npos,
             refused.error().message.c_str());
    QVERIFY2(refused.error().message.find("seg.dcm") != std::string::npos, refused.error().message.c_str());
  }

  void one_frame_needs_no_number_of_frames() {
    const test::TemporaryFolder folder;
    const auto file = folder / "seg.dcm";
    imaging::Segments written;
    written.geometry = test::sample_grid({11, 7, 6}, glm::dmat3(1.0));
    imaging::Segment& only = written.list.emplace_back();
    only.name = "One";
    only.slices[4].resize(77);
    only.slices[4][33] = 1;
    QCOMPARE(test::failure(imaging::write_segmentation(written, {}, file)), QString());
    test::set_text(file, 0x0028, 0x0008, "");
    const auto read = imaging::read_segmentation(file, &written.geometry);
    QCOMPARE(test::failure(read), QString());
    QVERIFY(read->list.front().slices == only.slices);
    QCOMPARE(read->changes.size(), std::size_t{1});
    QVERIFY(read->changes.front().starts_with("NumberOfFrames (0028,0008) is missing"));
  }

  void a_truncated_file_is_refused() {
    const test::TemporaryFolder folder;
    const auto file = folder / "seg.dcm";
    const Geometry grid = test::sample_grid({11, 7, 6}, glm::dmat3(1.0));
    test::write_speckled_segmentation(file, grid);
    const auto whole = std::filesystem::file_size(file);
    for (const double part : {0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.99}) {
      const auto cut = folder / "cut.dcm";
      std::filesystem::copy_file(file, cut, std::filesystem::copy_options::overwrite_existing);
      test::truncate(cut, static_cast<std::uintmax_t>(part * static_cast<double>(whole)));
      const auto refused = imaging::read_segmentation(cut, &grid);
      QVERIFY(!refused);
      QVERIFY2(refused.error().message.find("cut.dcm") != std::string::npos, refused.error().message.c_str());
    }
  }

  void a_sheared_grid_is_refused() {
    const test::TemporaryFolder folder;
    Geometry sheared = test::sample_grid({5, 4, 3}, glm::dmat3(1.0));
    sheared.direction[2] = glm::normalize(glm::dvec3(0.3, 0.0, 1.0));
    const auto refused =
        imaging::write_segmentation(test::speckled_segments(sheared), {}, folder / "seg.dcm");
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::capability);
    QVERIFY(!std::filesystem::exists(folder / "seg.dcm"));
  }
};

TIDEMARK_TEST(DicomSegmentationTest)

}  // namespace tidemark::test::dicom_segmentation_test

#include "dicom_segmentation_test.moc"
