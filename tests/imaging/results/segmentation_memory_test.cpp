// The memory that reading a DICOM Segmentation takes: what its file may claim, and what is decoded of it.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include "tests/imaging/dicom/recode.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/imaging/results/sample_results.h"
#include "tests/support/child_process.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::segmentation_memory_test {

namespace {

// Fractions of 8 bits. All frames but the first are empty.
void write_fractions(const std::filesystem::path& file, const Geometry& grid, E_TransferSyntax syntax) {
  imaging::Segments written{grid, {imaging::Segment()}, {}};
  const auto area = static_cast<std::size_t>(grid.size.x * grid.size.y);
  for (std::int64_t k = 0; k < grid.size.z; ++k) {
    written.list[0].slices[k].resize(area);
    written.list[0].slices[k].front() = 1;
  }
  QCOMPARE(test::failure(imaging::write_segmentation(written, {}, file)), QString());
  test::edit(file, [&](DcmDataset& dataset) {
    dataset.putAndInsertString(DCM_SegmentationType, "FRACTIONAL");
    dataset.putAndInsertString(DCM_SegmentationFractionalType, "OCCUPANCY");
    dataset.putAndInsertUint16(DCM_MaximumFractionalValue, 200);
    dataset.putAndInsertUint16(DCM_BitsAllocated, 8);
    dataset.putAndInsertUint16(DCM_BitsStored, 8);
    dataset.putAndInsertUint16(DCM_HighBit, 7);
    std::vector<Uint8> pixels(area * static_cast<std::size_t>(grid.size.z));
    pixels[1] = 99;
    pixels[2] = 100;
    pixels[area - 1] = 200;
    const auto count = static_cast<unsigned long>(pixels.size());
    QVERIFY(dataset.putAndInsertUint8Array(DcmTag(DCM_PixelData, EVR_OB), pixels.data(), count).good());
  });
  QVERIFY(test::recode(file, syntax, false));
}

}  // namespace

class SegmentationMemoryTest : public QObject {
  Q_OBJECT

 private slots:
  void the_file_and_64_mib_are_enough_data() {
    QTest::addColumn<int>("syntax");
    QTest::newRow("native") << static_cast<int>(EXS_LittleEndianExplicit);
    QTest::newRow("RLE") << static_cast<int>(EXS_RLELossless);
    QTest::newRow("JPEG-LS") << static_cast<int>(EXS_JPEGLSLossless);
  }

  void the_file_and_64_mib_are_enough() {
    QFETCH(int, syntax);
    test::register_encoders();
    const test::TemporaryFolder folder;
    const auto file = folder / "seg.dcm";
    const Geometry grid = test::sample_grid({512, 512, 400}, glm::dmat3(1.0));  // 100 MiB of pixels
    // In a process of its own: memory that writing takes and gives back would not count below.
    test::run_in_child([&]() -> Status {
      write_fractions(file, grid, static_cast<E_TransferSyntax>(syntax));
      return {};
    });
    QVERIFY(std::filesystem::exists(file));
    const auto bytes = static_cast<std::int64_t>(std::filesystem::file_size(file));
    QCOMPARE(bytes < 4 << 20, syntax != EXS_LittleEndianExplicit);
    const auto read_it = [&]() -> Status {
      const auto read = imaging::read_segmentation(file, &grid);
      if (!read) return pass_on(read);
      std::vector<std::uint8_t> first(512 * 512);
      first[2] = first.back() = 1;
      const auto& slices = read->list.at(0).slices;
      const bool is_same = slices.size() == 1 && slices.contains(0) && slices.at(0) == first;
      return is_same ? Status() : fail(ErrorKind::input, "other voxels");
    };
    const auto ended = test::run_in_child(read_it, {.more_memory = bytes + (std::int64_t{64} << 20)});
    QCOMPARE(QString::fromStdString(ended.failure), QString());
  }

  void small_frames_make_no_slices_without_end() {
    const test::TemporaryFolder folder;
    const auto file = folder / "seg.dcm";
    const Geometry grid = test::sample_grid({11, 7, 6}, glm::dmat3(1.0));
    QCOMPARE(test::failure(imaging::write_segmentation(test::speckled_segments(grid), {}, file)), QString());
    Geometry large = grid;
    large.size.x = large.size.y = 100'000;
    const auto ended = test::run_in_child(
        [&]() -> Status {
          const auto read = imaging::read_segmentation(file, &large);
          return read ? Status() : pass_on(read);
        },
        {.more_memory = std::int64_t{64} << 20});
    const QString why = QString::fromStdString(ended.failure);
    QVERIFY2(why.contains("seg.dcm: the slices of its segments take more than 4 GiB"), qPrintable(why));
  }

  void segments_without_end_are_refused() {
    const test::TemporaryFolder folder;
    const auto file = folder / "seg.dcm";
    const Geometry grid = test::sample_grid({11, 7, 6}, glm::dmat3(1.0));
    QCOMPARE(test::failure(imaging::write_segmentation(test::speckled_segments(grid), {}, file)), QString());
    test::edit(file, [](DcmDataset& dataset) {
      DcmSequenceOfItems* segments = nullptr;
      QVERIFY(dataset.findAndGetSequence(DCM_SegmentSequence, segments).good());
      for (int n = 0; n < 65'535; ++n) segments->prepend(new DcmItem());
    });
    const auto read = imaging::read_segmentation(file, &grid);
    QVERIFY(!read);
    const QString why = QString::fromStdString(read.error().message);
    QVERIFY2(why.contains("SegmentSequence (0062,0002) holds more than 65535 segments"), qPrintable(why));
  }
};

TIDEMARK_TEST(SegmentationMemoryTest)

}  // namespace tidemark::test::segmentation_memory_test

#include "segmentation_memory_test.moc"
