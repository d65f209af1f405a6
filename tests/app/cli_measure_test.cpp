// Segmentations measured: boxes of known sizes, labels, PET, the change since another study, and what is
// refused.
#include <QFile>
#include <QJsonArray>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "core/atomic_file.h"
#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "tests/app/cli_runner.h"
#include "tests/support/grid.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_measure_test {

namespace {

struct Box {
  Index3 low{0};
  Index3 high{0};  // without it
  std::int16_t label = 1;
};

Volume map_of(const Geometry& grid, const std::vector<Box>& boxes) {
  Volume map;
  map.geometry = grid;
  std::vector<std::int16_t> voxels;
  for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
    const Index3 voxel = grid.voxel_at(i);
    std::int16_t label = 0;
    for (const Box& box : boxes) {
      if (glm::all(glm::greaterThanEqual(voxel, box.low)) && glm::all(glm::lessThan(voxel, box.high)))
        label = box.label;
    }
    voxels.push_back(label);
  }
  map.voxels = voxels;
  return map;
}

// Each voxel's value is its column.
Volume ramp(const Geometry& grid) {
  Volume volume;
  volume.geometry = grid;
  std::vector<std::int16_t> voxels;
  for (std::int64_t i = 0; i < grid.voxel_count(); ++i)
    voxels.push_back(static_cast<std::int16_t>(grid.voxel_at(i).x));
  volume.voxels = voxels;
  return volume;
}

bool near(const QJsonValue& found, double expected) {
  return std::abs(found.toDouble(-1e9) - expected) < 1e-6;
}

}  // namespace

class CliMeasureTest : public QObject {
  Q_OBJECT

 private slots:
  void a_box_has_its_measures() {
    const QString study = write("study", ramp(grid_));
    const QString mask = write("mask", map_of(grid_, {{{10, 5, 4}, {21, 9, 10}}}));
    const QJsonObject box =
        json_of(must_run({"measure", study, mask, "--json"}).out)["regions"][0].toObject();
    QVERIFY(!box.contains("label"));
    QCOMPARE(box["voxels"].toInt(), 11 * 4 * 6);
    QVERIFY(near(box["volume_ml"], 11 * 4 * 6 * 0.003));
    // From the middle of a face to that of the opposite one: a voxel less across.
    QVERIFY(near(box["longest_in_slice"]["mm"], std::hypot(11.0, 3.0)));
    QVERIFY(near(box["longest_diameter"]["mm"], std::sqrt(100.0 + 9.0 + 18.0 * 18.0)));
    QVERIFY(box["across_in_slice"]["mm"].toDouble() > 3.5 && box["across_in_slice"]["mm"].toDouble() < 4.5);
    QVERIFY(near(box["reach_mm"][0], 18.0) && near(box["reach_mm"][1], 11.0) &&
            near(box["reach_mm"][2], 4.0));
    QVERIFY(std::abs(std::abs(box["main_axes"][0][2].toDouble()) - 1.0) < 1e-9);
    // A box of 11 x 4 x 18 mm with rounded edges.
    const double area = 2.0 * (11.0 * 4.0 + 11.0 * 18.0 + 4.0 * 18.0);
    QVERIFY(box["area_mm2"].toDouble() > 0.85 * area && box["area_mm2"].toDouble() < 1.02 * area);
    QVERIFY(box["sphericity"].toDouble() > 0.6 && box["sphericity"].toDouble() < 0.9);
    const QJsonObject values = box["images"][0].toObject();
    QCOMPARE(values["image"].toString(), study);
    QVERIFY(near(values["mean"], 15.0) && near(values["smallest"], 10.0) && near(values["largest"], 20.0));
    QVERIFY(near(values["standard_deviation"], std::sqrt(10.0)));
    QVERIFY(near(values["percentiles"]["50"], 15.0) && near(values["percentiles"]["5"], 10.0));
    QVERIFY(!values.contains("peak_1ml"));
  }

  void labels_and_further_images_are_lines_of_a_table() {
    const QString study = write("study", ramp(grid_));
    Geometry finer = grid_;
    finer.size = {60, 40, 20};
    finer.spacing_mm = {0.5, 0.5, 3.0};
    Volume constant;
    constant.geometry = finer;
    constant.voxels = std::vector<std::int16_t>(static_cast<std::size_t>(finer.voxel_count()), 7);
    const QString other = write("other", constant);
    const QString labels =
        write("labels", map_of(grid_, {{{2, 2, 2}, {5, 5, 5}, 3}, {{8, 8, 8}, {9, 9, 9}, 8}}));
    const QString table = text(folder_ / "measures.csv");
    const QJsonArray regions =
        json_of(must_run({"measure", study, labels, "--labels", "--image", other, "--csv", table, "--json"})
                    .out)["regions"]
            .toArray();
    QCOMPARE(regions.size(), qsizetype{2});
    QCOMPARE(regions[0]["label"].toString(), QStringLiteral("Segment 3"));
    QCOMPARE(regions[1]["voxels"].toInt(), 1);
    QVERIFY(near(regions[0]["images"][1]["mean"], 7.0));
    QFile file(table);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QStringList lines = QString::fromUtf8(file.readAll()).split("\r\n");
    QCOMPARE(lines.size(), qsizetype{6});
    const qsizetype columns = lines[0].count(u',');
    for (int line = 1; line < 5; ++line) QCOMPARE(lines[line].count(u','), columns);
    QVERIFY2(lines[1].startsWith("Segment 3," + study), qPrintable(lines[1]));
    QVERIFY2(lines[4].startsWith("Segment 8," + other), qPrintable(lines[4]));
    const Outcome said = must_run({"measure", study, labels, "--labels", "--image", other});
    QVERIFY2(said.out.contains("Segment 8") && said.out.contains("other"), said.told());
  }

  void an_image_is_measured_where_it_is() {
    const QString study = write("study", ramp(grid_));
    Geometry half = grid_;
    half.size.z = 10;
    const QString other = write("other", ramp(half));
    const QString labels =
        write("labels", map_of(grid_, {{{10, 5, 8}, {21, 9, 12}, 3}, {{10, 5, 14}, {21, 9, 18}, 8}}));
    const QString table = text(folder_ / "measures.csv");
    const Outcome told =
        must_run({"measure", study, labels, "--labels", "--image", other, "--csv", table, "--json"});
    const QJsonArray regions = json_of(told.out)["regions"].toArray();
    const QJsonArray images = regions[0]["images"].toArray();
    QVERIFY(near(images[0]["covered"], 1.0) && near(images[1]["covered"], 0.5));
    QVERIFY(near(images[1]["mean"], 15.0) && near(images[1]["smallest"], 10.0));
    QCOMPARE(regions[1]["images"].toArray().size(), qsizetype{1});
    for (const char* words :
         {"other.nii.gz: covers 50.0 % of Segment 3", "other.nii.gz: covers 0.0 % of Segment 8"})
      QVERIFY2(told.err.contains(words), told.told());
    const QStringList lines = QString::fromUtf8(bytes_of(folder_ / "measures.csv")).split("\r\n");
    QCOMPARE(lines.size(), qsizetype{5});
    QVERIFY2(lines[0].endsWith(",covered") && lines[1].endsWith(",1") && lines[2].endsWith(",0.5"),
             qPrintable(lines.join(u'\n')));
  }

  void key_images_name_the_image_in_which_a_region_is_largest() {
    must_run({"phantom", "sphere", "--out", text(folder_ / "sphere")});
    const QString series = text(folder_ / "sphere" / "series");
    const QString truth = text(folder_ / "sphere" / "truth.nii.gz");
    const QStringList key{"--key-images", text(folder_ / "key.dcm")};
    const QStringList state{"--presentation", text(folder_ / "state.dcm")};
    const Outcome said = must_run(
        QStringList{"measure", series, truth, "--labels", "--note", "a sphere's middle"} + key + state);
    QVERIFY2(said.out.contains("key.dcm") && said.out.contains("state.dcm"), said.told());
    const QByteArray selection = bytes_of(folder_ / "key.dcm");
    QVERIFY(selection.contains("1.2.840.10008.5.1.4.1.1.88.59") && selection.contains("a sphere's middle"));
    QVERIFY(bytes_of(folder_ / "state.dcm").contains("1.2.840.10008.5.1.4.1.1.11.1"));

    const QString study = write("study", ramp(grid_));
    const QString mask = write("mask", map_of(grid_, {{{10, 5, 4}, {21, 9, 10}}}));
    const Outcome no_series = run_cli(QStringList{"measure", study, mask, "--labels"} + key);
    QCOMPARE(no_series.code, 2);
    QVERIFY2(no_series.err.contains("is no DICOM series"), no_series.told());
    const Outcome no_labels = run_cli(QStringList{"measure", series, truth} + key);
    QCOMPARE(no_labels.code, 2);
    QVERIFY2(no_labels.err.contains("needs --labels"), no_labels.told());
    const Outcome state_alone = run_cli(QStringList{"measure", series, truth} + state);
    QCOMPARE(state_alone.code, 2);
    QVERIFY2(state_alone.err.contains("needs --key-images"), state_alone.told());
  }

  void the_change_since_another_study_is_told_by_name() {
    const QString study = write("study", ramp(grid_));
    const QString first =
        write("first", map_of(grid_, {{{2, 2, 2}, {12, 4, 5}, 3}, {{8, 8, 8}, {9, 9, 9}, 8}}));
    const QString second =
        write("second", map_of(grid_, {{{2, 2, 2}, {7, 4, 5}, 3}, {{20, 10, 8}, {21, 11, 9}, 9}}));
    const QString before = text(folder_ / "before.json");
    QFile file(before);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(must_run({"measure", study, first, "--labels", "--json"}).out);
    file.close();
    const QJsonObject change =
        json_of(must_run({"measure", study, second, "--labels", "--before", before, "--json"}).out)["change"]
            .toObject();
    const double was = std::hypot(10.0, 1.0);
    const double is = std::hypot(5.0, 1.0);
    QVERIFY(near(change["regions"][0]["volume_percent"], -50.0));
    QVERIFY(near(change["regions"][0]["longest_in_slice_percent"], 100.0 * (is - was) / was));
    QVERIFY(change["regions"][1]["volume_percent"].isNull());  // it is new
    QCOMPARE(change["missing"], (QJsonArray{"Segment 8"}));
    QVERIFY(near(change["sum_mm"], is) && near(change["sum_before_mm"], was));
    const Outcome said = must_run({"measure", study, second, "--labels", "--before", before});
    QVERIFY2(said.out.contains("-50.0 %") && said.out.contains("new"), said.told());
  }

  void another_frame_of_reference_is_warned_of() {
    for (const char* name : {"ct", "other"})
      QCOMPARE(failure(imaging::write_dicom_series(ramp(grid_), {}, folder_ / name)), QString());
    const QString ct = text(folder_ / "ct");
    const QString other = text(folder_ / "other");
    const QString labels = write("labels", map_of(grid_, {{{2, 2, 2}, {9, 9, 9}, 3}}));
    const QString back = text(folder_ / "back.nrrd");
    const auto told_of = [](const QString& file) {
      return (file + ": it names another frame of reference than the study").toUtf8();
    };
    must_run({"convert", labels, "--labels", "--source", ct, "--out", text(folder_ / "seg.dcm"), "--rtstruct",
              text(folder_ / "set.dcm")});
    for (const char* name : {"seg.dcm", "set.dcm"}) {
      const QString result = text(folder_ / name);
      for (const QStringList& how : {QStringList{}, QStringList{"--labels"}}) {
        const Outcome same = must_run(QStringList{"measure", ct, result, "--image", other} + how);
        QVERIFY2(!same.err.contains(told_of(result)) && same.err.contains(told_of(other)), same.told());
        const Outcome differs = must_run(QStringList{"measure", other, result, "--image", other} + how);
        QVERIFY2(differs.err.contains(told_of(result)) && !differs.err.contains(told_of(other)),
                 differs.told());
      }
      const Outcome kept = must_run({"convert", result, "--source", ct, "--out", back});
      QVERIFY2(!kept.out.contains("frame of reference"), kept.told());
      const Outcome moved = must_run({"convert", result, "--source", other, "--out", back});
      QVERIFY2(moved.out.contains("another frame of reference than the study"), moved.told());
    }
  }

  void what_does_not_fit_ends_with_one_line() {
    const QString study = write("study", ramp(grid_));
    const QString mask = write("mask", map_of(grid_, {{{1, 1, 1}, {4, 4, 4}}}));
    const QString larger =
        write("larger", map_of(grid_of({31, 20, 20}, {1.0, 1.0, 3.0}), {{{1, 1, 1}, {4, 4, 4}}}));
    QVERIFY(run_cli({"measure", study}).failed_in_one_line(2));
    QVERIFY(run_cli({"measure", study, larger}).failed_in_one_line(3));
    QVERIFY(run_cli({"measure", study, mask, "--csv", text(folder_ / "t.txt")}).failed_in_one_line(2));
    QVERIFY(run_cli({"measure", study, mask, "--before", mask}).failed_in_one_line(3));
    const QString broken = text(folder_ / "broken.json");
    for (const char* json :
         {"[]", "{\"regions\": 3}", "{\"regions\": [{\"volume_ml\": -1}]}", "{\"regions\": [{}]}"}) {
      QVERIFY(write_file(folder_ / "broken.json", std::string(json)).has_value());
      const Outcome refused = run_cli({"measure", study, mask, "--before", broken});
      QVERIFY2(refused.failed_in_one_line(3) && refused.err.contains("broken.json"), refused.told());
    }
    // An empty region is told of, and is no failure.
    const Outcome empty = must_run({"measure", study, write("none", map_of(grid_, {}))});
    QVERIFY2(empty.err.contains("is empty"), empty.told());
  }

 private:
  QString write(const std::string& name, const Volume& volume) {
    const auto file = folder_ / (name + ".nii.gz");
    if (!imaging::write_volume_file(volume, file)) qFatal("the volume cannot be written");
    return text(file);
  }

  Geometry grid_ = grid_of({30, 20, 20}, {1.0, 1.0, 3.0});
  TemporaryFolder folder_;
};

TIDEMARK_TEST(CliMeasureTest)

}  // namespace tidemark::test::cli_measure_test

#include "cli_measure_test.moc"
