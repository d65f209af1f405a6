// Cohorts on the command line, from a folder of studies to the report.
#include <signal.h>
#include <unistd.h>

#include <QDateTime>
#include <QFileInfo>
#include <QJsonArray>
#include <QJsonDocument>

#include "core/atomic_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_cohort_test {

namespace {

constexpr int kBalls = 12;
constexpr Index3 kSize{32};
const QStringList kParameters{"--target", "1000", "--range", "400", "--alpha", "0.6"};
// The middle of each ball, in the patient.
const QString kSeed = "15.5,15.5,15.5,3";

double radius_of(int number) {
  return 6.0 + 0.5 * number;
}

QString name_of(int number) {
  return QStringLiteral("ball%1").arg(number, 2, 10, QLatin1Char('0'));
}

// Balls of several sizes, each with its truth beside it.
void write_balls(const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / "deep" / "er");
  for (int i = 0; i < kBalls; ++i) {
    const Volume volume = ball(kSize, radius_of(i));
    const std::string name = name_of(i).toStdString();
    const auto place = i % 3 == 0 ? folder / "deep" / "er" : folder;
    if (!imaging::write_volume_file(volume, place / (name + ".nii.gz")) ||
        !imaging::write_mask_file(ball_mask(volume), place / (name + "_truth.nii.gz"))) {
      qFatal("a ball was not written");
    }
  }
}

QJsonObject status_of(const std::filesystem::path& cohort, const QString& id) {
  return json_of(bytes_of(cohort / "cases" / id.toStdString() / "status.json"));
}

int count_in(const std::filesystem::path& folder) {
  return static_cast<int>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

}  // namespace

class CliCohortTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase() { write_balls(studies_ / "in"); }
  void a_cohort_has_the_masks_of_segment_to_the_last_bit();
  void a_broken_case_and_an_endless_one_stop_no_other();
  void a_wrong_environment_is_no_fault_of_a_case();
  void a_killed_run_goes_on_where_it_was();
  void a_terminated_run_gives_its_cases_back_data();
  void a_terminated_run_gives_its_cases_back();
  void problems_of_all_rows_are_told_at_once();
  void what_a_recipe_does_at_places_is_refused_unless_it_is_left_out();
  void rejected_cases_are_planned_again();
  void bids_is_read_and_derivatives_are_written();
  void derivatives_take_the_place_of_nothing_but_derivatives();
  void a_script_for_slurm_is_cut_into_arrays();
  void wrong_usage_ends_with_2_and_one_line_data();
  void wrong_usage_ends_with_2_and_one_line();

 private:
  [[nodiscard]] QString in() const { return text(studies_ / "in"); }
  // Plans all balls.
  void plan(const std::filesystem::path& out, const QStringList& more = {}) const {
    must_run(QStringList{"cohort", "plan", in(), "--out", text(out), "--seed-mm", kSeed, "--truth",
                         "{name}_truth.nii.gz"} +
             kParameters + more);
  }

  TemporaryFolder studies_;
};

void CliCohortTest::a_cohort_has_the_masks_of_segment_to_the_last_bit() {
  const TemporaryFolder folder;
  const auto out = folder / "cohort";
  plan(out, {"--output", "seg", "--output", "surface", "--output", "phi"});
  QVERIFY(names_in(out / "cases").isEmpty());
  const QJsonObject tally = json_of(must_run({"cohort", "run", text(out), "--jobs", "2", "--json"}).out);
  QCOMPARE(tally["done"].toInt(), kBalls);
  QCOMPARE(count_in(out / "leases"), 0);
  QCOMPARE(count_in(out / "staging"), 0);
  for (int i = 0; i < kBalls; ++i) {
    const QString id = (i % 3 == 0 ? "deep_er_" : "") + name_of(i);
    const auto place = i % 3 == 0 ? studies_ / "in" / "deep" / "er" : studies_ / "in";
    const auto mask = folder / "mask.nii.gz";
    const QJsonObject stats = json_of(
        must_run(QStringList{"segment", text(place / (name_of(i).toStdString() + ".nii.gz")), "--seed-mm",
                             kSeed, "--executor", "host", "--out", text(mask), "--json"} +
                 kParameters)
            .out);
    const auto alone = imaging::load_mask(mask);
    const auto ours = imaging::load_mask(out / "cases" / id.toStdString() / "mask.nii.gz");
    QCOMPARE(failure(ours), QString());
    QVERIFY2(alone->voxels == ours->voxels && alone->geometry == ours->geometry, qPrintable(id));
    const QJsonObject status = status_of(out, id);
    QCOMPARE(status["outcome"].toString(), QString("done"));
    QCOMPARE(status["figures"]["volume_ml"].toDouble(), stats["volume_ml"].toDouble());
    QCOMPARE(status["figures"]["steps"].toInt(), stats["steps"].toInt());
    QVERIFY(status["figures"]["dice"].toDouble() > 0.9);
    QCOMPARE(status["input_checksum"].toString().size(), 64);
    for (const char* name : {"seg.dcm", "surface.stl", "phi.nii.gz", "recipe.json", "overview.png"}) {
      QVERIFY2(std::filesystem::exists(out / "cases" / id.toStdString() / name), name);
    }
  }
  // A case's own recipe makes the same mask.
  const auto again = folder / "again.nii.gz";
  must_run({"replay", text(out / "cases" / "ball01" / "recipe.json"), text(studies_ / "in" / "ball01.nii.gz"),
            "--out", text(again)});
  QVERIFY(imaging::load_mask(again)->voxels ==
          imaging::load_mask(out / "cases" / "ball01" / "mask.nii.gz")->voxels);
  must_run({"cohort", "report", text(out)});
  const QByteArray page = bytes_of(out / "report.html");
  QCOMPARE(page.count("<article "), kBalls);
  QCOMPARE(page.count("data:image/png;base64,"), kBalls);
  QCOMPARE(bytes_of(out / "report.csv").count('\n'), kBalls + 1);
}

void CliCohortTest::a_broken_case_and_an_endless_one_stop_no_other() {
  const TemporaryFolder folder;
  QByteArray broken = bytes_of(studies_ / "in" / "ball01.nii.gz");
  broken.truncate(broken.size() * 2 / 3);  // its header is good
  QVERIFY(write_file(folder / "broken.nii.gz", broken.toStdString()));
  const QString row = ",1000,400,0.6,\"15.5,15.5,15.5,3\",";
  QVERIFY(write_file(folder / "list.csv",
                     ("id,input,target,range,alpha,seed_mm,steps\nbroken," + text(folder / "broken.nii.gz") +
                      row + "\nendless," + in() + "/ball01.nii.gz" + row + "900000000\ngood," + in() +
                      "/ball02.nii.gz" + row + "\n")
                         .toStdString()));
  const auto out = folder / "cohort";
  must_run({"cohort", "plan", text(folder / "list.csv"), "--out", text(out)});
  const QStringList run{"cohort", "run", text(out), "--timeout", "8", "--jobs", "2", "--json"};
  const QJsonObject tally = json_of(must_run(run).out);
  QCOMPARE(tally["done"].toInt(), 1);
  QCOMPARE(tally["refused"].toInt(), 1);
  QCOMPARE(tally["timed_out"].toInt(), 1);
  const QJsonObject status = status_of(out, "broken");
  QCOMPARE(status["outcome"].toString(), QString("refused"));
  QVERIFY2(status["reason"].toString().contains("broken.nii.gz"), qPrintable(status["reason"].toString()));
  QCOMPARE(names_in(out / "cases" / "endless"), QStringList{"status.json"});
  const Outcome strict = run_cli({"cohort", "run", text(out), "--timeout", "8", "--retry", "--strict"});
  QCOMPARE(strict.code, 3);
  QCOMPARE(status_of(out, "broken")["attempt"].toInt(), 2);
  // What an earlier run has not done counts too; of another shard it does not.
  const QStringList again{"cohort", "run", text(out), "--strict"};
  const Outcome nothing_new = run_cli(again);
  QVERIFY2(nothing_new.code == 3 && nothing_new.err.contains("2 cases have no result"), nothing_new.told());
  QCOMPARE(must_run(again + QStringList{"--shard", "3/3"}).code, 0);
  must_run({"cohort", "report", text(out)});
}

void CliCohortTest::a_wrong_environment_is_no_fault_of_a_case() {
  const TemporaryFolder folder;
  const auto out = folder / "cohort";
  plan(out, {"--match", "ball01.nii.gz"});
  const QStringList run{"cohort", "run", text(out), "--json"};
  RunOptions other_set;
  other_set.environment.insert("TIDEMARK_SIMD", "mmx");
  const Outcome refused = run_cli(run, other_set);
  QVERIFY2(refused.failed_in_one_line(2), refused.told());
  QVERIFY2(refused.err.contains("TIDEMARK_SIMD: unknown instruction set 'mmx'"), refused.told());
  QVERIFY(names_in(out / "cases").isEmpty());
  // Such a case needs no temporary files.
  RunOptions no_folder;
  no_folder.environment.insert("TMPDIR", text(folder / "absent"));
  QCOMPARE(json_of(must_run(run, no_folder).out)["done"].toInt(), 1);
}

void CliCohortTest::a_killed_run_goes_on_where_it_was() {
  const TemporaryFolder folder;
  const auto out = folder / "cohort";
  plan(out);
  QMap<QString, QDateTime> done;
  for (int round = 0; round < 3; ++round) {
    QProcess process;
    process.start(cli_program(), {"cohort", "run", text(out), "--jobs", "1"});
    const int before = count_in(out / "cases");
    QTRY_VERIFY_WITH_TIMEOUT(count_in(out / "cases") > before || process.state() == QProcess::NotRunning,
                             20000);
    process.kill();  // unless it was faster
    QVERIFY(process.waitForFinished() || process.state() == QProcess::NotRunning);
    for (const QString& id : names_in(out / "cases")) {
      const QDateTime time = QFileInfo(text(out / "cases" / id.toStdString() / "status.json")).lastModified();
      if (!done.contains(id)) done[id] = time;
      QCOMPARE(done[id], time);
    }
  }
  const QJsonObject tally = json_of(must_run({"cohort", "run", text(out), "--json"}).out);
  QCOMPARE(tally["before"].toInt() + tally["done"].toInt(), kBalls);
  QVERIFY(tally["before"].toInt() >= done.size());
  QCOMPARE(names_in(out / "cases").size(), kBalls);
  QCOMPARE(count_in(out / "leases"), 0);
  QCOMPARE(count_in(out / "staging"), 0);
}

void CliCohortTest::a_terminated_run_gives_its_cases_back_data() {
  QTest::addColumn<int>("signal");
  QTest::addColumn<bool>("all");
  QTest::newRow("the run alone") << SIGTERM << false;
  QTest::newRow("a scheduler's job") << SIGTERM << true;
  QTest::newRow("Ctrl-C") << SIGINT << true;
}

// Terminals and schedulers signal all processes of a run.
void CliCohortTest::a_terminated_run_gives_its_cases_back() {
  QFETCH(int, signal);
  QFETCH(bool, all);
  const TemporaryFolder folder;
  const auto out = folder / "cohort";
  plan(out, {"--steps", "900000000"});
  QProcess process;
  process.setChildProcessModifier([] {
    ::setpgid(0, 0);
    ::signal(SIGINT, SIG_DFL);  // a script may ignore it for tests in the background
  });
  process.start(cli_program(), {"cohort", "run", text(out), "--jobs", "2"});
  QTRY_COMPARE_WITH_TIMEOUT(count_in(out / "staging"), 2, 20000);
  const auto leader = static_cast<pid_t>(process.processId());
  QCOMPARE(::kill(all ? -leader : leader, signal), 0);
  QVERIFY(process.waitForFinished());
  QCOMPARE(process.exitCode(), 130);
  QCOMPARE(count_in(out / "staging"), 0);
  QVERIFY(names_in(out / "cases").isEmpty());
}

void CliCohortTest::problems_of_all_rows_are_told_at_once() {
  const TemporaryFolder folder;
  QVERIFY(write_file(folder / "list.csv",
                     "input,target,range,alpha,seed\n"
                     "absent.nii.gz,1,1,0.5,\"1,1,1,1\"\n" +
                         in().toStdString() + "/ball01.nii.gz,1,1,0.5,\"99,1,1,1\"\n" + in().toStdString() +
                         "/ball02.nii.gz,1,1,,\"1,1,1,1\"\n"));
  const QStringList arguments{"cohort", "plan", text(folder / "list.csv"), "--out", text(folder / "cohort")};
  const Outcome outcome = run_cli(arguments);
  QCOMPARE(outcome.code, 3);
  for (const char* part :
       {"line 2: input: ", "absent.nii.gz", "line 3: seed: ", "line 4: alpha: is missing"}) {
    QVERIFY2(outcome.err.contains(part), outcome.err.constData());
  }
  QVERIFY(!std::filesystem::exists(folder / "cohort"));
}

void CliCohortTest::what_a_recipe_does_at_places_is_refused_unless_it_is_left_out() {
  const TemporaryFolder folder;
  must_run(QStringList{"segment", in() + "/ball05.nii.gz", "--seed-mm", kSeed, "--executor", "host",
                       "--recipe", text(folder / "good.json")} +
           kParameters);
  must_run({"cohort", "plan", in(), "--match", "ball0*[0-9].nii.gz", "--recipe", text(folder / "good.json"),
            "--out", text(folder / "good")});
  must_run({"cohort", "run", text(folder / "good")});
  QCOMPARE(names_in(folder / "good" / "cases").size(), 10);
  const QByteArray good = bytes_of(folder / "good.json");
  QJsonObject recipe = json_of(good);
  const QJsonObject place{{"centre_mm", QJsonArray{15.5, 15.5, 15.5}}, {"radius_mm", 2.0}};
  recipe["events"] = QJsonArray{QJsonObject{{"step", 0}, {"add", place}}};
  QVERIFY(write_file(folder / "painted.json", QJsonDocument(recipe).toJson().toStdString()));
  const QStringList painted{
      "cohort", "plan", in(), "--recipe", text(folder / "painted.json"), "--out", text(folder / "painted")};
  const Outcome outcome = run_cli(painted);
  QVERIFY2(outcome.failed_in_one_line(3) && outcome.err.contains("events[0]"), outcome.told().constData());
  must_run(painted + QStringList{"--without-edits"});
}

void CliCohortTest::rejected_cases_are_planned_again() {
  const TemporaryFolder folder;
  plan(folder / "first");
  QVERIFY(
      write_file(folder / "decisions.csv", "id,decision,comment\nball01,accept,\nball02,reject,\"leaks\"\n"));
  must_run({"cohort", "plan", text(folder / "first"), "--rejected", text(folder / "decisions.csv"), "--out",
            text(folder / "second")});
  const QByteArray list = bytes_of(folder / "second" / "work.csv");
  QCOMPARE(list.count('\n'), 2);
  QVERIFY(list.contains("ball02,"));
  const Outcome all = run_cli({"cohort", "plan", text(folder / "first"), "--out", text(folder / "third")});
  QVERIFY2(all.failed_in_one_line(2), all.told().constData());
}

void CliCohortTest::bids_is_read_and_derivatives_are_written() {
  const TemporaryFolder folder;
  const auto raw = folder / "raw";
  for (const char* place : {"sub-01/anat", "sub-02/ses-1/anat", "derivatives/sub-01/anat"}) {
    std::filesystem::create_directories(raw / place);
  }
  const auto ball = studies_ / "in" / "ball01.nii.gz";
  std::filesystem::copy(ball, raw / "sub-01/anat/sub-01_T1w.nii.gz");
  std::filesystem::copy(ball, raw / "sub-02/ses-1/anat/sub-02_ses-1_T1w.nii.gz");
  std::filesystem::copy(ball, raw / "derivatives/sub-01/anat/sub-01_T1w.nii.gz");
  QVERIFY(write_file(raw / "dataset_description.json", "{\"Name\": \"x\", \"BIDSVersion\": \"1.9.0\"}"));
  const auto out = folder / "cohort";
  must_run(QStringList{"cohort", "plan", text(raw), "--seed-mm", kSeed, "--out", text(out)} + kParameters);
  must_run({"cohort", "run", text(out)});
  must_run({"cohort", "report", text(out), "--bids", text(folder / "masks")});
  QVERIFY(std::filesystem::exists(folder / "masks/sub-01/anat/sub-01_desc-tidemarkT1w_mask.nii.gz"));
  const QJsonObject sidecar =
      json_of(bytes_of(folder / "masks/sub-02/ses-1/anat/sub-02_ses-1_desc-tidemarkT1w_mask.json"));
  QCOMPARE(sidecar["Sources"][0].toString(), QString("bids:raw:sub-02/ses-1/anat/sub-02_ses-1_T1w.nii.gz"));
  const QJsonObject description = json_of(bytes_of(folder / "masks/dataset_description.json"));
  QCOMPARE(description["DatasetType"].toString(), QString("derivative"));
  QCOMPARE(description["GeneratedBy"][0]["Name"].toString(), QString("Tidemark"));
}

void CliCohortTest::derivatives_take_the_place_of_nothing_but_derivatives() {
  const TemporaryFolder folder;
  const auto raw = folder / "raw";
  const auto out = folder / "work" / "cohort";
  std::filesystem::create_directories(raw / "sub-01/anat");
  std::filesystem::copy(studies_ / "in" / "ball01.nii.gz", raw / "sub-01/anat/sub-01_T1w.nii.gz");
  QVERIFY(write_file(raw / "dataset_description.json", "{\"Name\": \"x\", \"BIDSVersion\": \"1.9.0\"}"));
  must_run(QStringList{"cohort", "plan", text(raw), "--seed-mm", kSeed, "--out", text(out)} + kParameters);
  must_run({"cohort", "run", text(out)});
  // Derivatives by others, and a folder of anything.
  for (const char* name : {"other", "notes"}) std::filesystem::create_directories(folder / name);
  QVERIFY(write_file(folder / "other/dataset_description.json",
                     "{\"DatasetType\": \"derivative\", \"GeneratedBy\": [{\"Name\": \"fMRIPrep\"}]}"));
  QVERIFY(write_file(folder / "notes/thesis.txt", "text"));
  std::filesystem::create_directory_symlink(raw, folder / "link");
  for (const auto& target : {raw, raw / "masks", folder / "link", out, out / "masks", folder / "work",
                             folder.path(), folder / "other", folder / "notes"}) {
    const Outcome outcome = run_cli({"cohort", "report", text(out), "--bids", text(target)});
    QVERIFY2(outcome.failed_in_one_line(2) && outcome.err.contains("--bids " + text(target).toUtf8()),
             outcome.told().constData());
  }
  QVERIFY(!std::filesystem::exists(out / "report.html"));
  for (const auto& file : {raw / "sub-01/anat/sub-01_T1w.nii.gz", raw / "dataset_description.json",
                           out / "cases/sub-01_T1w/mask.nii.gz", folder / "other/dataset_description.json",
                           folder / "notes/thesis.txt"}) {
    QVERIFY2(std::filesystem::exists(file), file.c_str());
  }
  // What others have added stays, and so do masks of other studies.
  const auto derivatives = raw / "derivatives";
  const QStringList again{"cohort", "report", text(out), "--bids", text(derivatives)};
  must_run(again);
  for (const char* name : {"fmriprep/x", "sub-01/anat/sub-01_label-liver_mask.nii.gz"}) {
    const auto added = derivatives / name;
    std::filesystem::create_directories(added.parent_path());
    QVERIFY(write_file(added, "x"));
    const Outcome outcome = run_cli(again);
    QVERIFY2(outcome.failed_in_one_line(2), outcome.told().constData());
    QCOMPARE(bytes_of(added), QByteArray("x"));
    std::filesystem::remove(added);
    std::filesystem::remove(derivatives / "fmriprep");
  }
  must_run(again);
  const QByteArray description = bytes_of(derivatives / "dataset_description.json");
  QVERIFY(write_file(derivatives / "dataset_description.json",
                     QByteArray(description).replace("file://", "file:///other").toStdString()));
  QCOMPARE(run_cli(again).code, 2);
  QVERIFY(std::filesystem::exists(derivatives / "sub-01/anat/sub-01_desc-tidemarkT1w_mask.nii.gz"));
  // A new folder, an empty one, and twice the same.
  std::filesystem::create_directory(folder / "empty");
  for (const auto& target : {folder / "empty", folder / "empty", raw / "derivatives/tidemark"}) {
    must_run({"cohort", "report", text(out), "--bids", text(target)});
    QVERIFY(std::filesystem::exists(target / "sub-01/anat/sub-01_desc-tidemarkT1w_mask.nii.gz"));
  }
}

void CliCohortTest::a_script_for_slurm_is_cut_into_arrays() {
  const TemporaryFolder folder;
  plan(folder / "it's");
  const QJsonObject said = json_of(must_run({"cohort", "submit", text(folder / "it's"), "--slurm", "--tasks",
                                             "25", "--largest-array", "10", "--jobs", "2", "--json"})
                                       .out);
  QCOMPARE(said["commands"].toArray().size(), 3);
  QVERIFY(said["commands"][2].toString().contains("--array=0-4 "));
  QProcess shell;  // the script's last line is one command with the folder as one word
  shell.start("bash", {"-n", said["script"].toString()});
  QVERIFY(shell.waitForFinished() && shell.exitCode() == 0);
}

void CliCohortTest::wrong_usage_ends_with_2_and_one_line_data() {
  QTest::addColumn<QStringList>("arguments");
  QTest::addColumn<int>("code");
  const QString here = text(studies_ / "in");
  QTest::newRow("no command") << QStringList{} << 2;
  QTest::newRow("output") << QStringList{"plan", here, "--out", "/tmp/x", "--output", "jpeg"} << 2;
  QTest::newRow("no cohort") << QStringList{"run", here} << 3;
  QTest::newRow("shard") << QStringList{"run", here, "--shard", "3/2"} << 2;
  QTest::newRow("jobs") << QStringList{"run", here, "--jobs", "0"} << 2;
  QTest::newRow("memory") << QStringList{"run", here, "--memory", "9000000000000"} << 2;
  QTest::newRow("scheduler") << QStringList{"submit", here} << 2;
  QTest::newRow("injection") << QStringList{"submit", here, "--slurm", "--partition", "a\nrm"} << 2;
  QTest::newRow("no folder") << QStringList{"plan", "/no/such/folder", "--out", "/tmp/x"} << 3;
}

void CliCohortTest::wrong_usage_ends_with_2_and_one_line() {
  QFETCH(QStringList, arguments);
  QFETCH(int, code);
  const Outcome outcome = run_cli(QStringList{"cohort"} + arguments);
  QVERIFY2(outcome.failed_in_one_line(code), outcome.told().constData());
}

TIDEMARK_TEST(CliCohortTest)

}  // namespace tidemark::test::cli_cohort_test

#include "cli_cohort_test.moc"
