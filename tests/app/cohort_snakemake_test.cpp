// A cohort by the real Snakemake with the Snakefile that we give sites, on this machine and on a real Slurm.
#include <QFileInfo>
#include <QRegularExpression>

#include "core/atomic_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "tests/app/cli_runner.h"
#include "tests/app/slurm_cluster.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cohort_snakemake_test {

namespace {

constexpr int kBalls = 24;  // the last of them is broken
constexpr int kBroken = kBalls - 1;
constexpr Index3 kSize{32};
constexpr int kLongest = 300'000;  // ms
const QStringList kParameters{"--target", "1000", "--range",   "400",
                              "--alpha",  "0.6",  "--seed-mm", "15.5,15.5,15.5,3"};
const QString kFiles = QStringLiteral(TIDEMARK_COHORT_FILES);

std::string name_of(int number) {
  return fmt::format("ball{:02}", number);
}

}  // namespace

class CohortSnakemakeTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase();
  void a_cohort_is_planned_run_in_shards_and_reported_once();
  void slurm_runs_the_shards();
  void states_of_jobs_are_told_as_snakemake_asks_data();
  void states_of_jobs_are_told_as_snakemake_asks();

 private:
  [[nodiscard]] std::filesystem::path study(int number) const {
    return studies_ / (name_of(number) + ".nii.gz");
  }
  // Runs it in a folder, with a home of its own there.
  [[nodiscard]] Outcome snakemake(const std::filesystem::path& folder, int shards,
                                  const QStringList& arguments, QProcessEnvironment environment) const;
  // Whether all is there, and as segment makes it.
  void check(const std::filesystem::path& cohort);

  TemporaryFolder studies_;
  TemporaryFolder recipes_;
  std::unique_ptr<SlurmCluster> slurm_;
};

void CohortSnakemakeTest::initTestCase() {
  for (int i = 0; i < kBalls; ++i) {
    const Status written = imaging::write_volume_file(ball(kSize, 5.0 + 0.3 * i), study(i));
    QVERIFY2(written, qPrintable(failure(written)));
  }
  QByteArray broken = bytes_of(study(kBroken));
  broken.truncate(broken.size() * 2 / 3);  // its header is good, and it can be planned
  QVERIFY(write_file(study(kBroken), broken.toStdString()));
  must_run(
      QStringList{"segment", text(study(3)), "--executor", "host", "--recipe", text(recipes_ / "ball.json")} +
      kParameters);
  slurm_ = std::make_unique<SlurmCluster>(kBalls);
}

Outcome CohortSnakemakeTest::snakemake(const std::filesystem::path& folder, int shards,
                                       const QStringList& arguments, QProcessEnvironment environment) const {
  const auto home = folder / "home";
  std::filesystem::create_directories(home);
  environment.insert("HOME", text(home));
  environment.insert("XDG_CACHE_HOME", text(home / "cache"));
  environment.insert("XDG_CONFIG_HOME", text(home / "config"));
  QProcess process;
  process.setProcessEnvironment(environment);
  process.setWorkingDirectory(text(folder));
  process.start("snakemake", QStringList{"--snakefile", kFiles + "/Snakefile", "--nocolor"} + arguments +
                                 QStringList{"--config", "source=" + text(studies_.path()),
                                             "recipe=" + text(recipes_ / "ball.json"), "cohort=it's a cohort",
                                             "shards=" + QString::number(shards), "program=" + cli_program(),
                                             "plan=--output surface", "run=--timeout 600"});
  Outcome outcome;
  if (process.waitForFinished(kLongest) && process.exitStatus() == QProcess::NormalExit) {
    outcome.code = process.exitCode();
  }
  outcome.out = process.readAllStandardOutput();
  outcome.err = process.readAllStandardError() + process.errorString().toUtf8();
  return outcome;
}

void CohortSnakemakeTest::check(const std::filesystem::path& cohort) {
  QCOMPARE(names_in(cohort / "cases").size(), kBalls);
  QCOMPARE(names_in(cohort / "leases"), QStringList());
  QCOMPARE(names_in(cohort / "staging"), QStringList());
  QCOMPARE(bytes_of(cohort / "report.html").count("<article "), kBalls);
  const TemporaryFolder folder;
  for (int i = 0; i < kBalls; ++i) {
    const auto one = cohort / "cases" / name_of(i);
    const QJsonObject status = json_of(bytes_of(one / "status.json"));
    QCOMPARE(status["outcome"].toString(), QString(i == kBroken ? "refused" : "done"));
    QCOMPARE(status["attempt"].toInt(), 1);
    if (i == kBroken) {
      QVERIFY2(status["reason"].toString().contains("ball23.nii.gz"),
               qPrintable(status["reason"].toString()));
      continue;
    }
    QVERIFY(std::filesystem::exists(one / "surface.stl"));
    if (i % 4 != 0) continue;
    must_run(
        QStringList{"segment", text(study(i)), "--executor", "host", "--out", text(folder / "mask.nii.gz")} +
        kParameters);
    const auto ours = imaging::load_mask(one / "mask.nii.gz");
    QCOMPARE(failure(ours), QString());
    QVERIFY2(ours->voxels == imaging::load_mask(folder / "mask.nii.gz")->voxels, one.c_str());
  }
}

void CohortSnakemakeTest::a_cohort_is_planned_run_in_shards_and_reported_once() {
  const TemporaryFolder folder;
  const auto here = QProcessEnvironment::systemEnvironment();
  const Outcome outcome = snakemake(folder.path(), 4, {"--cores", "2"}, here);
  QVERIFY2(outcome.code == 0, outcome.told().constData());
  const auto cohort = folder / "it's a cohort";
  check(cohort);
  // What the shards have computed, each case once.
  int computed = 0;
  for (const QByteArray& line : (outcome.out + outcome.err).split('\n')) {
    if (line.startsWith("Cases ") && line.contains("computed now")) {
      computed += line.split(',')[2].simplified().split(' ')[0].toInt();
    }
  }
  QCOMPARE(computed, kBalls);

  const auto written = [&] {
    QStringList times;
    for (const char* file :
         {"plan.json", "report.html", "cases/ball00/status.json", "cases/ball23/status.json"}) {
      times += QFileInfo(text(cohort / file)).lastModified().toString(Qt::ISODateWithMs);
    }
    return times;
  };
  const QStringList before = written();
  const Outcome again = snakemake(folder.path(), 4, {"--cores", "2"}, here);
  QVERIFY2(again.code == 0 && (again.out + again.err).contains("Nothing to be done"),
           again.told().constData());
  QCOMPARE(written(), before);
}

void CohortSnakemakeTest::slurm_runs_the_shards() {
  const TemporaryFolder folder;
  const Outcome outcome = snakemake(
      folder.path(), 2, {"--profile", kFiles + "/slurm", "--default-resources", "mem_mb=500", "runtime=10"},
      slurm_->environment());
  QVERIFY2(outcome.code == 0, outcome.told().constData());
  // Each shard is a job: it leaves a log.
  QCOMPARE(names_in(folder.path()).filter(QRegularExpression("^slurm-[0-9]+\\.out$")).size(), 2);
  check(folder / "it's a cohort");
}

void CohortSnakemakeTest::states_of_jobs_are_told_as_snakemake_asks_data() {
  QTest::addColumn<QString>("submit");
  QTest::addColumn<QString>("told");
  const QString submit = "sbatch --parsable --output=/dev/null ";
  QTest::newRow("ends well") << submit + "--wrap true"
                             << "success";
  QTest::newRow("fails") << submit + "--wrap false"
                         << "failed";
  QTest::newRow("is killed") << submit + "--no-requeue --wrap 'kill -9 $$'"
                             << "failed";
  QTest::newRow("is cancelled") << "id=$(" + submit + "--hold --wrap true) && scancel $id && echo $id"
                                << "failed";
  QTest::newRow("waits") << submit + "--begin=now+1hour --wrap true"
                         << "running";
  QTest::newRow("runs") << submit + "--wrap 'sleep 600'"
                        << "running";
  QTest::newRow("is forgotten") << "echo 987654"
                                << "failed";
}

void CohortSnakemakeTest::states_of_jobs_are_told_as_snakemake_asks() {
  QFETCH(QString, submit);
  QFETCH(QString, told);
  const QString id = QString::fromUtf8(slurm_->must_run(submit)).trimmed();
  const QString ask = "'" + kFiles + "/slurm/status.sh' " + id;
  const QByteArray wanted = told.toUtf8() + "\n";
  QTRY_COMPARE_WITH_TIMEOUT(slurm_->must_run(ask), wanted, 60'000);
  // Who gets no answer from Slurm says nothing about a job.
  QVERIFY(write_file(recipes_ / "bad.conf", "Nonsense=1\n"));
  QCOMPARE(slurm_->must_run("SLURM_CONF='" + text(recipes_ / "bad.conf") + "' " + ask),
           QByteArray("running\n"));
  if (told == "running") slurm_->must_run("scancel " + id);
}

TIDEMARK_TEST(CohortSnakemakeTest)

}  // namespace tidemark::test::cohort_snakemake_test

#include "cohort_snakemake_test.moc"
