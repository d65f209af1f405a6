// Plans of cohorts on the command line: what they refuse, what they leave out, and what they say of it.
#include <QJsonArray>
#include <QJsonDocument>

#include "core/atomic_file.h"
#include "imaging/files/volume_file.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_cohort_plan_test {

namespace {

constexpr Index3 kSize{32};
const QStringList kParameters{"--target", "1000", "--range", "400", "--alpha", "0.6"};
// The middle of each ball, in the patient.
const QString kSeed = "15.5,15.5,15.5,3";

void write(const std::filesystem::path& file, const std::string& bytes) {
  if (!write_file(file, bytes)) qFatal("a file was not written");
}

QByteArray remarks_of(const std::filesystem::path& cohort, const std::string& id) {
  const QJsonObject status = json_of(bytes_of(cohort / "cases" / id / "status.json"));
  return QJsonDocument(status["remarks"].toArray()).toJson();
}

}  // namespace

class CliCohortPlanTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase();
  void a_plan_replaces_no_file_of_others_data();
  void a_plan_replaces_no_file_of_others();
  void a_plan_that_fails_half_way_leaves_no_part_of_it();
  void recipes_of_rows_lose_nothing_unsaid();
  void a_case_says_that_the_spacing_is_not_its_recipes();
  void the_next_command_is_one_for_a_shell();
  void impossible_options_are_refused_before_the_search_data();
  void impossible_options_are_refused_before_the_search();
  void options_replace_the_values_of_a_cohort();
  void files_that_cannot_be_read_are_counted();
  void folders_that_cannot_be_read_are_counted();

 private:
  [[nodiscard]] QString study(const char* name) const { return text(studies_ / name); }
  // Of a run on a ball, in a file of that name.
  void make_recipe(const char* name, const QStringList& more) const {
    must_run(QStringList{"segment", study("ball01.nii.gz"), "--executor", "host", "--steps", "20", "--recipe",
                         text(recipes_ / name)} +
             more);
  }

  TemporaryFolder studies_, recipes_;
};

void CliCohortPlanTest::initTestCase() {
  const Volume volume = ball(kSize, 8.0);
  for (const char* name : {"ball01.nii.gz", "ball02.nii.gz"}) {
    QCOMPARE(failure(imaging::write_volume_file(volume, studies_ / name)), QString());
  }
  QCOMPARE(failure(imaging::write_mask_file(ball_mask(volume), recipes_ / "mask.nii.gz")), QString());
  const QStringList seed{"--seed-mm", kSeed};
  make_recipe("good.json", kParameters + seed);
  make_recipe("wider.json", seed + QStringList{"--target", "1000", "--range", "450", "--alpha", "0.6"});
  make_recipe("masked.json", kParameters + QStringList{"--init", text(recipes_ / "mask.nii.gz")});
  QJsonObject painted = json_of(bytes_of(recipes_ / "good.json"));
  const QJsonObject place{{"centre_mm", QJsonArray{15.5, 15.5, 15.5}}, {"radius_mm", 2.0}};
  painted["events"] = QJsonArray{QJsonObject{{"step", 0}, {"add", place}}};
  write(recipes_ / "painted.json", QJsonDocument(painted).toJson().toStdString());
}

void CliCohortPlanTest::a_plan_replaces_no_file_of_others_data() {
  QTest::addColumn<QString>("name");
  for (const char* name : {"work.csv", "recipe.json"}) QTest::newRow(name) << QString(name);
}

void CliCohortPlanTest::a_plan_replaces_no_file_of_others() {
  QFETCH(QString, name);
  const TemporaryFolder folder;
  const auto file = folder.path() / name.toStdString();
  write(file, "mine");
  const Outcome outcome = run_cli({"cohort", "plan", text(studies_.path()), "--recipe",
                                   text(recipes_ / "good.json"), "--out", text(folder.path())});
  QVERIFY2(outcome.failed_in_one_line(2) && outcome.err.contains("--out " + text(file).toUtf8()),
           outcome.told());
  QCOMPARE(bytes_of(file), QByteArray("mine"));
  QCOMPARE(names_in(folder.path()), QStringList{name});
}

void CliCohortPlanTest::a_plan_that_fails_half_way_leaves_no_part_of_it() {
  const TemporaryFolder folder;
  std::string list = "id,input\n";
  for (int i = 0; i < 1000; ++i) list += fmt::format("case{},{}\n", i, study("ball01.nii.gz").toStdString());
  write(folder / "list.csv", list);
  const auto recipe = recipes_ / "good.json";
  const QStringList plan{"cohort",     "plan",  text(folder / "list.csv"), "--recipe",
                         text(recipe), "--out", text(folder / "out")};
  RunOptions full;
  full.largest_file = bytes_of(recipe).size();  // the recipe fits, the work list does not
  const Outcome outcome = run_cli(plan, full);
  QVERIFY2(outcome.failed_in_one_line(5) && outcome.err.contains("work.csv"), outcome.told());
  QVERIFY(!names_in(folder / "out").contains("recipe.json"));
  QCOMPARE(must_run(plan).code, 0);
}

void CliCohortPlanTest::recipes_of_rows_lose_nothing_unsaid() {
  const TemporaryFolder folder;
  const auto row = [&](const char* id, const char* recipe) {
    return fmt::format("{},{},\"{}\",{}\n", id, study("ball01.nii.gz").toStdString(), kSeed.toStdString(),
                       (recipes_ / recipe).string());
  };
  write(folder / "list.csv",
        "id,input,seed_mm,recipe\n" + row("painted", "painted.json") + row("masked", "masked.json"));
  const QStringList plan{"cohort", "plan",  text(folder / "list.csv"), "--steps",
                         "2",      "--out", text(folder / "out")};
  const Outcome refused = run_cli(plan);
  QCOMPARE(refused.code, 3);
  QVERIFY2(refused.err.contains("line 2: recipe: ") && refused.err.contains("events[0]"), refused.told());
  const Outcome planned = must_run(plan + QStringList{"--without-edits"});
  QVERIFY2(planned.err.contains("1 painted edits: left out"), planned.told());
  QVERIFY2(planned.err.contains("lies on its own study's voxels"), planned.told());
  must_run({"cohort", "run", text(folder / "out")});
  const QByteArray painted = remarks_of(folder / "out", "painted");
  QVERIFY2(painted.contains("1 painted edits: left out"), painted);
  const QByteArray masked = remarks_of(folder / "out", "masked");
  QVERIFY2(masked.contains("lies on its own study's voxels"), masked);
}

void CliCohortPlanTest::a_case_says_that_the_spacing_is_not_its_recipes() {
  const TemporaryFolder folder;
  Volume wide = ball(kSize, 8.0);
  wide.geometry.spacing_mm = glm::dvec3(2.0);
  QCOMPARE(failure(imaging::write_volume_file(wide, folder / "wide.nii.gz")), QString());
  const std::string seed = ",\"15,15,15,6\",";
  write(folder / "list.csv", "id,input,seed,alpha\nwide,wide.nii.gz" + seed + "\nown,wide.nii.gz" + seed +
                                 "0.5\nsame," + study("ball01.nii.gz").toStdString() + seed + "\n");
  must_run({"cohort", "plan", text(folder / "list.csv"), "--recipe", text(recipes_ / "good.json"), "--steps",
            "2", "--out", text(folder / "out")});
  must_run({"cohort", "run", text(folder / "out")});
  const QByteArray remarks = remarks_of(folder / "out", "wide");
  QVERIFY2(remarks.contains("a spacing of 1 x 1 x 1 mm, the volume has 2 x 2 x 2"), remarks);
  QVERIFY(!remarks_of(folder / "out", "own").contains("spacing"));
  QVERIFY(!remarks_of(folder / "out", "same").contains("spacing"));
}

void CliCohortPlanTest::the_next_command_is_one_for_a_shell() {
  const TemporaryFolder folder;
  for (const auto& [name, word] : {std::pair("livers-2", "livers-2"), {"my livers", "'my livers'"}}) {
    RunOptions here;
    here.folder = text(folder.path());
    const Outcome outcome = must_run(QStringList{"cohort", "plan", text(studies_.path()), "--seed-mm", kSeed,
                                                 "--steps", "2", "--out", name} +
                                         kParameters,
                                     here);
    QVERIFY2(outcome.out.contains(QByteArray("tidemark-cli cohort run ") + word + "\n"), outcome.told());
  }
}

void CliCohortPlanTest::impossible_options_are_refused_before_the_search_data() {
  QTest::addColumn<QStringList>("options");
  QTest::addColumn<QByteArray>("says");
  const auto row = [](const QStringList& options, const char* says) {
    QTest::newRow(qPrintable(options.join(' '))) << options << QByteArray(says);
  };
  row({"--range=-5"}, "--range: must be greater than 0");
  row({"--alpha", "3"}, "--alpha: must be 0 to 1");
  row({"--levels", "9"}, "--levels: must be 1 to 3");
  row({"--max-steps", "0"}, "--max-steps: must be 1 to");
  row({"--steps", "10", "--max-steps", "20"}, "--steps, --max-steps: only one of them");
  row({"--steps", "2000000000"}, "--steps: must be at most");
  row({"--smooth=-1"}, "--smooth: must not be below 0");
  row({"--smooth", "1001"}, "--smooth: must be at most 1000");
  row({"--within", "0"}, "--within: must be greater than 0");
  row({"--init-threshold", "200,100"}, "--init-threshold: the lower limit is above the upper limit");
}

void CliCohortPlanTest::impossible_options_are_refused_before_the_search() {
  QFETCH(QStringList, options);
  QFETCH(QByteArray, says);
  const TemporaryFolder folder;
  const Outcome outcome =
      run_cli(QStringList{"cohort", "plan", "/no/such/folder", "--out", text(folder / "out")} + options);
  QVERIFY2(outcome.failed_in_one_line(2) && outcome.err.contains(says), outcome.told());
}

void CliCohortPlanTest::options_replace_the_values_of_a_cohort() {
  const TemporaryFolder folder;
  must_run(QStringList{"cohort", "plan", text(studies_.path()), "--seed-mm", kSeed, "--steps", "5", "--out",
                       text(folder / "first")} +
           kParameters);
  write(folder / "decisions.csv", "id,decision,comment\nball02,reject,leaks\n");
  int number = 1;
  const auto again = [&](const QStringList& options) {
    const auto out = folder / fmt::format("again{}", ++number);
    const Outcome outcome = must_run(QStringList{"cohort", "plan", text(folder / "first"), "--rejected",
                                                 text(folder / "decisions.csv"), "--out", text(out)} +
                                     options);
    return std::pair(bytes_of(out / "work.csv"), outcome.err);
  };
  const QByteArray kept = again({}).first;
  QVERIFY2(kept.startsWith("id,input,seed_mm,target,range,alpha,steps\r\n"), kept);
  QVERIFY2(kept.endsWith(",\"15.5,15.5,15.5,3\",1000,400,0.6,5\r\n"), kept);
  const QByteArray other = again({"--range", "80", "--max-steps", "7"}).first;
  QVERIFY2(other.startsWith("id,input,seed_mm,target,range,alpha,max_steps\r\n"), other);
  QVERIFY2(other.endsWith(",\"15.5,15.5,15.5,3\",1000,80,0.6,7\r\n"), other);
  const QByteArray start = again({"--auto-start"}).first;
  QVERIFY2(start.startsWith("id,input,auto_start,target,range,alpha,steps\r\n"), start);

  const QStringList recipe{"--recipe", text(recipes_ / "wider.json")};
  const QByteArray said = again(recipe).second;
  QVERIFY2(said.contains("wider.json: range: 1 cases have their own, which counts"), said);
  QCOMPARE(said.count("which counts"), 1);
  const QByteArray meant = again(recipe + QStringList{"--range", "80"}).second;
  QVERIFY2(!meant.contains("which counts"), meant);
}

void CliCohortPlanTest::files_that_cannot_be_read_are_counted() {
  const TemporaryFolder folder;
  const auto in = folder / "in";
  std::filesystem::create_directories(in);
  std::filesystem::copy(studies_ / "ball01.nii.gz", in / "ball01.nii.gz");
  for (const char* name : {"broken.nii.gz", "lost.dcm", "notes.txt", "screen.png"}) write(in / name, "text");
  write(in / "archive.zip", std::string("PK\x03\x04", 4));
  const QStringList plan =
      QStringList{"cohort", "plan", text(in), "--seed-mm", kSeed, "--out", text(folder / "out")} +
      kParameters;
  const Outcome all = must_run(plan + QStringList{"--verbose"});
  QVERIFY2(all.out.contains("Left out   3 "), all.told());
  for (const char* name : {"broken.nii.gz", "lost.dcm", "archive.zip"}) {
    QVERIFY2(all.err.contains("left out: " + text(in / name).toUtf8() + ": "), all.told());
  }
  std::filesystem::remove_all(folder / "out");
  const Outcome some = must_run(plan + QStringList{"--match", "*.nii.gz", "--json"});
  QCOMPARE(json_of(some.out)["left_out"].toInt(), 1);
  QCOMPARE(json_of(some.out)["cases"].toInt(), 1);
}

void CliCohortPlanTest::folders_that_cannot_be_read_are_counted() {
  const TemporaryFolder folder;
  const auto in = folder / "in";
  std::filesystem::create_directories(in / "sub-01/anat");
  std::filesystem::create_directories(in / "sub-02");
  std::filesystem::create_directories(in / "sub-03/func");  // none of images
  std::filesystem::copy(studies_ / "ball01.nii.gz", in / "sub-01/anat/sub-01_T1w.nii.gz");
  std::filesystem::create_directory_symlink("anat", in / "sub-02/anat");  // leads to itself
  write(in / "sub-04.json", "{}");
  write(in / "dataset_description.json", "{\"Name\": \"x\", \"BIDSVersion\": \"1.9.0\"}");
  const Outcome outcome = must_run(
      QStringList{"cohort", "plan", text(in), "--seed-mm", kSeed, "--out", text(folder / "out"), "--json"} +
      kParameters);
  QCOMPARE(json_of(outcome.out)["cases"].toInt(), 1);
  QCOMPARE(json_of(outcome.out)["left_out"].toInt(), 1);
}

TIDEMARK_TEST(CliCohortPlanTest)

}  // namespace tidemark::test::cli_cohort_plan_test

#include "cli_cohort_plan_test.moc"
