// Real files and series that hold several slices a file, or several volumes: where dcm2niix puts them, and
// with the values that other readers found in them (truth.json beside the studies).
#include <glm/geometric.hpp>
#include <numeric>

#include "imaging/dicom/dicom.h"
#include "imaging/dicom/pixels.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::dicom_volumes_test {

namespace fs = std::filesystem;

namespace {

// One volume of a study: which it is of its series' volumes, and where its first and last slices begin.
struct Expected {
  const char* study;
  std::size_t volumes;
  std::size_t number;  // from 1
  std::string label;   // its description ends so
  Index3 size;
  glm::dvec3 first_mm;
  glm::dvec3 last_mm;
  double sum;  // of all stored values; negative: not known, or with bits that do not count
};

std::vector<Expected> expected_volumes() {
  std::vector<Expected> all{
      {"d05_enhanced_mr_siemens_xa30",
       1,
       1,
       "anat-T1w_acq-tfl",
       {128, 128, 96},
       {89.576, -156.094, 113.224},
       {-100.424, -156.094, 113.224},
       142.194425 * 1572864},
      {"d06_enhanced_mr_philips",
       1,
       1,
       "",
       {256, 256, 8},
       {100.2936, -150.6046, 116.9492},
       {},
       127.156574 * 524288},
      {"d11_mixed_orientation",
       2,
       1,
       "sagittal, pixels of 0.32 mm",
       {288, 288, 2},
       {21.2970, -131.0382, 136.8557},
       {17.9999, -131.0008, 136.9881},
       -1.0},
      {"d11_mixed_orientation",
       2,
       2,
       "axial, pixels of 0.556 mm",
       {288, 288, 2},
       {-86.7251, -41.6045, -15.5853},
       {-86.5660, -42.6803, -11.3218},
       -1.0},
      {"d14_4d_dti_ge",
       2,
       1,
       "b 0",
       {128, 128, 4},
       {-126.875, -143.876, -61.4995},
       {-126.875, -143.876, -55.4995},
       -1.0},
      {"d14_4d_dti_ge",
       2,
       2,
       "b 1000",
       {128, 128, 4},
       {-126.875, -143.876, -61.4995},
       {-126.875, -143.876, -55.4995},
       -1.0},
  };
  for (std::size_t n = 1; n <= 9; ++n) {
    all.push_back({"d07_syntaxes_same_pixels",
                   9,
                   n,
                   fmt::format("series number {}", n),
                   {64, 64, 35},
                   {-104.0, -144.8681, -62.6852},
                   {-104.0, -131.6490, 58.9989},
                   257.95263 * 147456});
  }
  for (std::size_t n = 1; n <= 3; ++n) {
    all.push_back({"d16_12bit",
                   3,
                   n,
                   fmt::format("series number {}", n + 1),
                   {64, 64, 35},
                   {-108.8406, -119.5649, -25.6271},
                   {-108.6507, -129.6148, 82.7076},
                   -1.0});
  }
  return all;
}

}  // namespace

class DicomVolumesTest : public QObject {
  Q_OBJECT

 private slots:
  void a_volume_lies_where_another_reader_puts_it_data() {
    QTest::addColumn<std::size_t>("index");
    const auto all = expected_volumes();
    for (std::size_t n = 0; n < all.size(); ++n) {
      QTest::addRow("%s %zu", all[n].study, all[n].number) << n;
    }
  }

  void a_volume_lies_where_another_reader_puts_it() {
    QFETCH(std::size_t, index);
    const Expected expected = expected_volumes()[index];
    const auto found = imaging::scan_dicom(test::studies_folder() / expected.study);
    QCOMPARE(test::failure(found), QString());
    QCOMPARE(found->series.size(), expected.volumes);
    const imaging::Series& series = found->series[expected.number - 1];
    QVERIFY2(series.loadable, series.reason.c_str());
    QVERIFY2(series.description.ends_with(expected.label), series.description.c_str());
    if (expected.volumes > 1) QVERIFY(series.uid.ends_with(fmt::format("#{}", expected.number)));

    const auto volume = imaging::load_dicom(series);
    QCOMPARE(test::failure(volume), QString());
    const Geometry& g = volume->geometry;
    QCOMPARE(g.size, expected.size);
    QVERIFY(glm::length(g.origin_mm - expected.first_mm) < 1e-3);
    const glm::dvec3 last = g.to_patient({0.0, 0.0, static_cast<double>(g.size.z - 1)});
    if (expected.last_mm != glm::dvec3(0.0)) QVERIFY(glm::length(last - expected.last_mm) < 2e-3);
    if (expected.sum < 0.0) return;
    double sum = 0.0;
    for (const float value : volume->values()) {
      sum += (static_cast<double>(value) - volume->intercept) / volume->slope;
    }
    QVERIFY2(std::abs(sum - expected.sum) < 1e-6 * expected.sum, qPrintable(QString::number(sum, 'g', 12)));
  }

  void the_two_b_values_are_the_files_that_say_so() {
    const auto found = imaging::scan_dicom(test::studies_folder() / "d14_4d_dti_ge");
    QCOMPARE(test::failure(found), QString());
    for (int k = 0; k < 4; ++k) {
      const auto slice = static_cast<std::size_t>(k);
      QCOMPARE(found->series[0].files[slice].filename().string(),
               fmt::format("IM-0001-{:04}-0001.dcm", 1 + k));
      QCOMPARE(found->series[1].files[slice].filename().string(),
               fmt::format("IM-0001-{:04}-0001.dcm", 76 + k));
    }
  }

  void each_frame_is_decoded_by_itself() {
    const auto found = imaging::scan_dicom(test::studies_folder() / "d05_enhanced_mr_siemens_xa30");
    QCOMPARE(test::failure(found), QString());
    const auto reader = imaging::FrameReader::open(found->series[0].files[0]);
    QCOMPARE(test::failure(reader), QString());
    const auto volume = imaging::load_dicom(found->series[0]);
    QCOMPARE(reader->frames(), std::int64_t{96});
    for (std::int64_t k = 0; k < 96; ++k) {
      const imaging::SliceSource& source = found->series[0].sources[static_cast<std::size_t>(k)];
      QCOMPARE(source.frame, 95 - k);  // the frames follow each other against the normal
      const auto frame = reader->decode(source.frame);
      QCOMPARE(test::failure(frame), QString());
      QCOMPARE(volume->value(Index3{64, 31, k}), static_cast<float>(frame->stored[31 * 128 + 64]));
    }
    QVERIFY(!reader->decode(96));
    QVERIFY(!reader->decode(-1));
  }
};

TIDEMARK_STUDY_TEST(DicomVolumesTest)

}  // namespace tidemark::test::dicom_volumes_test

#include "dicom_volumes_test.moc"
