// A cohort of ten thousand small cases, a thousand under sanitizers, killed at random moments and resumed.
// Prints what it cost.
#include <signal.h>

#include <QElapsedTimer>
#include <QJsonArray>
#include <random>

#include "core/thread_pool.h"
#include "imaging/files/volume_file.h"
#include "tests/app/cli_runner.h"
#include "tests/app/folder_events.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cohort_scale_test {

namespace {

#ifdef TIDEMARK_SANITIZED
constexpr int kCases = 1'000;
#else
constexpr int kCases = 10'000;
#endif
constexpr int kKills = 20;
constexpr int kJobs = 2;
constexpr Index3 kSize{32};
const QStringList kParameters{"--target", "1000", "--range",   "400",
                              "--alpha",  "0.6",  "--seed-mm", "15.5,15.5,15.5,3"};

std::string name_of(int number) {
  return fmt::format("ball{:05}.nii.gz", number);
}

// Balls with noise, so that their files are as large as those of real volumes.
void write_balls(const std::filesystem::path& folder) {
  ThreadPool pool;
  pool.for_each(kCases, 16, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t i = begin; i < end; ++i) {
      const int number = static_cast<int>(i);
      Volume volume = ball(kSize, 5.0 + 0.0005 * number);
      std::minstd_rand random(static_cast<unsigned>(number + 1));
      for (std::int16_t& value : std::get<std::vector<std::int16_t>>(volume.voxels)) {
        value = static_cast<std::int16_t>(value + static_cast<int>(random() % 256) - 128);
      }
      if (!imaging::write_volume_file(volume, folder / name_of(number))) qFatal("a ball was not written");
    }
  });
}

double seconds(const QElapsedTimer& timer) {
  return static_cast<double>(timer.nsecsElapsed()) * 1e-9;
}

// In kilobytes, of a process that runs.
qint64 memory_of(const QProcess& process) {
  const QByteArray status = bytes_of(fmt::format("/proc/{}/status", process.processId()));
  const qsizetype at = status.indexOf("RssAnon:");
  return at < 0 ? 0 : status.mid(at + 8, status.indexOf("kB", at) - at - 8).trimmed().toLongLong();
}

}  // namespace

class CohortScaleTest : public QObject {
  Q_OBJECT

 private slots:
  void initTestCase();
  void killed_at_random_moments_no_case_is_lost_and_none_is_done_twice();
  void a_run_takes_no_more_memory_the_longer_it_is();

 private:
  void plan(const std::filesystem::path& out) const {
    must_run(QStringList{"cohort", "plan", text(studies_.path()), "--out", text(out)} + kParameters);
  }
  TemporaryFolder studies_;
};

void CohortScaleTest::initTestCase() {
  write_balls(studies_.path());
  const TemporaryFolder folder;
  QElapsedTimer timer;
  timer.start();
  plan(folder / "cohort");
  qInfo("planned %d cases of a folder in %.1f s", kCases, seconds(timer));
  timer.start();
  must_run({"cohort", "plan", text(folder / "cohort" / "work.csv"), "--out", text(folder / "again")});
  qInfo("planned %d rows of a list in %.1f s", kCases, seconds(timer));
}

void CohortScaleTest::killed_at_random_moments_no_case_is_lost_and_none_is_done_twice() {
  const TemporaryFolder folder;
  const auto out = folder / "cohort";
  plan(out);
  FolderEvents published(out / "cases", IN_MOVED_TO);
  std::mt19937 random(7);
  std::uniform_int_distribution<int> some(
      0, kCases / (kKills + 5));                    // cases: with each kill so many, less than all
  std::uniform_int_distribution<int> delay(0, 40);  // ms
  for (int kills = 0; kills < kKills; ++kills) {
    const qsizetype enough = published.by_name().size() + some(random);
    QProcess process;
    process.start(cli_program(), {"cohort", "run", text(out), "--jobs", QString::number(kJobs)});
    QVERIFY(process.waitForStarted());
    const auto number = static_cast<pid_t>(process.processId());
    while (published.by_name().size() < enough) QVERIFY(!process.waitForFinished(5));
    QVERIFY(!process.waitForFinished(delay(random)));
    QCOMPARE(::kill(number, SIGKILL), 0);
    process.waitForFinished();
  }
  must_run({"cohort", "run", text(out), "--jobs", QString::number(kJobs)});
  const QMap<QString, int> cases = published.by_name();
  QCOMPARE(cases.size(), kCases);
  for (auto one = cases.begin(); one != cases.end(); ++one) QVERIFY2(one.value() == 1, qPrintable(one.key()));
  const QJsonObject tally = json_of(must_run({"cohort", "run", text(out), "--json"}).out);
  QCOMPARE(tally["before"].toInt(), kCases);
  QCOMPARE(tally["computed"].toInt(), 0);
  QCOMPARE(names_in(out / "leases"), QStringList());
  QCOMPARE(names_in(out / "staging"), QStringList());

  QElapsedTimer timer;
  timer.start();
  const QJsonObject report = json_of(must_run({"cohort", "report", text(out), "--json"}).out);
  qInfo("reported on %d cases in %.1f s, a page of %.1f MB", kCases, seconds(timer),
        static_cast<double>(std::filesystem::file_size(out / "report.html")) * 1e-6);
  QCOMPARE(bytes_of(out / "report.csv").count('\n'), kCases + 1);
  QCOMPARE(bytes_of(out / "report.html").count("<article"), kCases);
}

void CohortScaleTest::a_run_takes_no_more_memory_the_longer_it_is() {
  const TemporaryFolder folder;
  const auto out = folder / "cohort";
  plan(out);
  FolderEvents published(out / "cases", IN_MOVED_TO);
  QElapsedTimer timer;
  timer.start();
  QProcess process;
  process.start(cli_program(), {"cohort", "run", text(out), "--jobs", QString::number(kJobs)});
  const auto memory_after = [&](int cases) {
    while (published.by_name().size() < cases && !process.waitForFinished(200)) {
    }
    return memory_of(process);
  };
  const qint64 early = memory_after(kCases / 20);
  const qint64 late = memory_after(kCases - kCases / 20);
  QVERIFY(process.waitForFinished(-1));
  const double total = seconds(timer);
  QCOMPARE(process.exitCode(), 0);
  qInfo("memory: %lld kB, then %lld kB", static_cast<long long>(early), static_cast<long long>(late));
#ifndef TIDEMARK_SANITIZED  // what is freed stays with the sanitizer
  QVERIFY2(early > 0 && late - early < 4096, qPrintable(QString("%1 kB, then %2 kB").arg(early).arg(late)));
#endif

  double in_solver = 0.0;
  for (int i = 0; i < kCases; ++i) {
    const auto id = fmt::format("ball{:05}", i);
    const QJsonObject status = json_of(bytes_of(out / "cases" / id / "status.json"));
    QVERIFY2(status["outcome"].toString() == "done", id.c_str());
    in_solver += status["figures"]["solver_seconds"].toDouble();
  }
  qInfo("computed %d cases in %.1f s by %d at once: %.2f ms a case, %.2f ms of them beside the solver",
        kCases, total, kJobs, 1e3 * total / kCases, 1e3 * (total - in_solver / kJobs) / kCases);
}

TIDEMARK_TEST(CohortScaleTest)

}  // namespace tidemark::test::cohort_scale_test

#include "cohort_scale_test.moc"
