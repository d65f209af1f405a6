// The main job from end to end, and that it gives the same results whatever the detour.
#include <fcntl.h>
#include <unistd.h>

#include <QJsonArray>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"

using namespace tidemark;
using namespace tidemark::test;

namespace {

Outcome must_run(const QStringList& arguments, const RunOptions& options = {}) {
  Outcome outcome = run_cli(arguments, options);
  if (outcome.code != 0) qWarning("%s", outcome.told().constData());
  return outcome;
}

}  // namespace

class CliRunTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase();
  void a_sphere_phantom_is_found_segmented_and_measured();
  void info_lists_what_the_contract_names();
  void a_terminal_gets_a_progress_bar();
  void stats_hold_what_the_contract_names();
  void a_resumed_run_equals_an_unbroken_one();
  void the_start_is_a_mask_or_a_threshold_or_a_fill();
  void a_mask_with_other_axes_is_matched_by_its_geometry();
  void pictures_are_drawn_from_masks_and_fields();
  void host_and_reference_agree();
  void each_term_can_be_switched_off();
  void an_automatic_start_says_what_it_chose();
  void distance_is_signed_and_in_millimetres();
  void formats_keep_values_and_geometry();
  void a_mask_becomes_a_surface();
  void a_german_locale_changes_nothing();
  void thin_volumes_are_segmented_data();
  void thin_volumes_are_segmented();
  void a_series_of_two_slices_is_segmented();
  void bench_prints_its_figures();

 private:
  QStringList sphere_arguments() const;

  TemporaryFolder folder_;
  QJsonObject phantom_;
};

// The folder "sphere" is the phantom that most tests work on.
void CliRunTest::initTestCase() {
  QCOMPARE(must_run({"phantom", "sphere", "--out", text(folder_ / "sphere")}).code, 0);
  phantom_ = json_of(bytes_of(folder_ / "sphere/phantom.json"));
  QVERIFY(phantom_.contains("target"));
}

QStringList CliRunTest::sphere_arguments() const {
  QStringList seed;
  for (const auto number : phantom_["seed"].toArray()) seed.append(QString::number(number.toDouble()));
  return {"segment",   text(folder_ / "sphere/series"),
          "--target",  QString::number(phantom_["target"].toDouble()),
          "--range",   QString::number(phantom_["range"].toDouble()),
          "--alpha",   QString::number(phantom_["alpha"].toDouble()),
          "--seed",    seed.join(','),
          "--threads", "1"};
}

void CliRunTest::a_sphere_phantom_is_found_segmented_and_measured() {
  QStringList arguments = sphere_arguments() + QStringList{"--converge",
                                                           "--truth",
                                                           text(folder_ / "sphere/truth.nii.gz"),
                                                           "--stats",
                                                           text(folder_ / "stats.json"),
                                                           "--json"};
  const QStringList names{"mask.nii.gz", "mask.nii", "mask.nrrd", "mask.mha",
                          "mask.stl",    "mask.ply", "mask.obj"};
  for (const QString& name : names) arguments += {"--out", text(folder_ / name.toStdString())};
  const Outcome outcome = must_run(arguments);
  QCOMPARE(outcome.code, 0);
  QVERIFY2(outcome.err.isEmpty(), outcome.told());
  const QJsonObject stats = json_of(outcome.out);
  QCOMPARE(json_of(bytes_of(folder_ / "stats.json")), stats);
  QVERIFY(stats["converged"].toBool());
  QVERIFY2(stats["dice"].toDouble() > 0.97, outcome.told());

  const auto truth = read_volume_file(folder_ / "sphere/truth.nii.gz");
  const auto series = must_run({"info", text(folder_ / "sphere/series"), "--json"});
  const QJsonObject found = json_of(series.out)["series"].toArray().first().toObject();
  for (const QString& name : names.mid(0, 4)) {
    const auto mask = read_volume_file(folder_ / name.toStdString());
    QCOMPARE(failure(mask), QString());
    QVERIFY(same_grid(mask->geometry, truth->geometry, 1e-3));
    QCOMPARE(mask->geometry.size.x, found["size"].toArray()[0].toInt());
    std::int64_t inside = 0;
    for (const float value : mask->values()) inside += value == 1.0F ? 1 : 0;
    QCOMPARE(inside, stats["voxels_inside"].toInteger());
  }
  // A binary STL: 80 bytes, a count, 50 bytes a triangle.
  const QByteArray stl = bytes_of(folder_ / "mask.stl");
  QVERIFY(stl.size() > 84 + 50 * 1000);
  QCOMPARE((stl.size() - 84) % 50, 0);
  QVERIFY(bytes_of(folder_ / "mask.ply").startsWith("ply"));
  QVERIFY(bytes_of(folder_ / "mask.obj").contains("\nv "));
}

void CliRunTest::info_lists_what_the_contract_names() {
  const Outcome outcome = must_run({"info", text(folder_ / "sphere"), "--json"});
  const QJsonObject all = json_of(outcome.out);
  QVERIFY(all["series"].isArray() && all["skipped"].isArray());
  QJsonObject series;
  for (const auto one : all["series"].toArray()) {
    if (one.toObject()["modality"].toString() == "MR") series = one.toObject();
  }
  for (const char* key :
       {"uid", "modality", "description", "date", "files", "size", "spacing_mm", "direction", "origin_mm", "scalar",
        "transfer_syntaxes", "loadable", "reason", "changes", "warnings"}) {
    QVERIFY2(series.contains(key), key);
  }
  QCOMPARE(series["files"].toInt(), 81);
  QCOMPARE(series["loadable"].toBool(), true);
  QCOMPARE(series["direction"].toArray(), (QJsonArray{1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}));
  QCOMPARE(series["scalar"].toString(), QString("int16"));
}

// util-linux' script gives the program a terminal.
void CliRunTest::a_terminal_gets_a_progress_bar() {
  // A machine may have no pseudo-terminals, as in a root folder without /dev/pts.
  const int terminal = ::posix_openpt(O_RDWR);
  if (terminal < 0) QSKIP("NOT TESTED: this machine has no pseudo-terminals (/dev/pts)");
  ::close(terminal);
  QProcess script;
  const QStringList command = QStringList{TIDEMARK_CLI} + sphere_arguments() + QStringList{"--steps", "20"};
  script.start("script", {"-qec", command.join(' '), "/dev/null"});
  QVERIFY2(script.waitForFinished(60'000), "script is needed (Debian: package bsdutils)");
  const QByteArray seen = script.readAllStandardOutput();
  QCOMPARE(script.exitCode(), 0);
  QVERIFY2(seen.contains(" % ") && seen.contains("[....") && seen.contains("\033[K"), seen);
}

void CliRunTest::stats_hold_what_the_contract_names() {
  const QJsonObject stats =
      json_of(must_run(sphere_arguments() + QStringList{"--steps", "20", "--json"}).out);
  for (const char* key : {"executor",
                          "steps",
                          "seconds",
                          "steps_per_second",
                          "voxel_updates",
                          "voxel_updates_per_second",
                          "converged",
                          "volume_ml",
                          "surface_mm2",
                          "voxels_inside",
                          "resident_pages",
                          "page_bytes",
                          "peak_resident_pages",
                          "size",
                          "spacing_mm",
                          "peak_page_bytes",
                          "source_bytes",
                          "page_shape",
                          "quiet_pages",
                          "paging_seconds",
                          "surface_speed",
                          "time_step",
                          "parameters",
                          "bytes_per_resident_voxel",
                          "threads"}) {
    QVERIFY2(stats.contains(key), key);
  }
  QCOMPARE(stats["steps"].toInt(), 20);
  QVERIFY(stats["bytes_per_resident_voxel"].toDouble() <= 10.0);
  QVERIFY(stats["parameters"].toObject()["alpha_paper"].toDouble() > 0.0);
}

void CliRunTest::a_resumed_run_equals_an_unbroken_one() {
  const auto out = [&](const char* name) { return QStringList{"--out", text(folder_ / name)}; };
  const QStringList whole = sphere_arguments() + QStringList{"--steps", "40"} + out("whole.nrrd");
  const QStringList first =
      sphere_arguments() + QStringList{"--steps", "20", "--out-phi", text(folder_ / "half.nrrd")};
  QStringList second = sphere_arguments() + QStringList{"--steps", "20"} + out("resumed.nrrd") +
                       QStringList{"--out-phi", text(folder_ / "end.nrrd")};
  const qsizetype seed = second.indexOf("--seed");
  second[seed] = "--init-phi";
  second[seed + 1] = text(folder_ / "half.nrrd");
  QCOMPARE(must_run(whole + QStringList{"--out-phi", text(folder_ / "whole_phi.nrrd")}).code, 0);
  QCOMPARE(must_run(first).code, 0);
  QCOMPARE(must_run(second).code, 0);
  QCOMPARE(bytes_of(folder_ / "resumed.nrrd"), bytes_of(folder_ / "whole.nrrd"));
  QCOMPARE(bytes_of(folder_ / "end.nrrd"), bytes_of(folder_ / "whole_phi.nrrd"));
}

void CliRunTest::the_start_is_a_mask_or_a_threshold_or_a_fill() {
  QStringList base = sphere_arguments();
  const qsizetype seed = base.indexOf("--seed");
  base.remove(seed, 2);
  const QString truth = text(folder_ / "sphere/truth.nii.gz");
  for (const QStringList& start : {QStringList{"--init", truth}, QStringList{"--init-threshold", "600,1000"},
                                   QStringList{"--init-flood", "40,40,40,600,1000"}}) {
    const Outcome outcome = must_run(base + start + QStringList{"--steps", "0", "--truth", truth, "--json"});
    QVERIFY2(json_of(outcome.out)["dice"].toDouble() > 0.95, outcome.told());
    QCOMPARE(json_of(outcome.out)["steps"].toInt(-1), 0);
  }
  // The exact distance transform keeps the mask as it is.
  const Outcome kept =
      must_run(base + QStringList{"--init", truth, "--steps", "0", "--truth", truth, "--json"});
  QCOMPARE(json_of(kept.out)["dice"].toDouble(), 1.0);
  const Outcome erased =
      must_run(base + QStringList{"--init", truth, "--erase", "40,40,40,10", "--steps", "0", "--json"});
  QVERIFY(json_of(erased.out)["voxels_inside"].toInt() < json_of(kept.out)["voxels_inside"].toInt() - 3000);
}

void CliRunTest::a_mask_with_other_axes_is_matched_by_its_geometry() {
  // A box, so that every flip and permutation shows; stored with j reversed and i and k exchanged.
  Volume volume = ball(Index3(12, 14, 16), 0.0);
  Mask mask{volume.geometry, std::vector<std::uint8_t>(volume.geometry.voxel_count(), 0)};
  Mask stored{volume.geometry, mask.voxels};
  stored.geometry.size = {16, 14, 12};
  stored.geometry.direction = glm::dmat3(glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0), glm::dvec3(1, 0, 0));
  stored.geometry.origin_mm = {0.0, 13.0, 0.0};
  auto& values = std::get<std::vector<std::int16_t>>(volume.voxels);
  for (std::int64_t k = 2; k < 12; ++k) {
    for (std::int64_t j = 3; j < 9; ++j) {
      for (std::int64_t i = 1; i < 8; ++i) {
        values[static_cast<std::size_t>(volume.geometry.offset({i, j, k}))] = 1000;
        stored.voxels[static_cast<std::size_t>(stored.geometry.offset({k, 13 - j, i}))] = 1;
      }
    }
  }
  QCOMPARE(failure(write_volume_file(volume, folder_ / "box.nrrd")), QString());
  QCOMPARE(failure(write_mask_file(stored, folder_ / "stored.nrrd")), QString());
  const Outcome outcome = must_run({"segment", text(folder_ / "box.nrrd"), "--target", "1000", "--range",
                                    "500", "--alpha", "1", "--init-threshold", "1000,1000", "--steps", "0",
                                    "--truth", text(folder_ / "stored.nrrd"), "--json"});
  QCOMPARE(json_of(outcome.out)["dice"].toDouble(), 1.0);
}

void CliRunTest::pictures_are_drawn_from_masks_and_fields() {
  const TemporaryFolder folder;
  const Volume volume = ball(Index3(32), 10.0);
  const auto file = folder / "ball.nrrd";
  QCOMPARE(failure(write_volume_file(volume, file)), QString());
  must_run(QStringList{"segment", text(file)} + ball_arguments(Index3(32)) +
           QStringList{"--out", text(folder / "mask.nrrd"), "--out-phi", text(folder / "phi.nrrd"),
                       "--picture", text(folder / "sheet-of-segment.png")});
  QVERIFY(bytes_of(folder / "sheet-of-segment.png").startsWith("\x89PNG"));
  const auto tf = folder / "tf.json";
  QFile file_of_tf(text(tf));
  QVERIFY(file_of_tf.open(QIODevice::WriteOnly));
  file_of_tf.write(
      R"({"relative": true, "source": [{"value": {"ramp": [0, 1]}, "opacity": 1, "colour": [1, 1, 1]}]})");
  file_of_tf.close();
  const QList<QStringList> views = {
      {"--mask", text(folder / "mask.nrrd"), "--camera", "30,20,1.2"},
      {"--phi", text(folder / "phi.nrrd"), "--clip", "0,-1,0,-16", "--opacity", "0.5"},
      {"--preset", "ct-bone", "--phi", text(folder / "phi.nrrd"), "--roi", "inside"},
      {"--mask", text(folder / "mask.nrrd"), "--view", "sagittal", "--at", "16,16,16"},
      {"--mask", text(folder / "mask.nrrd"), "--fit", "--colour", "curvature", "--occlusion", "0.5",
       "--annotate"},
      {"--mask", text(folder / "mask.nrrd"), "--clip", "0,-1,0,-16", "--clipped", "source", "--tf", text(tf)},
      {"--mask", text(folder / "mask.nrrd"), "--view", "oblique", "--normal", "1,1,0.5", "--nearest",
       "--annotate"},
      {"--view", "axial", "--labels", text(folder / "mask.nrrd")},
      {"--view", "speed", "--target", "1000", "--range", "500"},
      {"--phi", text(folder / "phi.nrrd"), "--view", "speed", "--target", "1000", "--range", "500", "--term",
       "total"},
      {"--phi", text(folder / "phi.nrrd"), "--view", "pages", "--window", "500,1000"}};
  for (const QStringList& view : views) {
    const auto picture = folder / "picture.png";
    const QJsonObject told = json_of(
        must_run(QStringList{"render", text(file), "--size", "96x64", "--json", "--out", text(picture)} +
                 view)
            .out);
    QCOMPARE(told["width"].toInt(), 96);
    const QByteArray bytes = bytes_of(picture);
    QVERIFY(bytes.startsWith("\x89PNG"));
    // The header's first chunk holds the size, most significant byte first.
    QCOMPARE(bytes.mid(16, 8), QByteArray("\0\0\0\x60\0\0\0\x40", 8));
    QVERIFY2(bytes.size() > 300, "an even picture");
  }
  // Three columns and two rows share the sheet, with two pixels between them.
  const auto sheet = folder / "sheet.png";
  const QJsonObject told =
      json_of(must_run({"render", text(file), "--mask", text(folder / "mask.nrrd"), "--view", "sheet",
                        "--size", "300x200", "--json", "--out", text(sheet)})
                  .out);
  QCOMPARE(told["width"].toInt(), 298);
  QCOMPARE(told["height"].toInt(), 200);
}

void CliRunTest::host_and_reference_agree() {
  const QStringList steps{"--steps", "30", "--json"};
  const auto host = json_of(must_run(sphere_arguments() + steps + QStringList{"--executor", "host"}).out);
  const auto truth =
      json_of(must_run(sphere_arguments() + steps + QStringList{"--executor", "reference"}).out);
  QCOMPARE(host["executor"].toString(), QString("host"));
  QCOMPARE(truth["executor"].toString(), QString("reference"));
  const double difference = host["volume_ml"].toDouble() - truth["volume_ml"].toDouble();
  QVERIFY(std::abs(difference) <= 0.001 * truth["volume_ml"].toDouble());
}

void CliRunTest::each_term_can_be_switched_off() {
  const QStringList steps{"--steps", "20", "--json"};
  const auto inside = [&](const QStringList& more) {
    return json_of(must_run(sphere_arguments() + steps + more).out)["voxels_inside"].toInt();
  };
  const int seed =
      json_of(must_run(sphere_arguments() + QStringList{"--steps", "0", "--json"}).out)["voxels_inside"]
          .toInt();
  QVERIFY(inside({}) > seed);                                                     // grows
  QVERIFY(inside({"--no-data"}) < seed);                                          // shrinks under curvature
  QVERIFY(std::abs(inside({"--no-data", "--no-curvature"}) - seed) < seed / 20);  // stays
}

void CliRunTest::an_automatic_start_says_what_it_chose() {
  const Outcome outcome =
      must_run({"segment", text(folder_ / "sphere/series"), "--auto-start", "--truth",
                text(folder_ / "sphere/truth.nii.gz"), "--stats", text(folder_ / "auto.json")});
  for (const char* option : {"--seed", "--target", "--range", "--alpha"}) {
    QVERIFY2(outcome.out.contains(QByteArray("Chose      ") + option), outcome.told());
  }
  QVERIFY2(json_of(bytes_of(folder_ / "auto.json"))["dice"].toDouble() > 0.9, outcome.told());
  const Outcome given = must_run(
      {"segment", text(folder_ / "sphere/series"), "--auto-start", "--target", "790", "--steps", "1"});
  QVERIFY2(!given.out.contains("--target") && given.out.contains("Chose      --range"), given.told());
}

void CliRunTest::distance_is_signed_and_in_millimetres() {
  Volume volume = ball(Index3(32), 9.5);
  volume.geometry.spacing_mm = glm::dvec3(2.0);
  QCOMPARE(failure(write_mask_file(ball_mask(volume), folder_ / "ball.nii.gz")), QString());
  const Outcome outcome = must_run({"distance", text(folder_ / "ball.nii.gz"), "--band", "4", "--out",
                                    text(folder_ / "distance.nrrd"), "--json"});
  QCOMPARE(json_of(outcome.out)["band_mm"].toDouble(), 8.0);
  const auto distance = read_volume_file(folder_ / "distance.nrrd");
  QCOMPARE(failure(distance), QString());
  const glm::dvec3 middle(15.5);
  double worst = 0.0;
  for (std::int64_t i = 0; i < 32; ++i) {
    const double exact = 2.0 * (9.5 - glm::length(glm::dvec3(i, 15, 15) - middle));
    const double found = distance->value(Index3(i, 15, 15));
    worst = std::max(worst, std::abs(found - std::clamp(exact, -8.0, 8.0)));
  }
  QVERIFY2(worst < 1.0, qPrintable(QString("half a voxel is 1 mm; worst %1 mm").arg(worst)));
}

void CliRunTest::formats_keep_values_and_geometry() {
  Volume volume = ball(Index3(9, 10, 11), 3.0);
  volume.geometry.spacing_mm = {0.5, 0.75, 2.0};
  volume.geometry.origin_mm = {-12.5, 30.25, 7.0};
  QCOMPARE(failure(write_dicom_series(volume, {}, folder_ / "oblong")), QString());
  QString from = text(folder_ / "oblong");
  for (const char* name : {"a.nii.gz", "b.nrrd", "c.mha", "d.nii"}) {
    QCOMPARE(must_run({"convert", from, "--out", text(folder_ / name)}).code, 0);
    const auto read = read_volume_file(folder_ / name);
    QCOMPARE(failure(read), QString());
    QVERIFY(same_grid(read->geometry, volume.geometry, 1e-3));
    QCOMPARE(read->values(), volume.values());
    from = text(folder_ / name);
  }
}

void CliRunTest::a_mask_becomes_a_surface() {
  const Outcome outcome = must_run({"convert", text(folder_ / "sphere/truth.nii.gz"), "--out",
                                    text(folder_ / "truth.stl"), "--out", text(folder_ / "truth.obj")});
  QVERIFY2(outcome.out.contains("Surface "), outcome.told());
  QVERIFY(bytes_of(folder_ / "truth.stl").size() > 84 + 50 * 1000);
  const Outcome labels = must_run(
      {"convert", text(folder_ / "sphere/series"), "--mask", "--out", text(folder_ / "nonzero.nii.gz")});
  QCOMPARE(labels.code, 0);
}

// The locale is made here: machines have few of them installed.
void CliRunTest::a_german_locale_changes_nothing() {
  QProcess localedef;
  localedef.start("localedef", {"-i", "de_DE", "-f", "UTF-8", text(folder_ / "de_DE.UTF-8")});
  QVERIFY2(localedef.waitForFinished(60'000), "localedef is needed (Debian: package locales)");
  RunOptions german;
  german.environment.insert("LOCPATH", text(folder_.path()));
  german.environment.insert("LC_ALL", "de_DE.UTF-8");
  QProcess locale;
  locale.setProcessEnvironment(german.environment);
  locale.start("locale", {"decimal_point"});
  QVERIFY(locale.waitForFinished());
  QCOMPARE(locale.readAllStandardOutput(), QByteArray(",\n"));
  RunOptions plain;
  plain.environment.insert("LC_ALL", "C");

  const auto arguments = [&](const char* name) {
    const std::string stem = name;
    return sphere_arguments() + QStringList{"--steps",   "15",
                                            "--smooth",  "1.25",
                                            "--seed-mm", "-1.5,0.25,2,6.5",
                                            "--out",     text(folder_ / (stem + ".nrrd")),
                                            "--out",     text(folder_ / (stem + ".obj")),
                                            "--out-phi", text(folder_ / (stem + "_phi.nii")),
                                            "--json"};
  };
  QJsonObject one = json_of(must_run(arguments("german"), german).out);
  QJsonObject other = json_of(must_run(arguments("plain"), plain).out);
  QVERIFY(one["volume_ml"].toDouble() > 1.0);
  for (const char* key : {"seconds", "steps_per_second", "voxel_updates_per_second", "paging_seconds"}) {
    one.remove(key);
    other.remove(key);
  }
  QCOMPARE(one, other);
  for (const char* end : {".nrrd", ".obj", "_phi.nii"}) {
    QCOMPARE(bytes_of(folder_ / (std::string("german") + end)),
             bytes_of(folder_ / (std::string("plain") + end)));
  }
}

void CliRunTest::thin_volumes_are_segmented_data() {
  QTest::addColumn<int>("axis");
  QTest::addColumn<int>("length");
  for (const int axis : {0, 1, 2}) {
    for (const int length : {1, 7, 61, 175}) {
      QTest::addRow("%d voxels along axis %d", length, axis) << axis << length;
    }
  }
}

void CliRunTest::thin_volumes_are_segmented() {
  QFETCH(int, axis);
  QFETCH(int, length);
  Index3 size(20);
  size[axis] = length;
  const Volume volume = ball(size, 7.0);
  QCOMPARE(failure(write_volume_file(volume, folder_ / "thin.nrrd")), QString());
  QCOMPARE(failure(write_mask_file(ball_mask(volume), folder_ / "thin_truth.nrrd")), QString());
  const Outcome outcome = must_run(QStringList{"segment", text(folder_ / "thin.nrrd"), "--steps", "60",
                                               "--truth", text(folder_ / "thin_truth.nrrd"), "--out",
                                               text(folder_ / "thin_mask.nii.gz"), "--json"} +
                                   ball_arguments(size));
  QVERIFY2(json_of(outcome.out)["dice"].toDouble() > 0.9, outcome.told());
}

void CliRunTest::a_series_of_two_slices_is_segmented() {
  const Volume volume = ball(Index3(32, 32, 2), 9.0);
  QCOMPARE(failure(write_dicom_series(volume, {}, folder_ / "two")), QString());
  const Outcome outcome =
      must_run(QStringList{"segment", text(folder_ / "two"), "--steps", "60", "--out",
                           text(folder_ / "two.nrrd"), "--out", text(folder_ / "two.stl"), "--json"} +
               ball_arguments(volume.geometry.size));
  const auto truth = static_cast<double>(ball_mask(volume).count());
  QVERIFY2(std::abs(json_of(outcome.out)["voxels_inside"].toDouble() - truth) < 0.15 * truth, outcome.told());
}

void CliRunTest::bench_prints_its_figures() {
  const Outcome outcome = must_run({"bench", "--case", "sphere", "--size", "32", "--steps", "10", "--json"});
  const QJsonObject figures = json_of(outcome.out);
  QCOMPARE(figures["stages"].toArray().size(), 5);
  const QJsonObject early = figures["stages"].toArray().first().toObject();
  QCOMPARE(early["steps"].toInt(), 10);
  QVERIFY(early["steps_per_second"].toDouble() > 0.0 && early["voxel_updates_per_second"].toDouble() > 0.0);
  QVERIFY(figures["bytes_per_resident_voxel"].toDouble() <= 10.0);
}

QTEST_GUILESS_MAIN(CliRunTest)
#include "cli_run_test.moc"
