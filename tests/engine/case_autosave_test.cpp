// Copies against a crash: what happens when the case cannot be read, and when the folder cannot be written.
#include "engine/case_autosave.h"

#include <QSignalSpy>
#include <QTest>
#include <fstream>
#include <future>

#include "document/autosave.h"
#include "engine/background_job.h"
#include "engine/case_proxy.h"
#include "engine/case_runner.h"
#include "engine/engine.h"
#include "tests/engine/ball_case.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::case_autosave_test {

using namespace std::chrono_literals;

namespace {

constexpr int kPatience = 60'000;  // ms

// A case with a surface that has been edited, and its copies.
struct Edited : test::BallCase {
  explicit Edited(std::filesystem::path folder, solver::ExecutorKind executor = solver::ExecutorKind::host)
      : BallCase(executor, executor != solver::ExecutorKind::host),
        autosave(proxy, std::move(folder), [] { return std::string(); }) {
    begin();
    proxy.step(3);
    wait_until_idle();
  }

  engine::CaseAutosave autosave;
};

class Unclosable final : public document::OpenChange {
 public:
  [[nodiscard]] document::Steering steering() const override { return {}; }
  [[nodiscard]] document::ChangeDescription description() const override { return {}; }
  [[nodiscard]] std::int64_t bytes() const override { return 0; }
  Status close() override { return fail(ErrorKind::internal, "there is no way to close it"); }
};

}  // namespace

class CaseAutosaveTest : public QObject {
  Q_OBJECT

 private slots:
  void cleanup() { QVERIFY(engine::BackgroundJob::finish_all(60s)); }

  // What cannot be closed cannot be copied: the case says why, and the next attempt is a copy.
  void a_copy_that_was_given_up_is_made_the_next_time() {
    const test::TemporaryFolder folder;
    Edited edited(folder / "recovery");
    QVERIFY(edited.proxy.state().modified);
    QSignalSpy saved(&edited.autosave, &engine::CaseAutosave::saved);
    QSignalSpy failed(&edited.autosave, &engine::CaseAutosave::failed);
    Unclosable change;
    edited.proxy.runner()->post([&](engine::CaseRunner& runner, const Progress&) -> Status {
      TIDEMARK_TRY(runner.document().history().close());
      runner.document().history().open(change);
      return {};
    });
    edited.autosave.save_now();
    QTRY_COMPARE_WITH_TIMEOUT(edited.failures, QStringList{"there is no way to close it"}, kPatience);
    edited.wait_until_idle();
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCoreApplication::processEvents();
    QCOMPARE(saved.size(), 0);
    QCOMPARE(failed.size(), 0);
    QVERIFY(document::find_recoverable(folder / "recovery").empty());
    edited.autosave.save_now();
    QTRY_COMPARE_WITH_TIMEOUT(saved.size(), 1, kPatience);
    QCOMPARE(failed.size(), 0);
    QCOMPARE(edited.failures.size(), 1);
  }

  // phi is read back for a copy: who steers hears that something was lost, and the next copy is whole.
  void a_context_that_is_lost_at_a_copy_is_told_of_and_made_good() {
    const test::TemporaryFolder folder;
    Edited edited(folder / "recovery", solver::ExecutorKind::compute);
    QSignalSpy saved(&edited.autosave, &engine::CaseAutosave::saved);
    QSignalSpy failed(&edited.autosave, &engine::CaseAutosave::failed);
    const auto step = edited.proxy.state().step;
    QVERIFY(step > 0);
    engine::Engine& engine = edited.engine;
    // The copy is the next job after an edit that nobody has read back.
    std::promise<void> asked;
    edited.proxy.runner()->post([&](engine::CaseRunner& runner, const Progress&) -> Status {
      TIDEMARK_TRY(runner.document().level_set().paint({{20.0, 20.0, 20.0}, 5.0}, solver::Brush::add, 7));
      engine.device()->lose_at_check(1);
      asked.get_future().wait();
      return {};
    });
    edited.autosave.save_now();
    asked.set_value();
    QTRY_COMPARE_WITH_TIMEOUT(edited.failures.size(), 1, kPatience);
    qInfo("%s", qPrintable(edited.failures.front()));
    edited.proxy.step(2);
    QTRY_VERIFY_WITH_TIMEOUT(edited.proxy.state().step > step, kPatience);
    edited.wait_until_idle();
    QCOMPARE(engine.contexts_made(), 2);
    edited.autosave.save_now();
    QTRY_COMPARE_WITH_TIMEOUT(saved.size(), 1, kPatience);
    QCOMPARE(failed.size(), 0);
    QCOMPARE(edited.failures.size(), 1);
  }

  // It is said once; to try again every half minute would say it again and again.
  void a_folder_that_cannot_be_written_is_told_once() {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "recovery") << "a file in the folder's place";
    Edited edited(folder / "recovery");
    QSignalSpy saved(&edited.autosave, &engine::CaseAutosave::saved);
    QSignalSpy failed(&edited.autosave, &engine::CaseAutosave::failed);
    edited.autosave.save_now();
    QTRY_COMPARE_WITH_TIMEOUT(failed.size(), 1, kPatience);
    QVERIFY2(failed[0][0].toString().contains("recovery"), qPrintable(failed[0][0].toString()));
    edited.proxy.step(3);
    edited.wait_until_idle();
    edited.autosave.save_now();
    edited.wait_until_idle();
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCoreApplication::processEvents();
    QCOMPARE(failed.size(), 1);
    QCOMPARE(saved.size(), 0);
  }
};

TIDEMARK_TEST(CaseAutosaveTest)

}  // namespace tidemark::test::case_autosave_test

#include "case_autosave_test.moc"
