// What cannot be read or written: one line, the right code, nothing half-written.
#include <QFile>
#include <QJsonArray>
#include <limits>
#include <memory>

#include "imaging/dicom/dicom.h"
#include "imaging/files/volume_file.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_failure_test {

class CliFailureTest : public QObject {
  Q_OBJECT

 private slots:
  void init();
  void a_missing_path_is_unreadable_input();
  void a_folder_without_images_is_unreadable_input();
  void a_text_file_is_unreadable_input();
  void a_truncated_file_is_unreadable_input();
  void a_missing_slice_is_told_by_info_and_refused_by_segment();
  void voxels_that_are_not_numbers_are_refused();
  void an_unknown_series_is_refused();
  void a_mask_on_another_grid_is_refused_with_both_sizes();
  void a_folder_that_does_not_exist_cannot_be_written_to();
  void a_file_is_no_folder_to_write_to();
  void a_full_disk_leaves_nothing_behind_data();
  void a_full_disk_leaves_nothing_behind();
  void a_full_disk_keeps_the_older_result();
  void a_phantom_on_a_full_disk_is_a_failed_write();
  void a_closed_standard_output_is_a_failed_write();
  void a_small_memory_budget_ends_with_4();
  void without_opengl_gl_ends_with_4_and_the_processor_computes_and_draws();

 private:
  // Segments the path into out/; nothing may be there afterwards.
  void expect_refusal(const std::filesystem::path& input, const QByteArray& names, int code = 3);
  QStringList segment(const std::filesystem::path& input) const;

  std::unique_ptr<TemporaryFolder> folder_;
  std::filesystem::path out_;
};

void CliFailureTest::init() {
  folder_ = std::make_unique<TemporaryFolder>();
  out_ = *folder_ / "out";
  std::filesystem::create_directory(out_);
}

QStringList CliFailureTest::segment(const std::filesystem::path& input) const {
  return QStringList{"segment", text(input),           "--steps",   "5",
                     "--out",   text(out_ / "m.nrrd"), "--out",     text(out_ / "m.stl"),
                     "--stats", text(out_ / "s.json"), "--out-phi", text(out_ / "phi.mha")} +
         ball_arguments(Index3(24));
}

void CliFailureTest::expect_refusal(const std::filesystem::path& input, const QByteArray& names, int code) {
  const Outcome outcome = run_cli(segment(input));
  QVERIFY2(outcome.failed_in_one_line(code), outcome.told());
  QVERIFY2(outcome.err.contains(names), outcome.told());
  QCOMPARE(names_in(out_), QStringList());
}

void CliFailureTest::a_missing_path_is_unreadable_input() {
  expect_refusal(*folder_ / "nowhere", "nowhere");
  const Outcome info = run_cli({"info", text(*folder_ / "nowhere")});
  QVERIFY2(info.failed_in_one_line(3), info.told());
}

void CliFailureTest::a_folder_without_images_is_unreadable_input() {
  std::filesystem::create_directory(*folder_ / "empty");
  expect_refusal(*folder_ / "empty", "empty");
  const Outcome info = run_cli({"info", text(*folder_ / "empty"), "--json"});
  QVERIFY2(info.failed_in_one_line(3), info.told());
  QVERIFY2(info.out.isEmpty(), info.told());
}

void CliFailureTest::a_text_file_is_unreadable_input() {
  for (const char* name : {"letter.txt", "letter.nii", "letter.nrrd", "letter.dcm"}) {
    const auto file = *folder_ / name;
    QFile written(text(file));
    QVERIFY(written.open(QIODevice::WriteOnly));
    written.write(QByteArray("Dear doctor, enclosed please find nothing at all.\n").repeated(20));
    written.close();
    expect_refusal(file, name);
  }
}

void CliFailureTest::a_truncated_file_is_unreadable_input() {
  for (const char* name : {"ball.nii", "ball.mha", "ball.nrrd", "ball.nii.gz"}) {
    const auto file = *folder_ / name;
    QCOMPARE(failure(imaging::write_volume_file(ball(Index3(24), 8.0), file)), QString());
    std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
    expect_refusal(file, name);
  }
}

void CliFailureTest::a_missing_slice_is_told_by_info_and_refused_by_segment() {
  const auto series = *folder_ / "series";
  QCOMPARE(failure(imaging::write_dicom_series(ball(Index3(24), 8.0), {}, series)), QString());
  const QStringList files = names_in(series);
  QCOMPARE(files.size(), 24);
  std::filesystem::remove(series / files[10].toStdString());
  const Outcome info = run_cli({"info", text(series), "--json"});
  QCOMPARE(info.code, 0);
  const QJsonObject found = json_of(info.out)["series"].toArray().first().toObject();
  QCOMPARE(found["loadable"].toBool(true), false);
  QVERIFY2(found["reason"].toString().contains("missing"), info.told());
  expect_refusal(series, "missing");
}

void CliFailureTest::voxels_that_are_not_numbers_are_refused() {
  Volume volume = ball(Index3(24), 8.0);
  std::vector<float> values = volume.values();
  values[5] = 123456.0F;  // the NaN is put into the file by hand
  volume.voxels = values;
  const auto file = *folder_ / "nan.nii";
  QCOMPARE(failure(imaging::write_volume_file(volume, file)), QString());
  QByteArray bytes = bytes_of(file);
  const float marker = 123456.0F;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const qsizetype at = bytes.indexOf(QByteArray(reinterpret_cast<const char*>(&marker), sizeof marker));
  QVERIFY(at > 0);
  bytes.replace(at, sizeof nan, QByteArray(reinterpret_cast<const char*>(&nan), sizeof nan));
  QFile changed(text(file));
  QVERIFY(changed.open(QIODevice::WriteOnly));
  changed.write(bytes);
  changed.close();
  expect_refusal(file, "nan.nii");
}

void CliFailureTest::an_unknown_series_is_refused() {
  const auto series = *folder_ / "series";
  QCOMPARE(failure(imaging::write_dicom_series(ball(Index3(8), 3.0), {}, series)), QString());
  const Outcome outcome = run_cli(segment(series) + QStringList{"--series", "1.2.3"});
  QVERIFY2(outcome.failed_in_one_line(3), outcome.told());
  QVERIFY2(outcome.err.contains("1.2.3"), outcome.told());
}

void CliFailureTest::a_mask_on_another_grid_is_refused_with_both_sizes() {
  const auto file = *folder_ / "ball.nrrd";
  const auto mask = *folder_ / "mask.nrrd";
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(24), 8.0), file)), QString());
  QCOMPARE(failure(imaging::write_mask_file(ball_mask(ball(Index3(20), 8.0)), mask)), QString());
  for (const char* option : {"--init", "--init-phi", "--truth"}) {
    const Outcome outcome = run_cli(segment(file) + QStringList{option, text(mask)});
    QVERIFY2(outcome.failed_in_one_line(3), outcome.told());
    QVERIFY2(outcome.err.contains("20 x 20 x 20") && outcome.err.contains("24 x 24 x 24"), outcome.told());
    QCOMPARE(names_in(out_), QStringList());
  }
}

void CliFailureTest::a_folder_that_does_not_exist_cannot_be_written_to() {
  const auto file = *folder_ / "ball.nrrd";
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(24), 8.0), file)), QString());
  for (const char* option : {"--out", "--out-phi"}) {
    const Outcome outcome =
        run_cli(QStringList{"segment", text(file), option, text(*folder_ / "no/such/m.nrrd")} +
                ball_arguments(Index3(24)));
    QVERIFY2(outcome.failed_in_one_line(5), outcome.told());
    QVERIFY2(outcome.err.contains("no/such/m.nrrd"), outcome.told());
  }
}

void CliFailureTest::a_file_is_no_folder_to_write_to() {
  const auto file = *folder_ / "ball.nrrd";
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(24), 8.0), file)), QString());
  const Outcome convert = run_cli({"convert", text(file), "--out", text(file / "m.nii")});
  QVERIFY2(convert.failed_in_one_line(5), convert.told());
  const Outcome phantom = run_cli({"phantom", "sphere", "--out", text(file / "phantom")});
  QVERIFY2(phantom.failed_in_one_line(5), phantom.told());
}

void CliFailureTest::a_full_disk_leaves_nothing_behind_data() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"m.nii", "m.nii.gz", "m.nrrd", "m.mha", "m.stl", "m.ply", "m.obj"}) {
    QTest::newRow(name) << name;
  }
}

void CliFailureTest::a_full_disk_leaves_nothing_behind() {
  QFETCH(QString, name);
  const auto file = *folder_ / "ball.nrrd";
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(24), 8.0), file)), QString());
  RunOptions full;
  full.largest_file = 64;
  const auto target = out_ / name.toStdString();
  const Outcome outcome = run_cli(
      QStringList{"segment", text(file), "--steps", "3", "--out", text(target)} + ball_arguments(Index3(24)),
      full);
  QVERIFY2(outcome.failed_in_one_line(5), outcome.told());
  QVERIFY2(outcome.err.contains(text(target).toUtf8()), outcome.told());
  QVERIFY2(!outcome.err.contains(".tidemark-"), outcome.told());
  QCOMPARE(names_in(out_), QStringList());
}

void CliFailureTest::a_full_disk_keeps_the_older_result() {
  const auto file = *folder_ / "ball.nrrd";
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(24), 8.0), file)), QString());
  const Outcome first = run_cli(segment(file));
  QVERIFY2(first.code == 0, first.told());
  const QStringList names = names_in(out_);
  QCOMPARE(names, (QStringList{"m.nrrd", "m.stl", "phi.mha", "s.json"}));
  QList<QByteArray> before;
  for (const QString& name : names) before.append(bytes_of(out_ / name.toStdString()));
  RunOptions full;
  full.largest_file = 4000;  // the mask fits, the surface does not: neither may change
  const Outcome second = run_cli(segment(file), full);
  QVERIFY2(second.failed_in_one_line(5), second.told());
  QCOMPARE(names_in(out_), names);
  for (qsizetype n = 0; n < names.size(); ++n) QCOMPARE(bytes_of(out_ / names[n].toStdString()), before[n]);
}

void CliFailureTest::a_phantom_on_a_full_disk_is_a_failed_write() {
  RunOptions full;
  full.largest_file = 3000;
  const Outcome outcome = run_cli({"phantom", "sphere", "--out", text(out_ / "sphere")}, full);
  QVERIFY2(outcome.failed_in_one_line(5), outcome.told());
  QVERIFY(!std::filesystem::exists(out_ / "sphere/phantom.json"));
  QVERIFY(!std::filesystem::exists(out_ / "sphere/truth.nii.gz"));
}

void CliFailureTest::a_closed_standard_output_is_a_failed_write() {
  QProcess shell;
  shell.start("sh", {"-c", QString("'%1' segment --help > /dev/full").arg(cli_program())});
  QVERIFY(shell.waitForFinished());
  QCOMPARE(shell.exitCode(), 5);
  QCOMPARE(shell.readAllStandardError(), QByteArray("tidemark-cli: error: standard output: cannot write\n"));
}

void CliFailureTest::a_small_memory_budget_ends_with_4() {
  const auto file = *folder_ / "ball.nrrd";
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(96), 40.0), file)), QString());
  const Outcome outcome =
      run_cli({"segment", text(file), "--target", "1000", "--range", "500", "--alpha", "0.8", "--seed",
               "48,48,48,30", "--steps", "50", "--memory-budget", "1", "--out", text(out_ / "m.nrrd")});
  QVERIFY2(outcome.failed_in_one_line(4), outcome.told());
  QCOMPARE(names_in(out_), QStringList());
}

// Files of that name that are no libraries are found first, and nothing can be loaded from them.
void CliFailureTest::without_opengl_gl_ends_with_4_and_the_processor_computes_and_draws() {
  const auto file = *folder_ / "ball.nrrd";
  QCOMPARE(failure(imaging::write_volume_file(ball(Index3(24), 8.0), file)), QString());
  const auto picture = out_ / "picture.png";
  const QList<QStringList> drawing{
      QStringList{"segment", text(file), "--picture", text(picture)} + ball_arguments(Index3(24)),
      {"render", text(file), "--view", "axial", "--size", "64x64", "--out", text(picture)},
      {"render", text(file), "--preset", "ct-bone", "--size", "64x64", "--out", text(picture)}};
  for (const char* missing : {"libEGL.so.1", "libGL.so.1"}) {
    const TemporaryFolder libraries;
    std::vector<const char*> names = {missing};
    if (std::string_view(missing) == "libGL.so.1") names.push_back("libOpenGL.so.0");
    for (const char* name : names) QVERIFY(QFile(text(libraries / name)).open(QIODevice::WriteOnly));
    RunOptions options;
    options.environment.insert("LD_LIBRARY_PATH", text(libraries / ""));
    for (const char* executor : {"compute", "stream"}) {
      const Outcome refused =
          run_cli({"bench", "--case", "sphere", "--size", "32", "--executor", executor}, options);
      QVERIFY2(refused.failed_in_one_line(4), refused.told());
      QVERIFY2(refused.err.contains(missing), refused.told());
    }
    for (const char* executor : {"auto", "host"}) {
      const Outcome outcome = run_cli(
          {"bench", "--case", "sphere", "--size", "32", "--steps", "5", "--executor", executor}, options);
      QCOMPARE(outcome.code, 0);
      QVERIFY2(outcome.out.contains("executor host"), outcome.told());
    }
    for (const QStringList& command : drawing) {
      for (const char* renderer : {"auto", "host"}) {
        const Outcome drawn = run_cli(command + QStringList{"--renderer", renderer}, options);
        QVERIFY2(drawn.code == 0, drawn.told());
        QVERIFY(bytes_of(picture).size() > 300);  // not an even picture
        QVERIFY(std::filesystem::remove(picture));
      }
      const Outcome refused = run_cli(command + QStringList{"--renderer", "gl"}, options);
      QVERIFY2(refused.failed_in_one_line(4), refused.told());
      QVERIFY2(refused.err.contains(missing), refused.told());
      QCOMPARE(names_in(out_), QStringList());
    }
  }
}

TIDEMARK_TEST(CliFailureTest)

}  // namespace tidemark::test::cli_failure_test

#include "cli_failure_test.moc"
