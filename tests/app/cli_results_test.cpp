// DICOM segmentations, RT structure sets and OpenVDB level sets on the command line.
#include <signal.h>

#include <QJsonArray>
#include <algorithm>
#include <memory>

#include "imaging/dicom/dicom.h"
#include "imaging/files/png_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "imaging/results/results.h"
#include "tests/app/cli_runner.h"
#include "tests/app/folder_events.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_results_test {

class CliResultsTest : public QObject {
  Q_OBJECT

 private slots:
  void init();
  void segment_writes_results_that_segment_starts_from();
  void a_volume_file_makes_an_anonymous_study_and_says_so();
  void labels_go_out_and_in_again();
  void each_label_becomes_a_surface_in_a_file_of_its_own();
  void a_saved_level_set_becomes_what_others_read();
  void a_structure_set_needs_its_study();
  void wrong_usage_is_told_data();
  void wrong_usage_is_told();
  void a_study_is_never_written_to();
  void what_is_read_of_a_folder_is_never_written_to();
  void a_full_disk_keeps_the_older_results_data();
  void a_full_disk_keeps_the_older_results();
  void a_kill_leaves_the_old_file_or_the_new_one();

 private:
  [[nodiscard]] QStringList arguments(const QString& command, const std::filesystem::path& input) const {
    return {command, text(input)};
  }
  [[nodiscard]] QString path(const char* name) const { return text(*folder_ / name); }
  // A ball of 24^3 voxels as a DICOM series in folder_/series.
  Volume write_series() const;

  std::unique_ptr<TemporaryFolder> folder_;
};

void CliResultsTest::init() {
  folder_ = std::make_unique<TemporaryFolder>();
}

Volume CliResultsTest::write_series() const {
  Volume volume = ball(Index3(24), 8.0);
  const Status written = imaging::write_dicom_series(volume, {}, *folder_ / "series");
  if (!written) qFatal("%s", written.error().message.c_str());
  return volume;
}

void CliResultsTest::segment_writes_results_that_segment_starts_from() {
  write_series();
  const Outcome first =
      run_cli(QStringList{"segment", path("series"), "--steps", "20", "--out", path("seg.dcm"), "--out",
                          path("mask.nrrd"), "--rtstruct", path("set.dcm"), "--out-phi", path("phi.vdb"),
                          "--label", "Ball,tumour,ff8000"} +
              ball_arguments(Index3(24)));
  QVERIFY2(first.code == 0, first.told());
  QVERIFY2(!first.out.contains("anonymous"), first.told());
  for (const char* name : {"seg.dcm", "mask.nrrd", "set.dcm", "phi.vdb"}) {
    QVERIFY2(first.out.contains("Wrote      " + path(name).toUtf8()), first.told());
  }
  const auto mask = imaging::load_mask(*folder_ / "mask.nrrd");
  QCOMPARE(failure(mask), QString());
  QVERIFY(mask->count() > 1000);
  for (const char* name : {"seg.dcm", "set.dcm"}) {
    const auto read = imaging::read_result(*folder_ / name, &mask->geometry);
    QCOMPARE(failure(read), QString());
    QCOMPARE(read->list.size(), std::size_t{1});
    QCOMPARE(read->list[0].name, std::string("Ball"));
    QVERIFY(read->list[0].colour == imaging::SegmentColour({255, 128, 0}));
    QVERIFY(imaging::union_of(*read).voxels == mask->voxels);

    const Outcome again = run_cli(QStringList{
        "segment", path("series"), "--target", "1000", "--range", "500", "--alpha", "0.8", "--init",
        path(name), "--steps", "0", "--truth", path("mask.nrrd"), "--json", "--out", path("again.nrrd")});
    QVERIFY2(again.code == 0, again.told());
    const auto same = imaging::load_mask(*folder_ / "again.nrrd");
    QCOMPARE(failure(same), QString());
    QVERIFY(same->voxels == mask->voxels);
  }
  const auto seg = imaging::read_segmentation(*folder_ / "seg.dcm");
  QCOMPARE(seg->list[0].meaning.type.meaning, std::string("Neoplasm"));
}

void CliResultsTest::a_volume_file_makes_an_anonymous_study_and_says_so() {
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(24), 8.0), *folder_ / "ball.nrrd")), QString());
  const Outcome outcome =
      run_cli(QStringList{"segment", path("ball.nrrd"), "--steps", "5", "--out", path("seg.dcm")} +
              ball_arguments(Index3(24)));
  QVERIFY2(outcome.code == 0, outcome.told());
  QVERIFY2(outcome.out.contains("anonymous patient"), outcome.told());
  QVERIFY(imaging::result_form_of(*folder_ / "seg.dcm") == imaging::ResultForm::segmentation);
}

void CliResultsTest::labels_go_out_and_in_again() {
  Volume labels = write_series();
  auto& values = std::get<std::vector<std::int16_t>>(labels.voxels);
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = values[v] == 0 ? 0 : v % 24 < 12 ? 3 : 7;
  QCOMPARE(failure(imaging::write_volume_file(labels, *folder_ / "labels.nii.gz")), QString());
  const Outcome out = run_cli({"convert", path("labels.nii.gz"), "--labels", "--source", path("series"),
                               "--label", "Left,liver", "--label", "Right,,0000ff", "--out", path("seg.dcm"),
                               "--rtstruct", path("set.dcm"), "--out", path("both.stl"), "--json"});
  QVERIFY2(out.code == 0, out.told());
  const QJsonArray segments = json_of(out.out)["segments"].toArray();
  QCOMPARE(segments.size(), 2);
  QCOMPARE(segments[1].toObject()["name"].toString(), QString("Right"));
  for (const char* name : {"seg.dcm", "set.dcm"}) {
    const Outcome in =
        run_cli({"convert", path(name), "--source", path("series"), "--out", path("back.nrrd"), "--json"});
    QVERIFY2(in.code == 0, in.told());
    const auto back = imaging::load_volume(*folder_ / "back.nrrd");
    QCOMPARE(failure(back), QString());
    for (std::int64_t v = 0; v < back->geometry.voxel_count(); ++v) {
      const float was = labels.value(v);
      QCOMPARE(back->value(v), was == 3.0F ? 1.0F : was == 7.0F ? 2.0F : 0.0F);
    }
  }
  const Outcome mask = run_cli({"convert", path("seg.dcm"), "--mask", "--out", path("mask.nrrd")});
  QVERIFY2(mask.code == 0, mask.told());
  QCOMPARE(failure(imaging::load_mask(*folder_ / "mask.nrrd")), QString());
}

void CliResultsTest::each_label_becomes_a_surface_in_a_file_of_its_own() {
  Volume labels = ball(Index3(24), 8.0);
  auto& values = std::get<std::vector<std::int16_t>>(labels.voxels);
  for (std::size_t v = 0; v < values.size(); ++v) values[v] = values[v] == 0 ? 0 : v % 24 < 12 ? 3 : 7;
  QCOMPARE(failure(imaging::write_volume_file(labels, *folder_ / "labels.nii.gz")), QString());
  const Outcome out = run_cli({"convert", path("labels.nii.gz"), "--labels", "--label", "Left", "--out-each",
                               path("halves.ply"), "--json"});
  QVERIFY2(out.code == 0, out.told());
  const QJsonArray files = json_of(out.out)["out_each"].toArray();
  QCOMPARE(files, QJsonArray({path("halves-Left.ply"), path("halves-Segment 7.ply")}));
  const auto size = [&](const char* name) { return bytes_of(*folder_ / name).size(); };
  QVERIFY(size("halves-Left.ply") > 10'000);
  QVERIFY(std::abs(size("halves-Left.ply") - size("halves-Segment 7.ply")) < size("halves-Left.ply") / 2);
  QVERIFY(!std::filesystem::exists(*folder_ / "halves.ply"));
  const Outcome wrong = run_cli({"convert", path("labels.nii.gz"), "--labels", "--out-each", path("a.nii")});
  QCOMPARE(wrong.code, 2);
  QVERIFY2(wrong.err.contains("--out-each") && wrong.err.contains(".stl"), wrong.told());
  const Outcome plain = run_cli({"convert", path("labels.nii.gz"), "--out-each", path("a.stl")});
  QCOMPARE(plain.code, 2);
}

void CliResultsTest::a_saved_level_set_becomes_what_others_read() {
  write_series();
  const Outcome made =
      run_cli(QStringList{"segment", path("series"), "--steps", "20", "--out", path("mask.nrrd"), "--out-phi",
                          path("phi.nrrd"), "--rtstruct", path("one.dcm")} +
              ball_arguments(Index3(24)));
  QVERIFY2(made.code == 0, made.told());
  const Outcome outcome =
      run_cli({"convert", path("phi.nrrd"), "--phi", "--source", path("series"), "--out", path("phi.vdb"),
               "--out", path("seg.dcm"), "--rtstruct", path("two.dcm"), "--out", path("ball.stl")});
  QVERIFY2(outcome.code == 0, outcome.told());
  const auto mask = imaging::load_mask(*folder_ / "mask.nrrd");
  for (const char* name : {"seg.dcm", "one.dcm", "two.dcm"}) {
    const auto read = imaging::read_result(*folder_ / name, &mask->geometry);
    QCOMPARE(failure(read), QString());
    QVERIFY(imaging::union_of(*read).voxels == mask->voxels);
  }
  QVERIFY(bytes_of(*folder_ / "phi.vdb").size() > 1000);
}

void CliResultsTest::a_structure_set_needs_its_study() {
  write_series();
  const Outcome made =
      run_cli(QStringList{"segment", path("series"), "--steps", "5", "--rtstruct", path("set.dcm")} +
              ball_arguments(Index3(24)));
  QVERIFY2(made.code == 0, made.told());
  const Outcome refused = run_cli({"convert", path("set.dcm"), "--out", path("mask.nrrd")});
  QVERIFY2(refused.failed_in_one_line(3), refused.told());
  QVERIFY2(refused.err.contains("set.dcm") && refused.err.contains("study"), refused.told());
}

void CliResultsTest::wrong_usage_is_told_data() {
  QTest::addColumn<QStringList>("options");
  QTest::addColumn<QByteArray>("names");
  QTest::newRow("a meaning that is none")
      << QStringList{"--out", "x.dcm", "--label", "A,gizmo"} << QByteArray("gizmo");
  QTest::newRow("a colour that is none")
      << QStringList{"--out", "x.dcm", "--label", "A,liver,red"} << QByteArray("red");
  QTest::newRow("another suffix") << QStringList{"--rtstruct", "x.nii"} << QByteArray(".dcm");
  QTest::newRow("too many labels") << QStringList{"--out", "x.dcm", "--label", "A", "--label", "B"}
                                   << QByteArray("2 times for 1");
  QTest::newRow("two kinds") << QStringList{"--out", "x.dcm", "--mask", "--phi"} << QByteArray("--phi");
  QTest::newRow("nothing to write") << QStringList{"--mask"} << QByteArray("--out");
}

void CliResultsTest::wrong_usage_is_told() {
  QFETCH(QStringList, options);
  QFETCH(QByteArray, names);
  QCOMPARE(failure(imaging::write_mask_file(ball_mask(ball(Index3(8), 3.0)), *folder_ / "mask.nrrd")),
           QString());
  RunOptions here;
  here.folder = text(folder_->path());
  const Outcome outcome = run_cli(QStringList{"convert", "mask.nrrd"} + options, here);
  QCOMPARE(outcome.code, 2);
  QVERIFY2(outcome.err.contains(names), outcome.told());
  QCOMPARE(names_in(folder_->path()), QStringList{"mask.nrrd"});
}

// By whatever file of it the study was named. What a command has written before is no study.
void CliResultsTest::a_study_is_never_written_to() {
  write_series();
  const QStringList slices = names_in(*folder_ / "series");
  const QString slice = text(*folder_ / "series" / slices[3].toStdString());
  const QByteArray before = bytes_of(slice.toStdString());
  const auto segment = [&](const QString& input, const QString& out) {
    return run_cli(QStringList{"segment", input, "--steps", "2", "--out", out} + ball_arguments(Index3(24)));
  };
  const QString result = text(*folder_ / "series" / "seg.dcm");
  for (int turn = 0; turn < 2; ++turn) QCOMPARE(segment(path("series"), result).code, 0);
  const QString other = text(*folder_ / "series" / slices[5].toStdString());
  for (const Outcome& outcome :
       {segment(path("series"), slice), segment(other, slice),
        run_cli({"convert", path("series"), "--mask", "--out", path("mask.nrrd"), "--rtstruct", slice}),
        run_cli({"measure", path("series"), result, "--labels", "--report", slice})}) {
    QVERIFY2(outcome.failed_in_one_line(2) && outcome.err.contains("never written to"), outcome.told());
  }
  QCOMPARE(bytes_of(slice.toStdString()), before);
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(24), 8.0), *folder_ / "ball.nrrd")), QString());
  const Outcome onto_grid =
      run_cli({"compare", result, result, "--grid", path("ball.nrrd"), "--staple", path("ball.nrrd")});
  QVERIFY2(onto_grid.failed_in_one_line(2) && onto_grid.err.contains("read and written at once"),
           onto_grid.told());
}

// What else lies there is replaced.
void CliResultsTest::what_is_read_of_a_folder_is_never_written_to() {
  for (const char* name : {"study", "masks", "pictures"}) std::filesystem::create_directory(*folder_ / name);
  const auto ct = *folder_ / "study/ct.nrrd";
  const auto mask = *folder_ / "masks/mask.nrrd";
  const auto picture = *folder_ / "pictures/a.png";
  const auto recipe = path("recipe.json");
  const Volume volume = ball(Index3(24), 8.0);
  QCOMPARE(failure(imaging::write_volume_file(volume, ct)), QString());
  QCOMPARE(failure(imaging::write_mask_file(ball_mask(volume), mask)), QString());
  std::vector<std::uint8_t> pixels(4 * 16 * 16);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint8_t>(i);
  QCOMPARE(failure(imaging::write_png_file(16, 16, pixels, picture)), QString());
  const QStringList segment =
      QStringList{"segment", path("study"), "--steps", "2"} + ball_arguments(Index3(24));
  must_run(segment + QStringList{"--recipe", recipe});
  const std::filesystem::path inputs[] = {ct, mask, picture};
  QList<QByteArray> before;
  for (const auto& input : inputs) before.append(bytes_of(input));
  for (const QStringList& command :
       {segment + QStringList{"--out", text(ct)},
        segment + QStringList{"--init", path("masks"), "--out", text(mask)},
        {"replay", recipe, path("study"), "--out", text(ct)},
        {"convert", path("study"), "--out", text(ct)},
        {"convert", text(mask), "--source", path("study"), "--out", text(ct)},
        {"distance", path("masks"), "--out", text(mask)},
        {"compare", path("masks"), path("masks"), "--staple", text(mask)},
        {"ai", "segment", "main", path("study"), "--model", "any", "--out", text(ct)},
        {"render", path("pictures"), "--view", "axial", "--out", text(picture)}}) {
    const Outcome outcome = run_cli(command);
    QVERIFY2(outcome.failed_in_one_line(2) && outcome.err.contains("read and written at once"),
             outcome.told());
  }
  for (qsizetype n = 0; n < before.size(); ++n) QCOMPARE(bytes_of(inputs[n]), before[n]);
  const QString result = text(*folder_ / "study/mask.nrrd");
  for (int turn = 0; turn < 2; ++turn) QCOMPARE(must_run(segment + QStringList{"--out", result}).code, 0);
  QCOMPARE(bytes_of(ct), before[0]);
}

void CliResultsTest::a_full_disk_keeps_the_older_results_data() {
  QTest::addColumn<qint64>("room");
  for (const qint64 room : {0, 100, 1000, 4000}) QTest::newRow(qPrintable(QString::number(room))) << room;
}

void CliResultsTest::a_full_disk_keeps_the_older_results() {
  QFETCH(qint64, room);
  QCOMPARE(failure(imaging::write_mask_file(ball_mask(ball(Index3(64), 20.0)), *folder_ / "mask.nii.gz")),
           QString());
  const auto out = *folder_ / "out";
  std::filesystem::create_directory(out);
  for (const QStringList& what : {QStringList{"--out", text(out / "r.dcm")},
                                  {"--rtstruct", text(out / "r.dcm")},
                                  {"--out", text(out / "r.vdb")}}) {
    const QStringList command = QStringList{"convert", path("mask.nii.gz")} + what;
    const Outcome first = run_cli(command);
    QVERIFY2(first.code == 0, first.told());
    const QStringList names = names_in(out);
    const QByteArray before = bytes_of(out / names.back().toStdString());
    RunOptions full;
    full.largest_file = room;
    const Outcome second = run_cli(command, full);
    QVERIFY2(second.failed_in_one_line(5), second.told());
    QVERIFY2(second.err.contains(what.back().toUtf8()) && !second.err.contains(".tidemark-"), second.told());
    QCOMPARE(names_in(out), names);
    QCOMPARE(bytes_of(out / names.back().toStdString()), before);
    std::filesystem::remove(out / names.back().toStdString());
  }
}

void CliResultsTest::a_kill_leaves_the_old_file_or_the_new_one() {
  Mask mask = ball_mask(ball(Index3(128), 50.0));
  QCOMPARE(failure(imaging::write_mask_file(mask, *folder_ / "mask.nii.gz")), QString());
  const QStringList command{"convert",       path("mask.nii.gz"), "--out",
                            path("seg.dcm"), "--rtstruct",        path("set.dcm")};
  const Outcome first = run_cli(command);
  QVERIFY2(first.code == 0, first.told());
  QByteArray seg = bytes_of(*folder_ / "seg.dcm");
  QByteArray set = bytes_of(*folder_ / "set.dcm");
  int killed = 0;
  for (int delay = 0; delay < 2000; delay += 40) {
    FolderEvents written(folder_->path(), IN_MODIFY);
    const auto has_begun = [&] {
      const QStringList names = written.by_name().keys();
      return std::any_of(names.begin(), names.end(),
                         [](const QString& name) { return name.startsWith(".tidemark-"); });
    };
    QProcess process;
    process.start(cli_program(), command);
    QVERIFY(process.waitForStarted());
    bool ended = false;
    while (!ended && !has_begun()) ended = process.waitForFinished(1);
    if (ended || process.waitForFinished(delay)) {
      if (killed > 0) break;  // it is too fast for more
    } else {
      ::kill(static_cast<pid_t>(process.processId()), SIGKILL);
      QVERIFY(process.waitForFinished());
      ++killed;
    }
    // As it was, or whole: another file with other UIDs.
    for (auto& [name, before] : {std::pair<const char*, QByteArray&>{"seg.dcm", seg}, {"set.dcm", set}}) {
      const QByteArray now = bytes_of(*folder_ / name);
      if (now == before) continue;
      const auto read = imaging::read_result(*folder_ / name, &mask.geometry);
      QCOMPARE(failure(read), QString());
      QVERIFY(imaging::union_of(*read).voxels == mask.voxels);
      before = now;
    }
  }
  QVERIFY(killed > 0);
}

TIDEMARK_TEST(CliResultsTest)

}  // namespace tidemark::test::cli_results_test

#include "cli_results_test.moc"
