// Siemens mosaics: slices side by side in one image, and the header that says which they are.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>

#include <glm/geometric.hpp>
#include <random>

#include "imaging/dicom/csa_header.h"
#include "imaging/dicom/dicom.h"
#include "imaging/dicom/dicom_values.h"
#include "imaging/load_study.h"
#include "tests/imaging/dicom/frame_bytes.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::dicom_mosaic_test {

namespace fs = std::filesystem;

namespace {

using CsaValues = std::vector<std::pair<std::string, std::vector<std::string>>>;

std::vector<double> numbers(const std::string& header, std::string_view name) {
  return imaging::csa_numbers({reinterpret_cast<const std::uint8_t*>(header.data()), header.size()}, name);
}

constexpr std::int64_t kAcross = 3;

// The volume's slices as tiles, in the order of the slices or against it.
Volume tiled(const Volume& volume, bool is_backward) {
  const Index3 size = volume.geometry.size;
  Volume mosaic = volume;
  mosaic.geometry.size = {size.x * kAcross, size.y * kAcross, 1};
  const glm::dvec3 margin(static_cast<double>(size.x * (kAcross - 1)) / 2.0,
                          static_cast<double>(size.y * (kAcross - 1)) / 2.0, 0.0);
  const double first = is_backward ? static_cast<double>(size.z - 1) : 0.0;
  mosaic.geometry.origin_mm = volume.geometry.to_patient(glm::dvec3(0.0, 0.0, first) - margin);
  std::vector<std::int16_t> voxels(static_cast<std::size_t>(mosaic.geometry.voxel_count()));
  for (std::int64_t k = 0; k < size.z; ++k) {
    const std::int64_t tile = is_backward ? size.z - 1 - k : k;
    for (std::int64_t j = 0; j < size.y; ++j) {
      for (std::int64_t i = 0; i < size.x; ++i) {
        const Index3 at(tile % kAcross * size.x + i, tile / kAcross * size.y + j, 0);
        voxels[static_cast<std::size_t>(mosaic.geometry.offset(at))] = std::get<std::vector<std::int16_t>>(
            volume.voxels)[static_cast<std::size_t>(volume.geometry.offset({i, j, k}))];
      }
    }
  }
  mosaic.voxels = std::move(voxels);
  return mosaic;
}

// The header of the volume as a mosaic.
CsaValues values_of(const Volume& volume, bool is_backward) {
  const glm::dvec3 normal = (is_backward ? -1.0 : 1.0) * volume.geometry.direction[2];
  return {{"NumberOfImagesInMosaic", {std::to_string(volume.geometry.size.z)}},
          {"SliceNormalVector",
           {imaging::decimal(normal.x), imaging::decimal(normal.y), imaging::decimal(normal.z), ""}}};
}

// Writes the volume as a mosaic; `change` has the last word.
fs::path write_mosaic(
    const Volume& volume, const fs::path& folder, bool is_backward, const CsaValues& values,
    const std::function<void(DcmDataset&)>& change = [](DcmDataset&) {}) {
  const fs::path file = test::write_series(tiled(volume, is_backward), folder, "MR").front();
  const std::string header = test::csa_bytes(values);
  test::edit(file, [&](DcmDataset& dataset) {
    dataset.putAndInsertString(DCM_ImageType, "ORIGINAL\\PRIMARY\\M\\ND\\MOSAIC");
    dataset.putAndInsertString(DCM_SpacingBetweenSlices,
                               imaging::decimal(volume.geometry.spacing_mm.z).c_str());
    dataset.putAndInsertString(DcmTag(0x0029, 0x0011, EVR_LO), "SIEMENS CSA HEADER");
    dataset.putAndInsertUint8Array(DcmTag(0x0029, 0x1110, EVR_OB),
                                   reinterpret_cast<const Uint8*>(header.data()),
                                   static_cast<unsigned long>(header.size()));
    change(dataset);
  });
  return file;
}

}  // namespace

class DicomMosaicTest : public QObject {
  Q_OBJECT

  static void verify_same(const Volume& read, const Volume& written) {
    QVERIFY(same_grid(read.geometry, written.geometry, 1e-6));
    QVERIFY(read.voxels == written.voxels);
  }

 private slots:
  void a_mosaic_is_read_in_the_direction_in_which_its_slices_follow() {
    const Volume written = test::sample_volume({6, 5, 7});
    for (const bool is_backward : {false, true}) {
      const test::TemporaryFolder folder;
      write_mosaic(written, folder / "mosaic", is_backward, values_of(written, is_backward));
      const imaging::Series series = test::only_series(folder.path());
      QVERIFY2(series.loadable, series.reason.c_str());
      QCOMPARE(series.files.size(), std::size_t{1});
      QCOMPARE(series.sources.front().tile, std::int64_t{is_backward ? 6 : 0});
      const auto read = imaging::load_dicom(series);
      QCOMPARE(test::failure(read), QString());
      verify_same(*read, written);
      const auto slice = imaging::load_slice(series, 4);
      QCOMPARE(test::failure(slice), QString());
      QCOMPARE(slice->value(Index3{3, 2, 0}), written.value(Index3{3, 2, 4}));
    }
  }

  void several_mosaics_are_times() {
    const test::TemporaryFolder folder;
    std::vector<Volume> written(3, test::sample_volume({6, 5, 7}));
    std::string uid;
    for (std::size_t t = 0; t < written.size(); ++t) {
      std::get<std::vector<std::int16_t>>(written[t].voxels)[11] = static_cast<std::int16_t>(t);
      const fs::path file = write_mosaic(
          written[t], folder / "scratch", false, values_of(written[t], false), [&](DcmDataset& dataset) {
            OFString own;
            dataset.findAndGetOFString(DCM_SeriesInstanceUID, own);
            if (uid.empty()) uid = own.c_str();
            dataset.putAndInsertString(DCM_SeriesInstanceUID, uid.c_str());
            dataset.putAndInsertString(DCM_AcquisitionNumber, std::to_string(t + 1).c_str());
          });
      fs::create_directories(folder / "series");
      fs::rename(file, folder.path() / "series" / fmt::format("{}.dcm", t));
    }
    const auto found = imaging::scan_dicom(folder.path());
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), written.size());
    for (std::size_t t = 0; t < written.size(); ++t) {
      QCOMPARE(found->series[t].description, fmt::format("Sample, acquisition {} of 3", t + 1));
      const auto read = imaging::load_dicom(found->series[t]);
      QCOMPARE(test::failure(read), QString());
      verify_same(*read, written[t]);
    }
  }

  void a_mosaic_of_unknown_slices_is_refused_by_name_data() {
    QTest::addColumn<int>("what");
    QTest::addColumn<QString>("part");
    QTest::newRow("how many") << 0 << "of how many slices";
    QTest::newRow("which way") << 1 << "in which direction";
    QTest::newRow("how far") << 2 << "how far its slices are apart (SpacingBetweenSlices (0018,0088)";
    QTest::newRow("askew") << 3 << "SliceNormalVector is not the normal";
    QTest::newRow("too many") << 4 << "of how many slices";
    QTest::newRow("half a slice") << 5 << "of how many slices";
    QTest::newRow("tiles that do not fit") << 6 << "of 16 slices, which 18 x 15 pixels cannot hold";
    QTest::newRow("two numbers") << 7 << "of 9 slices by (0019,100A), and of 7";
    QTest::newRow("no header") << 8 << "of how many slices";
    QTest::newRow("no place") << 9 << "without ImagePositionPatient (0020,0032)";
    QTest::newRow("an endless distance") << 10 << "(0018,0088)";
  }

  void a_mosaic_of_unknown_slices_is_refused_by_name() {
    QFETCH(int, what);
    QFETCH(QString, part);
    const Volume written = test::sample_volume({6, 5, 7});
    CsaValues values = values_of(written, false);
    if (what == 0) values[0].second = {};
    if (what == 1) values[1].second = {"0", "1"};
    if (what == 3) values[1].second = {"0", "1", "0"};
    if (what == 4) values[0].second = {"4000000000"};
    if (what == 5) values[0].second = {"6.5"};
    if (what == 6) values[0].second = {"16"};
    const test::TemporaryFolder folder;
    write_mosaic(written, folder / "mosaic", false, values, [&](DcmDataset& dataset) {
      if (what == 2) delete dataset.remove(DCM_SpacingBetweenSlices);
      if (what == 7) dataset.putAndInsertUint16(DcmTag(0x0019, 0x100a, EVR_US), 9);
      if (what == 8) delete dataset.remove(DcmTagKey(0x0029, 0x1110));
      if (what == 9) delete dataset.remove(DCM_ImagePositionPatient);
      if (what == 10) dataset.putAndInsertString(DCM_SpacingBetweenSlices, "1e308");
    });
    const imaging::Series series = test::only_series(folder.path());
    QVERIFY(!series.loadable);
    QVERIFY2(QString::fromStdString(series.reason).contains(part), series.reason.c_str());
  }

  void both_forms_of_the_header_are_read() {
    const CsaValues values{{"Echo", {"", "7"}}, {"Name", {"x"}}, {"Numbers", {"1.5 ", "-2e3", "", "4"}}};
    const std::string second = test::csa_bytes(values);
    for (const std::string& header : {second, test::csa_in_first_form(second, 2)}) {
      QCOMPARE(numbers(header, "Numbers"), (std::vector{1.5, -2000.0, 4.0}));
      QCOMPARE(numbers(header, "Echo"), std::vector{7.0});
      QVERIFY(numbers(header, "Name").empty());
      QVERIFY(numbers(header, "Other").empty());
    }
  }

  void a_damaged_header_gives_no_numbers_and_no_harm() {
    const std::string header = test::csa_bytes({{"Echo", {"1", "2"}}, {"Numbers", {"3", "4"}}});
    for (std::size_t size = 0; size < header.size(); ++size) {
      QVERIFY(numbers(header.substr(0, size), "Numbers").empty());
    }
    std::mt19937 random(5);
    for (int round = 0; round < 20000; ++round) {
      std::string damaged = header;
      for (int n = 0; n < 3; ++n) damaged[random() % damaged.size()] = static_cast<char>(random());
      QVERIFY(numbers(damaged, "Numbers").size() <= 2);
    }
    std::string endless = header;
    endless.replace(8, 4, "\xff\xff\xff\xff");
    QVERIFY(numbers(endless, "Other").empty());
  }
};

TIDEMARK_TEST(DicomMosaicTest)

}  // namespace tidemark::test::dicom_mosaic_test

#include "dicom_mosaic_test.moc"
