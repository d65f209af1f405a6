// One piece of work at a time, in the background: how it ends, what is heard of it, how it is given up.
#include "engine/job_runner.h"

#include <QSignalSpy>
#include <semaphore>
#include <stdexcept>
#include <string>
#include <thread>

#include "engine/background_job.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::job_runner_test {

using namespace std::chrono_literals;

namespace {

constexpr int kPatience = 60'000;  // ms

class Runner : public engine::JobRunner {
 public:
  template <class Work>
  void number(Work work) {
    run(std::move(work), [this](int value) { numbers << value; });
  }
  template <class Work>
  void nothing(Work work) {
    run(std::move(work), [this] { numbers << 0; });
  }
  using JobRunner::ask_to_stop;
  using JobRunner::give_up;

  QList<int> numbers;
};

Status until_stopped(const Progress& progress) {
  while (!progress.cancelled()) std::this_thread::sleep_for(1ms);
  return cancelled_error();
}

}  // namespace

class JobRunnerTest : public QObject {
  Q_OBJECT

 private slots:
  void cleanup() { QVERIFY(engine::BackgroundJob::finish_all(60s)); }

  void values_and_errors_come_to_the_thread_that_asked() {
    Runner runner;
    QSignalSpy failed(&runner, &engine::JobRunner::failed);
    runner.number([](const Progress&) -> Result<int> { return 7; });
    QVERIFY(runner.busy());
    QTRY_COMPARE_WITH_TIMEOUT(runner.numbers, QList<int>{7}, kPatience);
    QVERIFY(!runner.busy());
    runner.nothing([](const Progress&) -> Status { return {}; });
    QTRY_COMPARE_WITH_TIMEOUT(runner.numbers, (QList<int>{7, 0}), kPatience);
    runner.number([](const Progress&) -> Result<int> { return fail(ErrorKind::input, "no number"); });
    QTRY_COMPARE_WITH_TIMEOUT(failed.size(), 1, kPatience);
    QCOMPARE(failed[0][0].toString(), QString("no number"));
    QCOMPARE(runner.numbers.size(), 2);
  }

  void what_work_throws_is_a_failure() {
    Runner runner;
    QSignalSpy failed(&runner, &engine::JobRunner::failed);
    runner.number([](const Progress&) -> Result<int> { throw std::bad_alloc(); });
    QTRY_COMPARE_WITH_TIMEOUT(failed.size(), 1, kPatience);
    QCOMPARE(failed[0][0].toString(), QString("there is not enough memory"));
    runner.nothing([](const Progress&) -> Status { throw std::runtime_error("the disk is on fire"); });
    QTRY_COMPARE_WITH_TIMEOUT(failed.size(), 2, kPatience);
    QCOMPARE(failed[1][0].toString(), QString("the disk is on fire"));
    QVERIFY(!runner.busy());
  }

  void of_what_was_given_up_nothing_is_heard() {
    Runner runner;
    QSignalSpy cancelled(&runner, &engine::JobRunner::cancelled);
    QSignalSpy failed(&runner, &engine::JobRunner::failed);
    runner.nothing(until_stopped);
    runner.number([](const Progress&) -> Result<int> { return 1; });  // in its place
    QTRY_COMPARE_WITH_TIMEOUT(runner.numbers, QList<int>{1}, kPatience);
    runner.nothing(until_stopped);
    runner.give_up();
    QVERIFY(!runner.busy());
    QCOMPARE(cancelled.size(), 1);
    runner.give_up();  // there is nothing to give up
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCoreApplication::processEvents();
    QCOMPARE(cancelled.size(), 1);
    QCOMPARE(failed.size(), 0);
    QCOMPARE(runner.numbers, QList<int>{1});
  }

  void what_is_asked_to_stop_says_how_it_ended() {
    Runner runner;
    QSignalSpy cancelled(&runner, &engine::JobRunner::cancelled);
    runner.ask_to_stop();  // nobody is there
    runner.nothing(until_stopped);
    runner.ask_to_stop();
    QVERIFY(runner.busy());
    QTRY_COMPARE_WITH_TIMEOUT(cancelled.size(), 1, kPatience);
    QVERIFY(!runner.busy());
    // Work past stopping is done.
    std::binary_semaphore go{0};
    runner.number([&go](const Progress&) -> Result<int> {
      go.acquire();
      return 2;
    });
    runner.ask_to_stop();
    go.release();
    QTRY_COMPARE_WITH_TIMEOUT(runner.numbers, QList<int>{2}, kPatience);
    QCOMPARE(cancelled.size(), 1);
  }

  void of_many_steps_the_last_is_heard_in_words_for_people() {
    Runner runner;
    QSignalSpy progressed(&runner, &engine::JobRunner::progressed);
    std::binary_semaphore said{0};
    runner.nothing([&said](const Progress& progress) -> Status {
      for (int step = 0; step <= 1000; ++step) progress(step / 1000.0, "step " + std::to_string(step));
      said.release();
      return {};
    });
    said.acquire();  // nobody has listened yet
    QTRY_COMPARE_WITH_TIMEOUT(runner.numbers.size(), 1, kPatience);
    QCOMPARE(progressed.size(), 1);
    QCOMPARE(progressed[0][0].toDouble(), 1.0);
    QCOMPARE(progressed[0][1].toString(), QString("Step 1000"));
  }

  void it_goes_while_work_runs() {
    {
      Runner runner;
      runner.nothing(until_stopped);
    }
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCoreApplication::processEvents();
  }
};

TIDEMARK_TEST(JobRunnerTest)

}  // namespace tidemark::test::job_runner_test

#include "job_runner_test.moc"
