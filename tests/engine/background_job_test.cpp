// A job in the background tells its receiver how it was cut off, on the receiver's thread.
#include "engine/background_job.h"

#include <QTest>
#include <QThread>
#include <new>
#include <semaphore>
#include <stdexcept>

#include "tests/support/test_program.h"

namespace tidemark::test::background_job_test {

using namespace std::chrono_literals;

namespace {

constexpr int kPatience = 60'000;  // ms

}  // namespace

class BackgroundJobTest : public QObject {
  Q_OBJECT

 private slots:
  void cleanup() { QVERIFY(engine::BackgroundJob::finish_all(60s)); }

  void the_handler_hears_what_work_throws_on_the_receivers_thread() {
    QObject receiver;
    QStringList heard;
    const QThread* on = nullptr;
    const auto handler = [&](const Error& error) {
      heard << QString::fromStdString(error.message);
      on = QThread::currentThread();
    };
    engine::BackgroundJob::start(
        &receiver, [](engine::BackgroundJob&) { throw std::bad_alloc(); }, handler);
    QTRY_COMPARE_WITH_TIMEOUT(heard, QStringList{"there is not enough memory"}, kPatience);
    QCOMPARE(on, QThread::currentThread());
    engine::BackgroundJob::start(
        &receiver, [](engine::BackgroundJob&) { throw std::runtime_error("no paper"); }, handler);
    QTRY_COMPARE_WITH_TIMEOUT(heard.size(), 2, kPatience);
    QCOMPARE(heard.last(), QString("no paper"));
  }

  void what_was_delivered_before_comes_first() {
    QObject receiver;
    QStringList heard;
    engine::BackgroundJob::start(
        &receiver,
        [&heard](engine::BackgroundJob& job) {
          job.deliver([&heard] { heard << "a part"; });
          throw std::runtime_error("the rest is missing");
        },
        [&heard](const Error& error) { heard << QString::fromStdString(error.message); });
    QTRY_COMPARE_WITH_TIMEOUT(heard, (QStringList{"a part", "the rest is missing"}), kPatience);
  }

  void the_handler_hears_nothing_of_work_that_ends_well_or_is_abandoned() {
    QObject receiver;
    int heard = 0;
    const auto handler = [&](const Error&) { ++heard; };
    engine::BackgroundJob::start(
        &receiver, [](engine::BackgroundJob&) {}, handler);
    std::binary_semaphore go{0};
    const auto abandoned = engine::BackgroundJob::start(
        &receiver,
        [&go](engine::BackgroundJob&) {
          go.acquire();
          throw std::bad_alloc();
        },
        handler);
    abandoned->abandon();
    go.release();
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCoreApplication::processEvents();
    QCOMPARE(heard, 0);
  }

  void work_that_throws_without_a_handler_ends_alone() {
    QObject receiver;
    engine::BackgroundJob::start(&receiver, [](engine::BackgroundJob&) { throw std::bad_alloc(); });
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCoreApplication::processEvents();
  }
};

TIDEMARK_TEST(BackgroundJobTest)

}  // namespace tidemark::test::background_job_test

#include "background_job_test.moc"
