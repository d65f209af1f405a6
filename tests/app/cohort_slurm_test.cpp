// A cohort on a real Slurm, whose tasks are drained, requeued, cancelled and killed.
#include <signal.h>

#include <QJsonArray>
#include <QSet>

#include "core/thread_pool.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "tests/app/cli_runner.h"
#include "tests/app/folder_events.h"
#include "tests/app/slurm_cluster.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cohort_slurm_test {

namespace {

constexpr int kBalls = 200;
constexpr int kLargestArray = 4;
constexpr Index3 kSize{32};
// Cases of a run with one job: one that it computes, and those that are synced together.
constexpr int kMostHeld = 17;
// Steps keep the tasks busy for some seconds, so that there is a half-way.
const QStringList kParameters{"--target", "1000", "--range",   "400",
                              "--alpha",  "0.6",  "--seed-mm", "15.5,15.5,15.5,3"};
const QStringList kSteps{"--steps", "60000"};
const QStringList kManySteps{"--steps", "1000000"};

QString name_of(int number) {
  return QStringLiteral("ball%1").arg(number, 3, 10, QLatin1Char('0'));
}

int sum(const QMap<QString, int>& counts) {
  int all = 0;
  for (const int count : counts) all += count;
  return all;
}

}  // namespace

class CohortSlurmTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase();
  void tasks_that_are_ended_in_all_ways_cost_no_case();
  void what_a_cancelled_array_has_left_is_done_when_it_is_submitted_again();
  void arrays_are_as_large_as_the_site_allows();

 private:
  [[nodiscard]] std::filesystem::path study(int number) const {
    return studies_ / (name_of(number).toStdString() + ".nii.gz");
  }
  // Runs what `cohort submit` has printed.
  void submit(const std::filesystem::path& cohort, const QStringList& options) const;
  // The first process of a task.
  [[nodiscard]] pid_t process_of(const QString& task, const QString& node) const;

  TemporaryFolder studies_;
  std::unique_ptr<SlurmCluster> slurm_;
};

void CohortSlurmTest::initTestCase() {
  for (int i = 0; i < kBalls; ++i) {
    const Status written = imaging::write_volume_file(ball(kSize, 5.0 + 0.04 * i), study(i));
    QVERIFY2(written, qPrintable(failure(written)));
  }
  slurm_ = std::make_unique<SlurmCluster>(kLargestArray);
}

void CohortSlurmTest::submit(const std::filesystem::path& cohort, const QStringList& options) const {
  const QStringList arguments = QStringList{"cohort", "submit", text(cohort), "--slurm", "--json"} + options;
  const QJsonArray commands = json_of(test::must_run(arguments).out)["commands"].toArray();
  QVERIFY(!commands.isEmpty());
  for (const auto& command : commands) {
    const QByteArray said = slurm_->must_run(command.toString());
    QVERIFY2(said.startsWith("Submitted batch job "), said.constData());
  }
}

pid_t CohortSlurmTest::process_of(const QString& task, const QString& node) const {
  const QByteArray job = slurm_->must_run("squeue --noheader --format=%A --jobs=" + task).trimmed();
  const QByteArray listed = slurm_->must_run("scontrol listpids " + job + " " + node);
  // PID JOBID STEPID LOCALID GLOBALID, below a line of these words; those that it started have no LOCALID.
  for (const QByteArray& line : listed.split('\n').mid(1)) {
    const QList<QByteArray> words = line.simplified().split(' ');
    if (words.size() >= 4 && words[3] == "0") return words[0].toInt();
  }
  qFatal("task %s has no process: %s", qPrintable(task), listed.constData());
}

// Who holds a case alone computes it. What a task was at when it ended is computed once more, and nothing
// else.
void CohortSlurmTest::tasks_that_are_ended_in_all_ways_cost_no_case() {
  const TemporaryFolder folder;
  const auto out = folder / "it's 5%j";  // words of a shell and of Slurm
  test::must_run(QStringList{"cohort", "plan", text(studies_.path()), "--out", text(out)} + kParameters +
                 kSteps);
  FolderEvents begun(out / "staging", IN_CREATE);
  FolderEvents published(out / "cases", IN_MOVED_TO);
  submit(out, {"--tasks", "10", "--largest-array", QString::number(kLargestArray)});
  // Four tasks have a processor each. The text of a lease is its holder's own.
  QSet<QByteArray> holders;
  const auto are_busy = [&] {
    for (const QString& name : names_in(out / "leases"))
      holders.insert(bytes_of(out / "leases" / name.toStdString()));
    holders.remove({});
    return holders.size() >= 4 && names_in(out / "cases").size() >= 20;
  };
  QTRY_VERIFY_WITH_TIMEOUT(are_busy(), 60'000);

  const QStringList on_a = slurm_->running_on("node-a");
  const QStringList on_b = slurm_->running_on("node-b");
  QCOMPARE(on_a.size(), 2);
  QCOMPARE(on_b.size(), 2);
  QCOMPARE(::kill(process_of(on_b[1], "node-b"), SIGKILL), 0);
  slurm_->must_run("scontrol update nodename=node-b state=drain reason=maintenance");
  slurm_->must_run("scontrol requeue " + on_b[0]);
  slurm_->must_run("scancel --signal=KILL " + on_a[0]);
  // As Slurm warns of a task's time limit.
  slurm_->must_run("scancel --batch --signal=TERM " + on_a[1]);
  const auto half_way = names_in(out / "cases").size();
  QVERIFY2(half_way < kBalls, "the tasks were not ended half-way");
  QCOMPARE(slurm_->wait_until_empty(), QString());
  QTRY_COMPARE(slurm_->must_run("sinfo --noheader --nodes=node-b --format=%T"), QByteArray("drained\n"));

  // What each task says shows how it has ended.
  const auto log = [&](const QString& task) {
    return bytes_of(out / fmt::format("slurm-{}.log", task.toStdString()));
  };
  for (const QString& task : {on_a[0], on_a[1], on_b[0]}) {
    QVERIFY2(log(task).contains("tidemark-cli: error: interrupted"), log(task).constData());
    // Only the requeued one has run again.
    QVERIFY2(log(task).contains("Cases      200") == (task == on_b[0]), log(task).constData());
  }
  QVERIFY2(!log(on_b[1]).contains("Cases") && !log(on_b[1]).contains("interrupted"),
           log(on_b[1]).constData());

  const QMap<QString, int> cases = published.by_name();
  QCOMPARE(cases.size(), kBalls);
  QCOMPARE(sum(cases), kBalls);
  // Names have the number of the holder, as in "ball007.1".
  const QMap<QString, int> computed = begun.by_name();
  for (auto one = computed.begin(); one != computed.end(); ++one)
    QVERIFY2(one.value() == 1, qPrintable(one.key()));
  QVERIFY2(computed.size() <= kBalls + 3 + kMostHeld, qPrintable(QString::number(computed.size())));
  const QJsonObject tally = json_of(test::must_run({"cohort", "run", text(out), "--json"}).out);
  QCOMPARE(tally["before"].toInt(), kBalls);
  QCOMPARE(tally["computed"].toInt(), 0);
  QCOMPARE(names_in(out / "leases"), QStringList());
  QCOMPARE(names_in(out / "staging"), QStringList());

  const auto by_segment = [&](int number) {
    return folder / ("by_segment_" + name_of(number).toStdString() + ".nii.gz");
  };
  ThreadPool pool;
  pool.for_each(kBalls, 1, [&](std::int64_t begin, std::int64_t end, int) {
    for (auto i = static_cast<int>(begin); i < static_cast<int>(end); ++i) {
      test::must_run(
          QStringList{"segment", text(study(i)), "--executor", "host", "--out", text(by_segment(i))} +
          kParameters);
    }
  });
  for (int i = 0; i < kBalls; ++i) {
    const std::string id = name_of(i).toStdString();
    const QJsonObject status = json_of(bytes_of(out / "cases" / id / "status.json"));
    QVERIFY2(status["outcome"].toString() == "done" && status["attempt"].toInt() == 1,
             (id + ": " + status["reason"].toString().toStdString()).c_str());
    const auto mask = imaging::load_mask(out / "cases" / id / "mask.nii.gz");
    QCOMPARE(failure(mask), QString());
    const auto expected = imaging::load_mask(by_segment(i));
    QCOMPARE(failure(expected), QString());
    QVERIFY2(mask->voxels == expected->voxels, id.c_str());
  }
}

void CohortSlurmTest::what_a_cancelled_array_has_left_is_done_when_it_is_submitted_again() {
  const TemporaryFolder folder;
  const auto out = folder / "cohort";
  test::must_run(
      QStringList{"cohort", "plan", text(studies_.path()), "--match", "ball00*.nii.gz", "--out", text(out)} +
      kParameters + kManySteps);
  slurm_->must_run("scontrol update nodename=node-b state=resume");
  FolderEvents published(out / "cases", IN_MOVED_TO);
  submit(out, {"--tasks", "2"});
  QTRY_VERIFY_WITH_TIMEOUT(!names_in(out / "cases").isEmpty(), 60'000);
  slurm_->must_run("scancel --name=tidemark-cohort");
  QCOMPARE(slurm_->wait_until_empty(), QString());
  QVERIFY2(names_in(out / "cases").size() < 10, "the array was not cancelled half-way");
  QCOMPARE(names_in(out / "staging"), QStringList());
  submit(out, {"--tasks", "2"});
  QCOMPARE(slurm_->wait_until_empty(), QString());
  const QMap<QString, int> cases = published.by_name();
  QCOMPARE(cases.size(), 10);
  QCOMPARE(sum(cases), 10);
  for (const QString& id : cases.keys()) {
    const auto status = out / "cases" / id.toStdString() / "status.json";
    QCOMPARE(json_of(bytes_of(status))["outcome"].toString(), QString("done"));
  }
}

// Slurm refuses a larger one, as it would without --largest-array.
void CohortSlurmTest::arrays_are_as_large_as_the_site_allows() {
  const Outcome outcome = slurm_->run("sbatch --array=0-" + QString::number(kLargestArray) + " --wrap true");
  QVERIFY2(outcome.code != 0 && outcome.err.contains("Invalid job array"), outcome.told().constData());
}

TIDEMARK_TEST(CohortSlurmTest)

}  // namespace tidemark::test::cohort_slurm_test

#include "cohort_slurm_test.moc"
