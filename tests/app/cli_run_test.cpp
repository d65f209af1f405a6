// The main job from end to end.
#include <QJsonArray>
#include <cmath>

#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_run_test {

class CliRunTest : public QObject {
  Q_OBJECT

 private slots:
  void a_sphere_phantom_is_found_segmented_and_measured();
  void stats_hold_what_the_contract_names();
  void what_has_become_of_the_surface_is_said_data();
  void what_has_become_of_the_surface_is_said();
  void a_range_that_is_too_narrow_is_told();
  void the_next_command_is_one_for_a_shell();
  void figures_name_the_series_that_was_found();
  void host_and_reference_agree();
  void each_term_can_be_switched_off();
  void thin_volumes_are_segmented_data();
  void thin_volumes_are_segmented();
  void a_series_of_two_slices_is_segmented();
  void bench_prints_its_figures();

 private:
  TemporaryFolder folder_;
  const SphereStudy sphere_;
};

void CliRunTest::a_sphere_phantom_is_found_segmented_and_measured() {
  QStringList arguments =
      sphere_.arguments() +
      QStringList{
          "--converge", "--truth", text(sphere_ / "truth.nii.gz"), "--stats", text(folder_ / "stats.json"),
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
  const QJsonObject distance = stats["truth_distance"].toObject();
  QVERIFY2(distance["mean_mm"].toDouble() > 0.0 && distance["mean_mm"].toDouble() < 1.0, outcome.told());
  QVERIFY(distance["hausdorff95_mm"].toDouble() >= distance["mean_mm"].toDouble());
  QVERIFY(distance["hausdorff_mm"].toDouble() >= distance["hausdorff95_mm"].toDouble());

  const auto truth = imaging::read_volume_file(sphere_ / "truth.nii.gz");
  const auto series = must_run({"info", text(sphere_ / "series"), "--json"});
  const QJsonObject found = json_of(series.out)["series"].toArray().first().toObject();
  for (const QString& name : names.mid(0, 4)) {
    const auto mask = imaging::read_volume_file(folder_ / name.toStdString());
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

void CliRunTest::stats_hold_what_the_contract_names() {
  const QJsonObject stats =
      json_of(must_run(sphere_.arguments() + QStringList{"--steps", "20", "--json"}).out);
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
                          "moving_pages",
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

void CliRunTest::what_has_become_of_the_surface_is_said_data() {
  QTest::addColumn<QStringList>("arguments");
  QTest::addColumn<QString>("outcome");
  QTest::addColumn<QString>("steps_line");
  QTest::addColumn<QString>("warning");
  QTest::newRow("converged") << QStringList{"--alpha", "0.8"} << "converged"
                             << "stopped moving"
                             << "";
  QTest::newRow("unfinished") << QStringList{"--steps", "5"} << "unfinished"
                              << "not converged"
                              << "";
  QTest::newRow("still moving") << QStringList{"--max-steps", "64"} << "unfinished"
                                << "not converged"
                                << "still moving after 64 steps (--max-steps), at voxel";
  QTest::newRow("vanished") << QStringList{"--alpha", "0"} << "vanished"
                            << "vanished"
                            << "--range or --alpha";
  const QStringList no_tent{"--target", "", "--range", "", "--speed", "edges"};
  QTest::newRow("vanished, without a range") << no_tent + QStringList{"--alpha", "0"} << "vanished"
                                             << "vanished"
                                             << "another --speed or --alpha";
  QTest::newRow("seeded outside") << QStringList{"--target", "5000"} << "seeded_outside"
                                  << "outside of what"
                                  << "no value where it began is within 5000";
  QTest::newRow("filled") << QStringList{"--range", "9000"} << "filled_volume"
                          << "filled"
                          << "smaller --range";
}

void CliRunTest::what_has_become_of_the_surface_is_said() {
  QFETCH(QStringList, arguments);
  QFETCH(QString, outcome);
  QFETCH(QString, steps_line);
  QFETCH(QString, warning);
  QStringList all = sphere_.arguments();
  for (qsizetype i = 0; i < arguments.size(); i += 2) {
    const auto at = all.indexOf(arguments[i]);
    if (arguments[i + 1].isEmpty()) {
      all.remove(at, 2);
    } else if (at >= 0) {
      all[at + 1] = arguments[i + 1];
    } else {
      all += {arguments[i], arguments[i + 1]};
    }
  }
  const Outcome told = run_cli(all);
  QCOMPARE(told.code, 0);
  QVERIFY2(told.out.contains(steps_line.toUtf8()), told.told());
  QVERIFY2(told.err.contains(warning.toUtf8()) && told.err.isEmpty() == warning.isEmpty(), told.told());
  const bool has_pace = outcome == "converged" || outcome == "unfinished";
  QCOMPARE(told.out.contains("steps/s"), has_pace);
  const QJsonObject stats = json_of(run_cli(all + QStringList{"--json"}).out);
  QCOMPARE(stats["outcome"].toString(), outcome);
  QCOMPARE(stats["converged"].toBool(), outcome != "unfinished");
  QCOMPARE(stats["steps_per_second"].isNull(), !has_pace);
  QCOMPARE(stats["voxel_updates_per_second"].isNull(), !has_pace);
  QVERIFY(stats["wider_range"].isNull());
}

void CliRunTest::a_range_that_is_too_narrow_is_told() {
  TemporaryFolder folder;
  must_run({"phantom", "tumour", "--out", text(folder / "tumour")});
  const QStringList narrow{"segment",  text(folder / "tumour" / "series"),
                           "--target", "750",
                           "--range",  "16.5",
                           "--alpha",  "0.95",
                           "--seed",   "162,114,99,9"};
  const Outcome told = must_run(narrow);
  QVERIFY2(told.out.contains("Hint ") && told.out.contains("--range 16.5; try "), told.told());
  const double wider = json_of(must_run(narrow + QStringList{"--json"}).out)["wider_range"].toDouble();
  QVERIFY2(wider > 30.0 && wider < 110.0, qPrintable(QString::number(wider)));
}

void CliRunTest::the_next_command_is_one_for_a_shell() {
  TemporaryFolder folder;
  RunOptions here;
  here.folder = text(folder.path());
  const QByteArray said = must_run({"phantom", "sphere", "--out", "anna's study"}, here).out;
  const auto next = said.indexOf("Next       ");
  QVERIFY2(next >= 0, said);
  const QString command = QString::fromUtf8(said.mid(next + 11)).trimmed() + " --steps 1";
  QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
  const std::filesystem::path program = cli_program().toStdString();
  environment.insert("PATH", text(program.parent_path()) + ":" + environment.value("PATH"));
  QProcess shell;
  shell.setProcessEnvironment(environment);
  shell.setWorkingDirectory(here.folder);
  shell.start("sh", {"-c", command});
  QVERIFY(shell.waitForFinished(60'000));
  QVERIFY2(shell.exitCode() == 0, shell.readAllStandardError());
  QVERIFY(std::filesystem::exists(folder / "anna's study" / "mask.nii.gz"));
}

void CliRunTest::figures_name_the_series_that_was_found() {
  const auto series = must_run({"info", text(sphere_ / "series"), "--json"});
  const QString uid = json_of(series.out)["series"].toArray().first().toObject()["uid"].toString();
  QVERIFY(!uid.isEmpty());
  const QJsonObject stats =
      json_of(must_run(sphere_.arguments() + QStringList{"--steps", "1", "--json"}).out);
  QCOMPARE(stats["series_uid"].toString(), uid);
}

void CliRunTest::host_and_reference_agree() {
  const QStringList steps{"--steps", "30", "--json"};
  const auto host = json_of(must_run(sphere_.arguments() + steps + QStringList{"--executor", "host"}).out);
  const auto truth =
      json_of(must_run(sphere_.arguments() + steps + QStringList{"--executor", "reference"}).out);
  QCOMPARE(host["executor"].toString(), QString("host"));
  QCOMPARE(truth["executor"].toString(), QString("reference"));
  const double difference = host["volume_ml"].toDouble() - truth["volume_ml"].toDouble();
  QVERIFY(std::abs(difference) <= 0.001 * truth["volume_ml"].toDouble());
}

void CliRunTest::each_term_can_be_switched_off() {
  const QStringList steps{"--steps", "20", "--json"};
  const auto inside = [&](const QStringList& more) {
    return json_of(must_run(sphere_.arguments() + steps + more).out)["voxels_inside"].toInt();
  };
  const int seed =
      json_of(must_run(sphere_.arguments() + QStringList{"--steps", "0", "--json"}).out)["voxels_inside"]
          .toInt();
  QVERIFY(inside({}) > seed);                                                     // grows
  QVERIFY(inside({"--no-data"}) < seed);                                          // shrinks under curvature
  QVERIFY(std::abs(inside({"--no-data", "--no-curvature"}) - seed) < seed / 20);  // stays
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
  QCOMPARE(failure(imaging::write_volume_file(volume, folder_ / "thin.nrrd")), QString());
  QCOMPARE(failure(imaging::write_mask_file(ball_mask(volume), folder_ / "thin_truth.nrrd")), QString());
  const Outcome outcome = must_run(QStringList{"segment", text(folder_ / "thin.nrrd"), "--steps", "60",
                                               "--truth", text(folder_ / "thin_truth.nrrd"), "--out",
                                               text(folder_ / "thin_mask.nii.gz"), "--json"} +
                                   ball_arguments(size));
  QVERIFY2(json_of(outcome.out)["dice"].toDouble() > 0.9, outcome.told());
}

void CliRunTest::a_series_of_two_slices_is_segmented() {
  const Volume volume = ball(Index3(32, 32, 2), 9.0);
  QCOMPARE(failure(imaging::write_dicom_series(volume, {}, folder_ / "two")), QString());
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

TIDEMARK_TEST(CliRunTest)

}  // namespace tidemark::test::cli_run_test

#include "cli_run_test.moc"
