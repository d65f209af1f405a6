// RT Structure Sets: out, in again, and as others see them.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <sys/resource.h>

#include <QJsonArray>
#include <cmath>

#include "imaging/dicom/dicom.h"
#include "imaging/results/contours.h"
#include "tests/imaging/dicom/dicom_bytes.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/results/sample_results.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::structure_set_test {

class StructureSetTest : public QObject {
  Q_OBJECT

  static double area_of(const QJsonObject& region) {
    double area = 0.0;
    for (const auto& contour : region["contours"].toArray()) area += contour.toObject()["area"].toDouble();
    return area;
  }

  // Changes the points of the first contour.
  static void set_first_contour(const std::filesystem::path& file, const char* type,
                                const std::string& points) {
    test::edit(file, [&](DcmDataset& dataset) {
      DcmItem* region = nullptr;
      DcmItem* contour = nullptr;
      QVERIFY(dataset.findAndGetSequenceItem(DCM_ROIContourSequence, region).good());
      QVERIFY(region->findAndGetSequenceItem(DCM_ContourSequence, contour).good());
      contour->putAndInsertString(DCM_ContourGeometricType, type);
      contour->putAndInsertString(DCM_ContourData, points.c_str());
    });
  }

 private slots:
  void what_is_written_is_read_back_in_every_orientation_data() { test::add_orientation_rows(); }

  void what_is_written_is_read_back_in_every_orientation() {
    QFETCH(int, index);
    const test::TemporaryFolder folder;
    const auto series = test::write_oriented_series(index, {21, 17, 6}, folder / "series");
    imaging::Segments written = test::speckled_segments(series.geometry);
    written.list.push_back(test::ball_segment(series.geometry, 6.0, 3.0));
    const auto file = folder / "set.dcm";
    QCOMPARE(test::failure(imaging::write_structure_set(written, series.files, file)), QString());
    QVERIFY(imaging::result_form_of(file) == imaging::ResultForm::structure_set);
    QCOMPARE(imaging::scan_dicom(file).error().message,
             file.string() + ": is a structure set, which can be imported as labels");
    const auto read = imaging::read_result(file, &series.geometry);
    QCOMPARE(test::failure(read), QString());
    QVERIFY(read->changes.empty());
    QCOMPARE(read->list.size(), written.list.size());
    for (std::size_t n = 0; n < written.list.size(); ++n) {
      QVERIFY2(read->list[n].slices == written.list[n].slices, written.list[n].name.c_str());
      QVERIFY(read->list[n].colour == written.list[n].colour.value_or(imaging::SegmentColour{255, 255, 0}));
    }
    QCOMPARE(read->list[0].name, std::string("Leber \xc3\xbc"));

    const QJsonObject found = test::read_with_pydicom(file, series.folder);
    for (const char* what :
         {"same_patient", "same_study", "same_frame_of_reference", "own_series", "at_their_images"}) {
      QVERIFY2(found[what].toBool(), what);
    }
    const QJsonArray regions = found["regions"].toArray();
    QCOMPARE(regions.size(), 4);
    QCOMPARE(regions[0].toObject()["name"].toString(), QString("Leber \u00fc"));
    QCOMPARE(regions[1].toObject()["colour"].toArray()[1].toInt(), 114);
  }

  void a_regions_name_is_read_in_its_own_script_data() { test::add_script_rows(); }

  void a_regions_name_is_read_in_its_own_script() {
    QFETCH(QByteArray, character_set);
    QFETCH(QByteArray, bytes);
    QFETCH(QByteArray, name);
    const test::TemporaryFolder folder;
    const auto file = folder / "set.dcm";
    const Geometry grid = test::sample_grid({21, 17, 6}, glm::dmat3(1.0));
    QCOMPARE(test::failure(imaging::write_structure_set(test::speckled_segments(grid), {}, file)), QString());
    test::edit(file, [&](DcmDataset& dataset) {
      DcmItem* region = nullptr;
      QVERIFY(dataset.findAndGetSequenceItem(DCM_StructureSetROISequence, region).good());
      dataset.putAndInsertString(DCM_SpecificCharacterSet, character_set.constData());
      region->putAndInsertString(DCM_ROIName, bytes.constData());
    });
    const auto read = imaging::read_structure_set(file, grid);
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(QByteArray::fromStdString(read->list[0].name), name);
  }

  void each_region_may_name_a_frame_of_reference() {
    const test::TemporaryFolder folder;
    const auto file = folder / "set.dcm";
    const auto series =
        test::write_sample_series(test::sample_grid({21, 17, 6}, glm::dmat3(1.0)), folder / "series");
    const std::string study = test::only_series(series.folder).frame_of_reference_uid;
    QVERIFY(!study.empty());
    QCOMPARE(test::failure(
                 imaging::write_structure_set(test::speckled_segments(series.geometry), series.files, file)),
             QString());
    const auto same = imaging::read_structure_set(file, series.geometry);
    QCOMPARE(test::failure(same), QString());
    QCOMPARE(same->frames_of_reference, std::vector<std::string>{study});
    QVERIFY(!imaging::frame_remark(same->frames_of_reference, study));

    test::edit(file, [](DcmDataset& dataset) {
      DcmItem* second = nullptr;
      QVERIFY(dataset.findAndGetSequenceItem(DCM_StructureSetROISequence, second, 1).good());
      second->putAndInsertString(DCM_ReferencedFrameOfReferenceUID, "1.2.3");
    });
    const auto mixed = imaging::read_structure_set(file, series.geometry);
    QCOMPARE(test::failure(mixed), QString());
    QCOMPARE(mixed->frames_of_reference.size(), std::size_t{2});
    QVERIFY(imaging::frame_remark(mixed->frames_of_reference, study));
  }

  void pydicom_finds_the_volume_of_a_ball() {
    const test::TemporaryFolder folder;
    Geometry geometry = test::sample_grid({60, 50, 22}, test::orientations().back().direction);
    const auto series = test::write_sample_series(geometry, folder / "series");
    for (const double hollow : {0.0, 8.0}) {
      imaging::Segments written{series.geometry, {test::ball_segment(series.geometry, 14.0, hollow)}, {}};
      QCOMPARE(test::failure(imaging::write_structure_set(written, series.files, folder / "set.dcm")),
               QString());
      const QJsonObject found = test::read_with_pydicom(folder / "set.dcm", series.folder);
      const QJsonObject region = found["regions"].toArray().first().toObject();
      const double volume = area_of(region) * series.geometry.spacing_mm.z;
      const double exact = 4.0 / 3.0 * M_PI * (std::pow(14.0, 3) - std::pow(hollow, 3));
      QVERIFY2(std::abs(volume / exact - 1.0) < 0.01, qPrintable(QString("%1 of %2").arg(volume).arg(exact)));
      for (const auto& contour : region["contours"].toArray()) {
        QCOMPARE(contour.toObject()["type"].toString(), QString("CLOSED_PLANAR"));
      }
    }
  }

  // Without phi: voxels less half a voxel a contour (contours_test says why).
  void pydicom_finds_the_area_of_a_mask() {
    const test::TemporaryFolder folder;
    const Geometry geometry = test::sample_grid({30, 20, 3}, glm::dmat3(1.0));
    imaging::Segment segment;
    segment.name = "box";
    std::vector<std::uint8_t> slice(600);
    for (std::size_t j = 4; j < 11; ++j)
      std::fill_n(slice.begin() + static_cast<std::ptrdiff_t>(30 * j + 5), 12, 1);
    segment.slices = {{0, slice}, {2, slice}};
    QCOMPARE(test::failure(imaging::write_structure_set({geometry, {segment}, {}}, {}, folder / "set.dcm")),
             QString());
    const QJsonObject found = test::read_with_pydicom(folder / "set.dcm", folder / "nowhere");
    QCOMPARE(found["patient"].toString(), QString("Anonymous"));
    const double area = area_of(found["regions"].toArray().first().toObject());
    QVERIFY(std::abs(area - 2.0 * (84.0 - 0.5) * 0.7 * 0.9) < 1e-3);
  }

  void the_validator_finds_no_error() {
    const test::TemporaryFolder folder;
    const auto series =
        test::write_sample_series(test::sample_grid({21, 17, 6}, glm::dmat3(1.0)), folder / "series");
    imaging::Segments segments = test::speckled_segments(series.geometry);
    segments.list.push_back(test::ball_segment(series.geometry, 6.0));
    segments.list.emplace_back().name = "empty";
    for (const bool with_source : {true, false}) {
      const auto file = folder / "set.dcm";
      const imaging::SourceFiles source =
          with_source ? imaging::SourceFiles(series.files) : imaging::SourceFiles();
      QCOMPARE(test::failure(imaging::write_structure_set(segments, source, file)), QString());
      const QString said = test::validate(file);
      QVERIFY2(said.contains("RTStructureSet"), qPrintable(said));
      QVERIFY2(!said.contains("Error"), qPrintable(said));
    }
  }

  // More than the 65534 bytes that the explicit form of a decimal string can hold.
  void a_contour_of_very_many_points_is_read_back() {
    const test::TemporaryFolder folder;
    const Geometry geometry = test::sample_grid({300, 300, 1}, glm::dmat3(1.0));
    imaging::Segment comb;
    std::vector<std::uint8_t> slice(90000);
    for (std::size_t v = 0; v < slice.size(); ++v) slice[v] = v / 300 == 0 || v % 300 % 2 == 0 ? 1 : 0;
    comb.slices[0] = slice;
    QCOMPARE(test::failure(imaging::write_structure_set({geometry, {comb}, {}}, {}, folder / "set.dcm")),
             QString());
    const auto read = imaging::read_structure_set(folder / "set.dcm", geometry);
    QCOMPARE(test::failure(read), QString());
    QVERIFY(read->list[0].slices == comb.slices);
    const QJsonObject found = test::read_with_pydicom(folder / "set.dcm", folder / "nowhere");
    QCOMPARE(found["regions"].toArray().first().toObject()["contours"].toArray().size(), 1);
  }

  void nested_contours_of_other_programs_are_holes() {
    const test::TemporaryFolder folder;
    const auto file = folder / "set.dcm";
    const Geometry geometry = test::sample_grid({30, 20, 2}, glm::dmat3(1.0));
    imaging::Segment two;
    std::vector<std::uint8_t> slice(600);
    slice[2 + 30 * 2] = slice[20 + 30 * 10] = 1;
    two.slices[1] = slice;
    QCOMPARE(test::failure(imaging::write_structure_set({geometry, {two}, {}}, {}, file)), QString());
    // The first becomes a square around the second.
    std::string square;
    for (const auto& [i, j] : {std::pair{17.5, 7.5}, {22.5, 7.5}, {22.5, 12.5}, {17.5, 12.5}}) {
      const glm::dvec3 mm = geometry.to_patient({i, j, 1.0});
      square += fmt::format("{}{:.3f}\\{:.3f}\\{:.3f}", square.empty() ? "" : "\\", mm.x, mm.y, mm.z);
    }
    set_first_contour(file, "CLOSED_PLANAR", square);
    const auto read = imaging::read_structure_set(file, geometry);
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(read->list[0].count(), std::int64_t{24});
  }

  void contours_beside_the_slices_are_refused() {
    const test::TemporaryFolder folder;
    const Geometry geometry = test::sample_grid({21, 17, 6}, glm::dmat3(1.0));
    const auto file = folder / "set.dcm";
    QCOMPARE(test::failure(
                 imaging::write_structure_set({geometry, {test::ball_segment(geometry, 6.0)}, {}}, {}, file)),
             QString());
    Geometry between = geometry;
    between.origin_mm.z += 1.25;
    const auto refused = imaging::read_structure_set(file, between);
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::input);
    QVERIFY2(refused.error().message.find("do not lie in the slices") != std::string::npos,
             refused.error().message.c_str());
  }

  void contours_beyond_the_volume_are_left_out_and_said() {
    const test::TemporaryFolder folder;
    const Geometry geometry = test::sample_grid({21, 17, 6}, glm::dmat3(1.0));
    const auto file = folder / "set.dcm";
    const imaging::Segment ball = test::ball_segment(geometry, 6.0);
    QCOMPARE(test::failure(imaging::write_structure_set({geometry, {ball}, {}}, {}, file)), QString());
    Geometry shorter = geometry;
    shorter.size = {10, 17, 3};
    const auto read = imaging::read_structure_set(file, shorter);
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(read->changes, std::vector<std::string>{"ball: what lies beyond the volume is left out"});
    QVERIFY(read->list[0].count() > 0 && read->list[0].count() < ball.count());
  }

  void contours_in_the_planes_of_another_axis_are_filled_there() {
    const test::TemporaryFolder folder;
    const Geometry written_on = test::sample_grid({21, 17, 6}, glm::dmat3(1.0));
    const imaging::Segment ball = test::ball_segment(written_on, 6.0, 3.0);
    QCOMPARE(test::failure(imaging::write_structure_set({written_on, {ball}, {}}, {}, folder / "set.dcm")),
             QString());
    Geometry turned;  // the same voxels: k, then i backwards, then j
    turned.size = {6, 21, 17};
    turned.spacing_mm = {2.5, 0.7, 0.9};
    turned.direction = {glm::dvec3(0, 0, 1), glm::dvec3(-1, 0, 0), glm::dvec3(0, 1, 0)};
    turned.origin_mm = written_on.to_patient({20, 0, 0});
    const auto read = imaging::read_structure_set(folder / "set.dcm", turned);
    QCOMPARE(test::failure(read), QString());
    const Mask after = imaging::union_of(*read);
    QCOMPARE(after.count(), ball.count());
    for (const auto& [k, slice] : ball.slices) {
      for (std::size_t v = 0; v < slice.size(); ++v) {
        const Index3 there(k, 20 - static_cast<std::int64_t>(v) % 21, static_cast<std::int64_t>(v) / 21);
        QCOMPARE(after.voxels[static_cast<std::size_t>(turned.offset(there))], slice[v]);
      }
    }
  }

  void points_and_open_lines_are_left_out_and_said() {
    const test::TemporaryFolder folder;
    const auto file = folder / "set.dcm";
    const Geometry geometry = test::sample_grid({21, 17, 6}, glm::dmat3(1.0));
    QCOMPARE(test::failure(
                 imaging::write_structure_set({geometry, {test::ball_segment(geometry, 6.0)}, {}}, {}, file)),
             QString());
    set_first_contour(file, "POINT", "1\\2\\3");
    const auto read = imaging::read_structure_set(file, geometry);
    QCOMPARE(test::failure(read), QString());
    QVERIFY2(read->changes.front().find("1 points and open contours") != std::string::npos,
             read->changes.front().c_str());
  }

  // Each a few bytes in the file; a parser's own copy of one would be kilobytes.
  void very_many_empty_contours_take_no_memory() {
    using namespace tidemark::test;
    const TemporaryFolder folder;
    std::string contours;
    for (int n = 0; n < 200'000; ++n) contours += item("", kImplicit);
    const std::string region = item(element(0x30060040, "SQ", contours, kImplicit), kImplicit);
    Dataset set(kImplicit);
    set.put_text(0x00080016, "UI", "1.2.840.10008.5.1.4.1.1.481.3").put_text(0x00080018, "UI", "2.25.1");
    set.put(0x30060039, element(0x30060039, "SQ", region, kImplicit));
    write_bytes(folder / "set.dcm", file(set));
    const auto peak_mib = [] {
      rusage usage{};
      getrusage(RUSAGE_SELF, &usage);
      return usage.ru_maxrss / 1024;
    };
    const long before = peak_mib();
    const auto read =
        imaging::read_structure_set(folder / "set.dcm", sample_grid({21, 17, 6}, glm::dmat3(1.0)));
    QCOMPARE(failure(read), QString());
    QVERIFY2(read->changes.front().find("200000 points and open contours") != std::string::npos,
             read->changes.front().c_str());
    QVERIFY2(peak_mib() - before < 80, qPrintable(QString::number(peak_mib() - before)));
  }

  void damage_is_refused_by_name_data() {
    QTest::addColumn<QString>("points");
    QTest::newRow("not numbers") << "1\\2\\three";
    QTest::newRow("not triples") << "1\\2\\3\\4";
    QTest::newRow("no finite number") << "1\\2\\1e400\\1\\3\\1\\1\\4\\1";
    QTest::newRow("no finite voxel") << "1.7e308\\2\\1\\1\\3\\1\\1\\4\\1";
    QTest::newRow("a far point") << "1e20\\2\\1\\1\\3\\1\\1\\4\\1";
  }

  void damage_is_refused_by_name() {
    QFETCH(QString, points);
    const test::TemporaryFolder folder;
    const auto file = folder / "set.dcm";
    const Geometry geometry = test::sample_grid({21, 17, 6}, glm::dmat3(1.0));
    QCOMPARE(test::failure(
                 imaging::write_structure_set({geometry, {test::ball_segment(geometry, 6.0)}, {}}, {}, file)),
             QString());
    set_first_contour(file, "CLOSED_PLANAR", points.toStdString());
    const auto refused = imaging::read_structure_set(file, geometry);
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::input);
    QVERIFY2(refused.error().message.find("set.dcm: ContourData") != std::string::npos,
             refused.error().message.c_str());
  }
};

TIDEMARK_TEST(StructureSetTest)

}  // namespace tidemark::test::structure_set_test

#include "structure_set_test.moc"
