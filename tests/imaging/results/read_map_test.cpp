// Maps from DICOM: parametric maps and fractional segmentations.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <cmath>

#include "imaging/dicom/dicom.h"
#include "tests/imaging/dicom/recode.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/results/sample_results.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::read_map_test {

namespace {

// Of every voxel another value, from 0 to 1.
double value_at(Index3 voxel) {
  return static_cast<double>((31 * voxel.x + 17 * voxel.y + 7 * voxel.z) % 101) / 100.0;
}

imaging::Segment filled_segment(const Geometry& grid) {
  imaging::Segment segment;
  for (std::int64_t k = 0; k < grid.size.z; ++k)
    segment.slices[k] = std::vector<std::uint8_t>(static_cast<std::size_t>(grid.size.x * grid.size.y), 1);
  return segment;
}

// Frames of 8 bits, in the order of their places: every voxel's value times `most`.
void write_fractions(const std::filesystem::path& file, const Geometry& grid, int most,
                     E_TransferSyntax syntax = EXS_LittleEndianExplicit) {
  QCOMPARE(test::failure(imaging::write_segmentation({grid, {filled_segment(grid)}, {}}, {}, file)),
           QString());
  test::edit(file, [&](DcmDataset& dataset) {
    dataset.putAndInsertString(DCM_SegmentationType, "FRACTIONAL");
    dataset.putAndInsertString(DCM_SegmentationFractionalType, "PROBABILITY");
    dataset.putAndInsertUint16(DCM_MaximumFractionalValue, static_cast<Uint16>(most));
    dataset.putAndInsertUint16(DCM_BitsAllocated, 8);
    dataset.putAndInsertUint16(DCM_BitsStored, 8);
    dataset.putAndInsertUint16(DCM_HighBit, 7);
    std::vector<Uint8> pixels;
    for (std::int64_t n = 0; n < grid.voxel_count(); ++n) {
      const Index3 voxel = grid.voxel_at(n);
      pixels.push_back(static_cast<Uint8>(std::lround(most * value_at(voxel))));
    }
    const auto count = static_cast<unsigned long>(pixels.size());
    QVERIFY(dataset.putAndInsertUint8Array(DcmTag(DCM_PixelData, EVR_OB), pixels.data(), count).good());
  });
  if (syntax != EXS_LittleEndianExplicit) QVERIFY(test::recode(file, syntax, false));
}

enum class Pixels { floats, doubles, words };

// A segmentation with the class and the pixels of a parametric map: its frames lie as that says.
void write_parametric_map(const std::filesystem::path& file, const Geometry& grid, Pixels kind) {
  write_fractions(file, grid, 100);
  test::edit(file, [&](DcmDataset& dataset) {
    dataset.putAndInsertString(DCM_SOPClassUID, UID_ParametricMapStorage);
    dataset.putAndInsertString(DCM_Modality, "MR");
    dataset.findAndDeleteElement(DCM_SegmentSequence);
    dataset.findAndDeleteElement(DCM_SegmentationType);
    dataset.findAndDeleteElement(DCM_PixelData);
    DcmItem* mapping = nullptr;
    QVERIFY(dataset.findOrCreateSequenceItem(DCM_SharedFunctionalGroupsSequence, mapping, 0).good());
    DcmItem* values = nullptr;
    QVERIFY(mapping->findOrCreateSequenceItem(DCM_RealWorldValueMappingSequence, values, 0).good());
    // value = 2 stored - 1
    values->putAndInsertFloat64(DCM_RealWorldValueSlope, kind == Pixels::words ? 0.002 : 2.0);
    values->putAndInsertFloat64(DCM_RealWorldValueIntercept, -1.0);
    std::vector<Float32> floats;
    std::vector<Float64> doubles;
    std::vector<Uint16> words;
    for (std::int64_t n = 0; n < grid.voxel_count(); ++n) {
      const Index3 voxel = grid.voxel_at(n);
      floats.push_back(static_cast<Float32>(value_at(voxel)));
      doubles.push_back(value_at(voxel));
      words.push_back(static_cast<Uint16>(std::lround(1000.0 * value_at(voxel))));
    }
    const auto count = static_cast<unsigned long>(floats.size());
    const Uint16 bits = kind == Pixels::floats ? 32 : kind == Pixels::doubles ? 64 : 16;
    dataset.putAndInsertUint16(DCM_BitsAllocated, bits);
    if (kind == Pixels::floats)
      QVERIFY(dataset.putAndInsertFloat32Array(DCM_FloatPixelData, floats.data(), count).good());
    if (kind == Pixels::doubles)
      QVERIFY(dataset.putAndInsertFloat64Array(DCM_DoubleFloatPixelData, doubles.data(), count).good());
    if (kind == Pixels::words)
      QVERIFY(dataset.putAndInsertUint16Array(DcmTag(DCM_PixelData, EVR_OW), words.data(), count).good());
  });
}

void verify_values(const Volume& read, const Geometry& grid, double slope, double intercept,
                   double tolerance) {
  QVERIFY(same_grid(read.geometry, grid, 1e-4));
  for (std::int64_t n = 0; n < grid.voxel_count(); ++n) {
    const Index3 voxel = grid.voxel_at(n);
    const double wanted = slope * value_at(voxel) + intercept;
    QVERIFY2(std::abs(static_cast<double>(read.value(n)) - wanted) <= tolerance,
             qPrintable(QString("%1: %2, not %3").arg(n).arg(read.value(n)).arg(wanted)));
  }
}

}  // namespace

class ReadMapTest : public QObject {
  Q_OBJECT

  Geometry grid_ = test::sample_grid({11, 7, 6}, glm::dmat3(1.0));

 private slots:
  void fractions_are_read_in_every_orientation_data() { test::add_orientation_rows(); }
  void fractions_are_read_in_every_orientation() {
    QFETCH(int, index);
    const test::TemporaryFolder folder;
    const Geometry grid = test::write_oriented_series(index, {11, 7, 6}, folder / "series").geometry;
    write_fractions(folder / "seg.dcm", grid, 200);
    QVERIFY(imaging::holds_map(folder / "seg.dcm"));
    const auto read = imaging::read_map(folder / "seg.dcm");
    QCOMPARE(test::failure(read), QString());
    verify_values(read->volume, grid, 1.0, 0.0, 0.5 / 200.0 + 1e-6);
  }

  void compressed_fractions_are_read() {
    test::register_encoders();
    const test::TemporaryFolder folder;
    write_fractions(folder / "seg.dcm", grid_, 255, EXS_RLELossless);
    const auto read = imaging::read_map(folder / "seg.dcm");
    QCOMPARE(test::failure(read), QString());
    verify_values(read->volume, grid_, 1.0, 0.0, 0.5 / 255.0 + 1e-6);
  }

  void of_several_segments_the_largest_counts() {
    const test::TemporaryFolder folder;
    const imaging::Segments segments = test::speckled_segments(grid_);
    QCOMPARE(test::failure(imaging::write_segmentation(segments, {}, folder / "seg.dcm")), QString());
    const auto read = imaging::read_map(folder / "seg.dcm");
    QCOMPARE(test::failure(read), QString());
    const Mask mask = imaging::union_of(segments);
    QVERIFY(same_grid(read->volume.geometry, mask.geometry, 1e-4));
    for (std::size_t n = 0; n < mask.voxels.size(); ++n)
      QCOMPARE(read->volume.value(static_cast<std::int64_t>(n)), mask.voxels[n] == 0 ? 0.0F : 1.0F);
  }

  void what_no_frame_covers_is_told_with_the_frame_of_reference_data() {
    QTest::addColumn<bool>("is_parametric");
    QTest::newRow("segmentation") << false;
    QTest::newRow("parametric map") << true;
  }
  void what_no_frame_covers_is_told_with_the_frame_of_reference() {
    QFETCH(bool, is_parametric);
    const test::TemporaryFolder folder;
    const auto file = folder / "map.dcm";
    imaging::Segment segment = filled_segment(grid_);
    segment.slices.erase(1);
    QCOMPARE(test::failure(imaging::write_segmentation({grid_, {segment}, {}}, {}, file)), QString());
    test::set_text(file, 0x0020, 0x0052, "1.2.3");
    const auto frames = static_cast<std::size_t>(grid_.size.z - 1);
    if (is_parametric) {
      test::make_parametric_map(
          file, std::vector<std::int16_t>(frames * static_cast<std::size_t>(grid_.size.x * grid_.size.y), 3),
          0.25, 0.0);
    }
    const auto read = imaging::read_map(file);
    QCOMPARE(test::failure(read), QString());
    QCOMPARE(read->frame_of_reference_uid, std::string("1.2.3"));
    QVERIFY(same_grid(read->volume.geometry, grid_, 1e-4));
    for (std::int64_t n = 0; n < grid_.voxel_count(); ++n) {
      const bool covered = grid_.voxel_at(n).z != 1;
      QCOMPARE(read->covered[static_cast<std::size_t>(n)], covered);
      QCOMPARE(read->volume.value(n), covered ? (is_parametric ? 0.75F : 1.0F) : 0.0F);
    }
  }

  void parametric_maps_are_read_data() {
    QTest::addColumn<int>("kind");
    QTest::newRow("float") << static_cast<int>(Pixels::floats);
    QTest::newRow("double") << static_cast<int>(Pixels::doubles);
    QTest::newRow("words") << static_cast<int>(Pixels::words);
  }
  void parametric_maps_are_read() {
    QFETCH(int, kind);
    const test::TemporaryFolder folder;
    write_parametric_map(folder / "map.dcm", grid_, static_cast<Pixels>(kind));
    QVERIFY(imaging::holds_map(folder / "map.dcm"));
    const auto read = imaging::read_map(folder / "map.dcm");
    QCOMPARE(test::failure(read), QString());
    verify_values(read->volume, grid_, 2.0, -1.0, 1e-6);
  }

  void images_hold_no_map() {
    const test::TemporaryFolder folder;
    const auto series = test::write_sample_series(grid_, folder / "series");
    QVERIFY(!imaging::holds_map(series.files.front()));
    QVERIFY(!imaging::holds_map(folder / "nothing.dcm"));
  }

  void damaged_maps_are_one_line_data() {
    QTest::addColumn<int>("damage");
    QTest::addColumn<QString>("says");
    QTest::newRow("pixels end early") << 0 << "its pixels end early: 10 of 462";
    QTest::newRow("no pixels") << 1 << "has neither float nor uncompressed pixels";
    QTest::newRow("no size") << 2 << "Rows (0028,0010) or Columns (0028,0011) are missing";
    QTest::newRow("no frames") << 3 << "PerFrameFunctionalGroupsSequence (5200,9230) is missing";
    QTest::newRow("frames at one place") << 4 << "several of its frames lie at one place";
    QTest::newRow("frames far apart") << 5 << "its frames";
  }
  void damaged_maps_are_one_line() {
    QFETCH(int, damage);
    QFETCH(QString, says);
    const test::TemporaryFolder folder;
    const auto file = folder / "map.dcm";
    write_parametric_map(file, grid_, Pixels::floats);
    test::edit(file, [&](DcmDataset& dataset) {
      const std::vector<Float32> few(10);
      const auto move_first = [&](const char* to) {
        DcmItem* frame = nullptr;
        DcmItem* place = nullptr;
        QVERIFY(dataset.findAndGetSequenceItem(DCM_PerFrameFunctionalGroupsSequence, frame, 0).good());
        QVERIFY(frame->findAndGetSequenceItem(DCM_PlanePositionSequence, place).good());
        place->putAndInsertString(DCM_ImagePositionPatient, to);
      };
      if (damage == 0) dataset.putAndInsertFloat32Array(DCM_FloatPixelData, few.data(), 10);
      if (damage == 1) dataset.findAndDeleteElement(DCM_FloatPixelData);
      if (damage == 2) dataset.findAndDeleteElement(DCM_Rows);
      if (damage == 3) dataset.findAndDeleteElement(DCM_PerFrameFunctionalGroupsSequence);
      if (damage == 4) {
        DcmItem* frame = nullptr;
        DcmItem* place = nullptr;
        OFString second;
        QVERIFY(dataset.findAndGetSequenceItem(DCM_PerFrameFunctionalGroupsSequence, frame, 1).good());
        QVERIFY(frame->findAndGetSequenceItem(DCM_PlanePositionSequence, place).good());
        QVERIFY(place->findAndGetOFStringArray(DCM_ImagePositionPatient, second).good());
        move_first(second.c_str());
      }
      if (damage == 5) move_first("0\\0\\-90000");
    });
    const auto read = imaging::read_map(file);
    QVERIFY(!read);
    QCOMPARE(read.error().kind, ErrorKind::input);
    QVERIFY2(test::failure(read).contains("map.dcm: ") && test::failure(read).contains(says),
             qPrintable(test::failure(read)));
  }
};

TIDEMARK_TEST(ReadMapTest)

}  // namespace tidemark::test::read_map_test

#include "read_map_test.moc"
