// Series that hold several volumes, from headers, without files.
#include <algorithm>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "imaging/dicom/series_geometry.h"
#include "imaging/dicom/split_series.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::split_series_test {

namespace {

using Change = std::function<void(imaging::SliceHeader&, int volume, int slice)>;

// `volumes` of `slices` axial slices each at the same positions, listed volume by volume.
std::vector<imaging::SliceHeader> series_of(int volumes, int slices, const Change& change) {
  std::vector<imaging::SliceHeader> series;
  for (int v = 0; v < volumes; ++v) {
    for (int k = 0; k < slices; ++k) {
      imaging::SliceHeader slice;
      slice.file = fmt::format("folder/{:03}", v * slices + k);
      slice.series_uid = "1.2.3";
      slice.sop_instance_uid = fmt::format("1.2.3.{}", v * slices + k);
      slice.description = "Scan";
      slice.modality = "MR";
      slice.transfer_syntax = "1.2.840.10008.1.2.1";
      slice.rows = slice.frame_rows = 8;
      slice.columns = slice.frame_columns = 10;
      slice.bits_allocated = slice.bits_stored = 16;
      slice.high_bit = 15;
      slice.orientation = {glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0)};
      slice.position_mm = glm::dvec3(-5.0, 6.0, 2.0 * k);
      slice.pixel_spacing_mm = glm::dvec2(0.5, 0.5);
      change(slice, v, k);
      series.push_back(slice);
    }
  }
  return series;
}

void turn(imaging::SliceHeader& slice, glm::dvec3 row, glm::dvec3 column) {
  const double along = slice.position_mm->z;
  slice.orientation = {row, column};
  slice.position_mm = along * glm::cross(row, column);
}

}  // namespace

class SplitSeriesTest : public QObject {
  Q_OBJECT

  // Each volume has its slices, and they are those that were meant, whatever the order of the files for
  // `seeds` other than 0.
  static void verify_volumes(std::vector<imaging::SliceHeader> slices, int volumes, const QStringList& labels,
                             const std::vector<unsigned>& seeds = {0U}) {
    const auto in_order = slices;
    for (const unsigned seed : seeds) {
      if (seed > 0) std::shuffle(slices.begin(), slices.end(), std::mt19937(seed));
      const auto found = imaging::group_series(slices);
      QCOMPARE(found.size(), static_cast<std::size_t>(volumes));
      const std::size_t count = slices.size() / found.size();
      for (std::size_t v = 0; v < found.size(); ++v) {
        const imaging::Series& series = found[v];
        QVERIFY2(series.loadable, series.reason.c_str());
        QCOMPARE(series.uid, fmt::format("1.2.3#{}", v + 1));
        const QString& label = labels.at(static_cast<qsizetype>(v));
        QCOMPARE(QString::fromStdString(series.description), "Scan, " + label);
        QVERIFY(std::any_of(series.changes.begin(), series.changes.end(), [&](const std::string& change) {
          return QString::fromStdString(change).contains(label);
        }));
        QCOMPARE(series.sources.size(), count);
        for (std::size_t k = 0; k < count; ++k)
          QCOMPARE(series.sources[k].file, in_order[v * count + k].file);
      }
    }
  }

 private slots:
  void volumes_are_told_apart_by_each_attribute_data() {
    QTest::addColumn<Change>("change");
    QTest::addColumn<QStringList>("labels");
    const auto row = [](const char* name, const Change& change, const QStringList& labels) {
      QTest::newRow(name) << change << labels;
    };
    row("type of image",
        [](imaging::SliceHeader& s, int v, int) {
          s.traits.image_type = v == 0 ? "ORIGINAL\\PRIMARY\\M\\ND" : "ORIGINAL\\PRIMARY\\P\\ND";
        },
        {"magnitude", "phase"});
    row("type of image that only adds a value",
        [](imaging::SliceHeader& s, int v, int) {
          s.traits.image_type = v == 0 ? "A\\B\\M" : "A\\B\\M\\NORM";
        },
        {"type A\\B\\M", "NORM"});
    row("echo",
        [](imaging::SliceHeader& s, int v, int) {
          s.traits.echo_number = v + 1;
          s.traits.echo_time_ms = 15.0 * (v + 1);
        },
        {"echo 1, TE 15 ms", "echo 2, TE 30 ms", "echo 3, TE 45 ms"});
    row("time of the echo alone",
        [](imaging::SliceHeader& s, int v, int) { s.traits.echo_time_ms = 2.5 + v; },
        {"TE 2.5 ms", "TE 3.5 ms"});
    row("b-value", [](imaging::SliceHeader& s, int v, int) { s.traits.b_value = 500.0 * v; },
        {"b 0", "b 500", "b 1000"});
    row("direction of diffusion",
        [](imaging::SliceHeader& s, int v, int) {
          s.traits.b_value = 1000.0;
          s.traits.gradient = v == 0 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.6, 0.0, 0.8);
        },
        {"b 1000, direction (0.00, 1.00, 0.00)", "b 1000, direction (0.60, 0.00, 0.80)"});
    row("temporal position", [](imaging::SliceHeader& s, int v, int) { s.traits.temporal_position = v + 1; },
        {"time 1 of 3", "time 2 of 3", "time 3 of 3"});
    row("trigger time, a little different in each slice",
        [](imaging::SliceHeader& s, int v, int k) { s.traits.trigger_time_ms = 40.0 * v + k; },
        {"trigger time 1 of 3", "trigger time 2 of 3", "trigger time 3 of 3"});
    row("acquisition", [](imaging::SliceHeader& s, int v, int) { s.traits.acquisition = v + 4; },
        {"acquisition 1 of 2", "acquisition 2 of 2"});
    row("time of acquisition, slice by slice",
        [](imaging::SliceHeader& s, int v, int k) { s.traits.acquired_at = 20040731120000.0 + 60 * v + k; },
        {"time 1 of 2", "time 2 of 2"});
    row("time of the content",
        [](imaging::SliceHeader& s, int v, int) { s.traits.made_at = 20040731120000.0 + v; },
        {"time 1 of 2", "time 2 of 2"});
    row("number of the instance",
        [](imaging::SliceHeader& s, int v, int k) { s.traits.instance = 4 * v + k + 1; },
        {"volume 1 of 2", "volume 2 of 2"});
    row("series number", [](imaging::SliceHeader& s, int v, int) { s.traits.series_number = v + 7; },
        {"series number 7", "series number 8"});
    row("two echoes, each as magnitude and phase",
        [](imaging::SliceHeader& s, int v, int) {
          s.traits.image_type = v < 2 ? "ORIGINAL\\PRIMARY\\M" : "ORIGINAL\\PRIMARY\\P";
          s.traits.echo_number = v % 2 + 1;
        },
        {"magnitude, echo 1", "magnitude, echo 2", "phase, echo 1", "phase, echo 2"});
    row("one b-value twice and another",
        [](imaging::SliceHeader& s, int v, int k) {
          s.traits.b_value = v < 2 ? 0.0 : 800.0;
          s.traits.instance = 4 * v + k;
        },
        {"b 0, volume 1 of 2", "b 0, volume 2 of 2", "b 800"});
  }

  void volumes_are_told_apart_by_each_attribute() {
    QFETCH(Change, change);
    QFETCH(QStringList, labels);
    const int volumes = static_cast<int>(labels.size());
    verify_volumes(series_of(volumes, 4, change), volumes, labels, {0U, 1U, 2U});
  }

  void attributes_that_differ_from_slice_to_slice_do_not_split_a_volume() {
    const auto slices = series_of(1, 6, [](imaging::SliceHeader& s, int, int k) {
      s.traits.image_type = k % 2 == 0 ? "A\\B\\M" : "A\\B\\P";
      s.traits.echo_time_ms = k;
      s.traits.acquired_at = k;
      s.traits.instance = k;
    });
    const auto found = imaging::group_series(slices);
    QCOMPARE(found.size(), std::size_t{1});
    QVERIFY2(found[0].loadable, found[0].reason.c_str());
    QCOMPARE(found[0].uid, std::string("1.2.3"));
    QCOMPARE(found[0].description, std::string("Scan"));
    QVERIFY(found[0].changes.empty());
  }

  void a_localiser_is_split_by_orientation_size_and_spacing() {
    verify_volumes(series_of(3, 2,
                             [](imaging::SliceHeader& s, int v, int) {
                               if (v == 1) turn(s, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
                               if (v == 2) turn(s, {0.0, 1.0, 0.0}, {0.0, 0.0, -1.0});
                             }),
                   3, {"axial", "coronal", "sagittal"});
    verify_volumes(series_of(2, 3,
                             [](imaging::SliceHeader& s, int v, int) {
                               if (v == 1) s.rows = s.columns = 16;
                               if (v == 1) s.pixel_spacing_mm = glm::dvec2(0.25, 0.25);
                             }),
                   2, {"10 x 8 pixels, pixels of 0.5 mm", "16 x 16 pixels, pixels of 0.25 mm"});
  }

  void stacks_beside_each_other_are_volumes() {
    verify_volumes(series_of(2, 3,
                             [](imaging::SliceHeader& s, int v, int) {
                               s.traits.stack = v == 0 ? "left" : "right";
                               s.position_mm->z += 1.0 * v;
                             }),
                   2, {"stack left", "stack right"});
  }

  void a_scout_is_listed_and_hinders_nobody() {
    auto slices = series_of(1, 4, [](imaging::SliceHeader&, int, int) {});
    imaging::SliceHeader scout = slices[0];
    scout.file = "folder/scout";
    scout.sop_instance_uid = "1.2.4";
    scout.rows = 300;
    slices.push_back(scout);
    // As far as it goes it may be a slice that was damaged.
    auto found = imaging::group_series(slices);
    QCOMPARE(found.size(), std::size_t{1});
    QVERIFY2(found[0].reason.find("the size (Rows, Columns)") == 0, found[0].reason.c_str());

    slices.back().traits.image_type = "ORIGINAL\\PRIMARY\\LOCALIZER";
    found = imaging::group_series(slices);
    QCOMPARE(found.size(), std::size_t{2});
    QVERIFY2(found[0].loadable, found[0].reason.c_str());
    QCOMPARE(found[0].files.size(), std::size_t{4});
    QVERIFY(!found[1].loadable);
    QCOMPARE(found[1].files, std::vector<std::filesystem::path>{"folder/scout"});
    QVERIFY2(found[1].reason.find("scout is a single image") == 0, found[1].reason.c_str());
  }

  void an_image_in_another_plane_is_listed_and_hinders_nobody() {
    auto slices = series_of(1, 5, [](imaging::SliceHeader& s, int, int k) {
      if (k == 4) turn(s, {1.0, 0.0, 0.0}, {0.0, 0.0, -1.0});
    });
    auto found = imaging::group_series(slices);
    QCOMPARE(found.size(), std::size_t{2});
    QVERIFY2(found[0].loadable, found[0].reason.c_str());
    QCOMPARE(found[1].files, std::vector<std::filesystem::path>{"folder/004"});
    // No directions of any plane.
    slices.back().orientation = {glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(1.0, 0.0, 0.0)};
    found = imaging::group_series(slices);
    QCOMPARE(found.size(), std::size_t{1});
    QVERIFY(!found[0].loadable);
  }

  void a_capture_of_the_screen_hinders_nobody() {
    auto slices = series_of(1, 4, [](imaging::SliceHeader& s, int, int) { s.sop_class_uid = "1.2.840.2"; });
    imaging::SliceHeader capture;
    capture.file = "folder/capture";
    capture.series_uid = "1.2.3";
    capture.sop_class_uid = "1.2.840.7";
    capture.problem = "SamplesPerPixel (0028,0002) is 3";
    slices.insert(slices.begin(), capture);
    auto found = imaging::group_series(slices);
    QCOMPARE(found.size(), std::size_t{2});
    QVERIFY2(found[0].loadable, found[0].reason.c_str());
    QCOMPARE(found[1].reason, std::string("capture: SamplesPerPixel (0028,0002) is 3"));
    // What may be a slice that is missing.
    slices.front().sop_class_uid.clear();
    found = imaging::group_series(slices);
    QCOMPARE(found.size(), std::size_t{1});
    QVERIFY(!found[0].loadable);
  }

  void copies_are_left_out_and_named() {
    auto slices = series_of(1, 4, [](imaging::SliceHeader&, int, int) {});
    slices.push_back(slices[2]);
    slices.back().file = "folder/copy";
    auto found = imaging::group_series(slices);
    QCOMPARE(found.size(), std::size_t{1});
    QVERIFY2(found[0].loadable, found[0].reason.c_str());
    QCOMPARE(found[0].files.size(), std::size_t{4});
    QCOMPARE(found[0].changes, std::vector<std::string>{"copy is the same image as 002 and is left out"});
    // Not what it says it is a copy of: both are kept, and nothing tells them apart.
    slices.back().slope = 2.0;
    found = imaging::group_series(slices);
    QCOMPARE(found.size(), std::size_t{1});
    QVERIFY(!found[0].loadable);
    QCOMPARE(found[0].files.size(), std::size_t{5});
  }

  // Those of the second lie right behind those of the first.
  void images_of_two_patients_or_studies_are_no_volume_data() {
    QTest::addColumn<bool>("by_patient");
    QTest::addColumn<QString>("series_uid");
    for (const char* uid : {"1.2.3", ""}) {
      QTest::addRow("patients, %s", *uid != '\0' ? "one series" : "no series") << true << QString(uid);
      QTest::addRow("studies, %s", *uid != '\0' ? "one series" : "no series") << false << QString(uid);
    }
  }
  void images_of_two_patients_or_studies_are_no_volume() {
    QFETCH(bool, by_patient);
    QFETCH(QString, series_uid);
    const auto slices = [&](const char* second) {
      return series_of(1, 8, [&](imaging::SliceHeader& s, int, int k) {
        s.series_uid = series_uid.toStdString();
        s.patient.id = by_patient && k >= 5 ? second : "A";
        s.study_uid = !by_patient && k >= 5 ? second : "1.1";
      });
    };
    const auto found = imaging::group_series(slices(by_patient ? "B" : "1.2"));
    QCOMPARE(found.size(), std::size_t{2});
    for (const imaging::Series& series : found) {
      QVERIFY2(series.loadable, series.reason.c_str());
      QCOMPARE(series.warnings.size(), std::size_t{1});
      QVERIFY2(series.warnings[0].find("PatientID (0010,0020)") != std::string::npos,
               series.warnings[0].c_str());
    }
    QCOMPARE(found[0].files.size(), std::size_t{5});
    QCOMPARE(found[1].files.size(), std::size_t{3});
    QCOMPARE(found[1].patient.id, std::string(by_patient ? "B" : "A"));
    QCOMPARE(found[1].study_uid, std::string(by_patient ? "1.1" : "1.2"));
    QVERIFY(found[0].uid.ends_with("#1") && found[1].uid.ends_with("#2"));
    // Images that name nobody may be the first one's.
    const auto one = imaging::group_series(slices(""));
    QCOMPARE(one.size(), std::size_t{1});
    QVERIFY2(one[0].loadable, one[0].reason.c_str());
    QVERIFY(one[0].warnings.empty());
  }

  void what_nothing_tells_apart_is_refused_whole() {
    const auto found = imaging::group_series(series_of(2, 4, [](imaging::SliceHeader&, int, int) {}));
    QCOMPARE(found.size(), std::size_t{1});
    QVERIFY(!found[0].loadable);
    QVERIFY2(found[0].reason.find("2 images at each of 4 positions") != std::string::npos,
             found[0].reason.c_str());
  }

  void a_series_with_an_image_that_cannot_be_used_is_refused_whole() {
    auto slices = series_of(2, 4, [](imaging::SliceHeader& s, int v, int) { s.traits.echo_number = v; });
    slices[5].problem = "is damaged";
    const auto found = imaging::group_series(slices);
    QCOMPARE(found.size(), std::size_t{1});
    QVERIFY2(found[0].reason.find("005: is damaged") == 0, found[0].reason.c_str());
  }

  void images_in_as_many_orientations_are_one_refused_series() {
    auto slices = series_of(1, 2000, [](imaging::SliceHeader& s, int, int k) {
      const double angle = 0.003 * k;
      turn(s, {std::cos(angle), std::sin(angle), 0.0}, {-std::sin(angle), std::cos(angle), 0.0});
    });
    const auto found = imaging::group_series(slices);
    QCOMPARE(found.size(), std::size_t{1});
    QVERIFY(!found[0].loadable);
    QVERIFY2(found[0].reason.find("the orientation") == 0, found[0].reason.c_str());
  }
};

TIDEMARK_TEST(SplitSeriesTest)

}  // namespace tidemark::test::split_series_test

#include "split_series_test.moc"
