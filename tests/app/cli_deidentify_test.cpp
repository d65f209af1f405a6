// tidemark-cli deidentify: what is written, what is refused, and what nobody else may read.
#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <signal.h>
#include <sys/stat.h>
#include <QElapsedTimer>
#include <QJsonArray>

#include <memory>
#include <vector>

#include "core/atomic_file.h"
#include "tests/app/cli_runner.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_deidentify_test {

class CliDeidentifyTest : public QObject {
  Q_OBJECT

  std::unique_ptr<TemporaryFolder> folder_;
  std::vector<std::filesystem::path> files_;

  [[nodiscard]] QString in(const char* name) const { return text(*folder_ / name); }
  [[nodiscard]] Outcome deidentify(const QStringList& options = {}) const {
    return run_cli(QStringList{"deidentify", in("series"), "--out", in("out")} + options);
  }

 private slots:
  void init() {
    folder_ = std::make_unique<TemporaryFolder>();
    files_ = write_series(sample_volume({6, 5, 3}), *folder_ / "series");
  }

  void a_series_becomes_another_that_can_be_segmented() {
    const Outcome outcome = deidentify({"--json", "--patient-id", "CASE-7"});
    QVERIFY2(outcome.code == 0, outcome.told());
    const QJsonObject told = json_of(outcome.out);
    QCOMPARE(told["folder"].toString(), in("out"));
    QCOMPARE(told["files"].toInt(), 3);
    QCOMPARE(told["series"].toInt(), 1);
    QCOMPARE(told["patients"].toInt(), 1);
    QVERIFY(told["changes"].toObject()["replaced"].toInt() > 9);
    QCOMPARE(told["left_out"].toArray().size(), 0);
    QCOMPARE(names_in(*folder_ / "out"), QStringList{"series-001"});
    QCOMPARE(names_in(*folder_ / "out/series-001"), (QStringList{"000001.dcm", "000002.dcm", "000003.dcm"}));
    const Outcome read = run_cli({"convert", in("out"), "--out", in("volume.nrrd")});
    QVERIFY2(read.code == 0, read.told());
    QVERIFY(bytes_of(*folder_ / "out/series-001/000001.dcm").contains("CASE-7"));
  }

  void people_are_told_what_happened() {
    const Outcome outcome = deidentify({"--keep-device", "--shift-dates", "-10"});
    QVERIFY2(outcome.code == 0, outcome.told());
    QVERIFY2(outcome.out.contains("3 files in 1 series of 1 patients"), outcome.told());
    QVERIFY2(outcome.out.contains("kept: device, shifted-dates"), outcome.told());
    QVERIFY2(outcome.err.isEmpty(), outcome.told());
  }

  void the_list_has_no_old_values_and_the_key_is_private() {
    const Outcome outcome = deidentify({"--list", in("list.json"), "--key", in("key.json")});
    QVERIFY2(outcome.code == 0, outcome.told());
    const QByteArray list = bytes_of(*folder_ / "list.json");
    QVERIFY2(!list.contains("PHANTOM") && !list.contains("slice-0"), list.constData());
    const QJsonObject first = json_of(list)["files"].toArray()[0].toObject();
    QCOMPARE(first["file"].toString(), QString("series-001/000001.dcm"));
    const QJsonArray changes = first["changes"].toArray();
    const auto has = [&](const char* attribute, const char* keyword, const char* change) {
      const QJsonObject wanted{{"attribute", attribute}, {"keyword", keyword}, {"change", change}};
      return changes.contains(wanted);
    };
    QVERIFY(has("(0010,0020)", "PatientID", "replaced"));
    QVERIFY(has("(0020,000D)", "StudyInstanceUID", "replaced"));
    QVERIFY(has("(0008,103E)", "SeriesDescription", "removed"));
    QVERIFY(has("(0008,0020)", "StudyDate", "emptied"));

    struct stat state {};
    QCOMPARE(::stat((*folder_ / "key.json").c_str(), &state), 0);
    QCOMPARE(state.st_mode & 0777, 0600U);
    const QJsonObject key = json_of(bytes_of(*folder_ / "key.json"));
    QCOMPARE(key["patients"].toArray()[0].toObject()["old"].toString(), QString("PHANTOM"));
    QVERIFY(key["uids"].toArray().size() >= 6);
    QCOMPARE(key["files"].toArray().size(), 3);
  }

  void the_list_can_be_a_table() {
    const Outcome outcome = deidentify({"--list", in("list.csv")});
    QVERIFY2(outcome.code == 0, outcome.told());
    const QByteArray list = bytes_of(*folder_ / "list.csv");
    QVERIFY(list.startsWith("file,attribute,keyword,change\r\n"));
    QVERIFY(list.contains("PatientName,replaced\r\n"));
  }

  void files_that_may_not_be_opened_are_named() {
    std::filesystem::permissions(files_[1], std::filesystem::perms::none);
    const Outcome outcome =
        run_cli({"deidentify", in("series"), "--out", in("out"), "--json"}, {.is_privileged = false});
    QVERIFY2(outcome.code == 3, outcome.told());
    QVERIFY2(outcome.err.contains("slice-00002.dcm: was left out: cannot be read: Permission denied"),
             outcome.told());
    QVERIFY2(outcome.err.contains("1 of 3 files were left out"), outcome.told());
    QCOMPARE(json_of(outcome.out)["files"].toInt(), 2);
  }

  void risky_images_end_with_3_and_the_others_are_written() {
    set_text(files_[1], 0x0028, 0x0301, "YES");
    const Outcome outcome = deidentify({"--json"});
    QCOMPARE(outcome.code, 3);
    QVERIFY2(outcome.err.contains("slice-00002.dcm: was left out: BurnedInAnnotation (0028,0301) is YES"),
             outcome.told());
    QVERIFY2(outcome.err.contains("1 of 3 files were left out"), outcome.told());
    QCOMPARE(json_of(outcome.out)["left_out"].toArray()[0].toObject()["kind"].toString(), QString("risky"));
    QCOMPARE(names_in(*folder_ / "out/series-001").size(), 2);
    std::filesystem::remove_all(*folder_ / "out");
    const Outcome all = deidentify({"--json", "--with-risky-images"});
    QVERIFY2(all.code == 0, all.told());
    QVERIFY2(all.err.contains("BurnedInAnnotation (0028,0301) is YES"), all.told());
    QCOMPARE(json_of(all.out)["risky"].toArray().size(), 1);
  }

  void reports_are_left_out_and_named() {
    set_text(files_[0], 0x0008, 0x0016, UID_ComprehensiveSRStorage);
    const Outcome outcome = deidentify();
    QVERIFY2(outcome.code == 0, outcome.told());
    QVERIFY2(
        outcome.err.contains("slice-00001.dcm: was left out: SOPClassUID (0008,0016) is ComprehensiveSR"),
        outcome.told());
  }

  void failures_end_with_their_code_and_write_nothing_data() {
    QTest::addColumn<QStringList>("arguments");
    QTest::addColumn<int>("code");
    QTest::addColumn<QByteArray>("said");
    const auto row = [](const char* name, const QString& words, int code, const char* said) {
      QTest::newRow(name) << words.split(' ') << code << QByteArray(said);
    };
    row("no folder", "series", 2, "--out");
    row("nowhere", "none --out new", 3, "none: no such file or folder");
    row("no DICOM", "words --out new", 3, "there is no DICOM file");
    row("the same folder", "series --out series", 2,
        "series: is the source of the copies, lies in it or holds it");
    row("in the input", "series --out series/new", 2, "lies in it");
    row("around the input", "series --out .", 2, "holds it");
    row("not empty", "series --out words", 2, "words: is there and not empty");
    row("a list in the new folder", "series --out new --list new/list.json", 2,
        "new/list.json: lies among the copies");
    row("a key in the input", "series --out new --key series/key.json", 2, "series/key.json: lies among");
    row("a key that is there", "series --out new --key words/words.json", 2, "a key is not overwritten");
    row("a list without a form", "series --out new --list list.txt", 2, "must end in .json");
    row("no days", "series --out new --shift-dates 1.5", 2, "'1.5' is neither 'random' nor a number of days");
    row("a patient's ID with a backslash", "series --out new --patient-id a\\b", 2, "is no PatientID");
  }

  void failures_end_with_their_code_and_write_nothing() {
    QFETCH(QStringList, arguments);
    QFETCH(int, code);
    QFETCH(QByteArray, said);
    std::filesystem::create_directory(*folder_ / "words");
    QVERIFY(write_file(*folder_ / "words/words.json", "{}"));
    const Outcome outcome = run_cli(QStringList{"deidentify"} + arguments, {.folder = text(folder_->path())});
    QVERIFY2(outcome.failed_in_one_line(code), outcome.told());
    QVERIFY2(outcome.err.contains(said), outcome.told());
    QCOMPARE(names_in(folder_->path()), (QStringList{"series", "words"}));
    QCOMPARE(names_in(*folder_ / "series").size(), 3);
  }

  void termination_ends_it_within_a_second_and_leaves_nothing() {
    write_series(sample_volume({256, 256, 400}), *folder_ / "large");
    bool was_cancelled = false;
    for (const int milliseconds : {0, 50, 300}) {
      QProcess process;
      process.start(cli_program(), {"deidentify", in("large"), "--out", in("out"), "--key", in("key.json")});
      QVERIFY(process.waitForStarted());
      if (!process.waitForFinished(milliseconds + 20)) {
        QElapsedTimer timer;
        timer.start();
        QCOMPARE(::kill(static_cast<pid_t>(process.processId()), SIGTERM), 0);
        QVERIFY(process.waitForFinished(60'000));
        QVERIFY2(timer.elapsed() < 1000, qPrintable(QString::number(timer.elapsed())));
      }
      const bool is_normal = process.exitStatus() == QProcess::NormalExit;
      if (is_normal && process.exitCode() == 0) {  // a quick machine was done before
        QCOMPARE(names_in(*folder_ / "out/series-001").size(), 400);
        std::filesystem::remove_all(*folder_ / "out");
        std::filesystem::remove(*folder_ / "key.json");
      } else {
        // Before it waits for signals, one ends it.
        QVERIFY2(!is_normal || process.exitCode() == 130, process.readAllStandardError().constData());
        was_cancelled = true;
      }
      QCOMPARE(names_in(folder_->path()), (QStringList{"large", "series"}));
    }
    QVERIFY(was_cancelled);
  }
};

TIDEMARK_TEST(CliDeidentifyTest)

}  // namespace tidemark::test::cli_deidentify_test

#include "cli_deidentify_test.moc"
