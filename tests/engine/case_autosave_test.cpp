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

}  // namespace

class CaseAutosaveTest : public QObject {
  Q_OBJECT

 private slots:
  void cleanup() { QVERIFY(engine::BackgroundJob::finish_all(60s)); }

  // What cannot be read back cannot be copied: the case says why, and the next attempt is a copy.
  void a_copy_that_was_given_up_is_made_the_next_time() {
    const test::TemporaryFolder folder;
    Edited edited(folder / "recovery", solver::ExecutorKind::compute);
    QVERIFY(edited.proxy.state().modified);
    QSignalSpy saved(&edited.autosave, &engine::CaseAutosave::saved);
    QSignalSpy failed(&edited.autosave, &engine::CaseAutosave::failed);
    std::promise<void> asked;
    edited.proxy.runner()->post([&](engine::CaseRunner& runner, const Progress&) -> Status {
      TIDEMARK_TRY(runner.document().level_set().paint({{20.0, 20.0, 20.0}, 5.0}, solver::Brush::add, 7));
      edited.engine.device()->lose_at_check(1);
      asked.get_future().wait();
      return {};
    });
    edited.autosave.save_now();
    asked.set_value();
    QTRY_COMPARE_WITH_TIMEOUT(edited.failures.size(), 1, kPatience);
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

  // Images, a truth and measurements are no edits of the history; each change of them is in the next copy.
  void what_lies_beside_the_history_is_copied() {
    const test::TemporaryFolder folder;
    Edited edited(folder / "recovery");
    QSignalSpy saved(&edited.autosave, &engine::CaseAutosave::saved);
    const auto copies_after_another_save = [&] {
      edited.autosave.save_now();
      edited.wait_until_idle();
      static_cast<void>(engine::BackgroundJob::finish_all(60s));
      QCoreApplication::processEvents();
      return saved.size();
    };
    const auto add_image = [&](const char* name) {
      engine::ShownImage shown;
      auto image = std::make_shared<document::CaseImage>();
      image->name = name;
      image->checksum = name;
      shown.image = image;
      edited.proxy.display().change(
          [&](engine::DisplaySettings& settings) { settings.images.push_back(shown); });
    };
    QCOMPARE(copies_after_another_save(), 1);
    QCOMPARE(copies_after_another_save(), 1);  // nothing is new
    add_image("first");
    QCOMPARE(copies_after_another_save(), 2);
    add_image("second");
    QCOMPARE(copies_after_another_save(), 3);
    auto truth = std::make_shared<BitMask>(edited.proxy.volume().geometry);
    truth->add(0);
    edited.proxy.compare_with(truth);
    edited.wait_until_idle();
    QCOMPARE(copies_after_another_save(), 4);
    const auto measure = [&](engine::Measurement::Kind kind) {
      edited.proxy.display().change([&](engine::DisplaySettings& settings) {
        settings.measurements.push_back({kind, {glm::dvec3(1.0), glm::dvec3(2.0)}});
      });
    };
    measure(engine::Measurement::Kind::distance);
    QCOMPARE(copies_after_another_save(), 5);
    measure(engine::Measurement::Kind::angle);  // one end is missing
    QCOMPARE(copies_after_another_save(), 5);
  }

  // A stroke that is still open, as the last one is, is in the next copy.
  void a_stroke_that_is_open_is_copied() {
    const test::TemporaryFolder folder;
    Edited edited(folder / "recovery");
    QSignalSpy saved(&edited.autosave, &engine::CaseAutosave::saved);
    for (int copies = 1; copies <= 2; ++copies) {
      edited.proxy.paint({edited.middle(), 5.0 + copies}, solver::Brush::add,
                         engine::CaseProxy::new_gesture());
      edited.wait_until_idle();
      edited.autosave.save_now();
      QTRY_COMPARE_WITH_TIMEOUT(saved.size(), copies, kPatience);
      edited.wait_until_idle();
    }
    // The stroke is open still, and nothing of it is new.
    edited.autosave.save_now();
    edited.wait_until_idle();
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCoreApplication::processEvents();
    QCOMPARE(saved.size(), 2);
  }

  void a_stroke_goes_on_over_a_copy() {
    const test::TemporaryFolder folder;
    Edited edited(folder / "recovery");
    QSignalSpy saved(&edited.autosave, &engine::CaseAutosave::saved);
    const std::vector<float> before = edited.proxy.state().phi->dense();
    const std::uint64_t stroke = engine::CaseProxy::new_gesture();
    for (int copies = 1; copies <= 2; ++copies) {
      edited.proxy.paint({edited.middle() + glm::dvec3(4.0 * copies, 0.0, 0.0), 5.0}, solver::Brush::add,
                         stroke);
      edited.wait_until_idle();
      edited.autosave.save_now();
      QTRY_COMPARE_WITH_TIMEOUT(saved.size(), copies, kPatience);
    }
    QVERIFY(edited.proxy.state().phi->dense() != before);
    edited.proxy.undo();
    edited.wait_until_idle();
    QVERIFY(edited.proxy.state().phi->dense() == before);
    QCOMPARE(edited.failures, QStringList());
  }

  void a_slider_goes_on_over_a_copy() {
    const test::TemporaryFolder folder;
    Edited edited(folder / "recovery");
    QSignalSpy saved(&edited.autosave, &engine::CaseAutosave::saved);
    const double before = edited.proxy.parameters().target;
    const std::uint64_t drag = engine::CaseProxy::new_gesture();
    for (int copies = 1; copies <= 2; ++copies) {
      edited.proxy.change_parameters(
          [&](solver::Parameters& wanted) { wanted.target = before + 10.0 * copies; }, drag);
      edited.wait_until_idle();
      edited.autosave.save_now();
      QTRY_COMPARE_WITH_TIMEOUT(saved.size(), copies, kPatience);
    }
    edited.proxy.undo();
    edited.wait_until_idle();
    QCOMPARE(edited.proxy.state().parameters.target, before);
  }

  void copies_are_made_as_time_goes_by() {
    const test::TemporaryFolder folder;
    Edited edited(folder / "rare");
    engine::CaseAutosave often(
        edited.proxy, folder / "recovery", [] { return std::string(); }, 50ms);
    QSignalSpy saved(&often, &engine::CaseAutosave::saved);
    QTRY_COMPARE_WITH_TIMEOUT(saved.size(), 1, kPatience);
    edited.wait_until_idle();
    edited.proxy.step(3);
    QTRY_VERIFY_WITH_TIMEOUT(saved.size() > 1, kPatience);
  }

  // A case that cannot go on cannot be saved either: its last copy outlives it.
  void the_copy_of_a_case_that_gave_up_stays() {
    const test::TemporaryFolder folder;
    {
      Edited edited(folder / "recovery");
      QSignalSpy saved(&edited.autosave, &engine::CaseAutosave::saved);
      edited.autosave.save_now();
      QTRY_COMPARE_WITH_TIMEOUT(saved.size(), 1, kPatience);
      emit edited.proxy.given_up();
    }
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCOMPARE(document::find_recoverable(folder / "recovery").size(), std::size_t{1});
  }

  // Each attempt fails again, and only the first is worth a word.
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

  void copies_are_made_again_once_there_is_room() {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "recovery") << "a file in the folder's place";
    Edited edited(folder / "recovery");
    QSignalSpy saved(&edited.autosave, &engine::CaseAutosave::saved);
    QSignalSpy failed(&edited.autosave, &engine::CaseAutosave::failed);
    edited.autosave.save_now();
    QTRY_COMPARE_WITH_TIMEOUT(failed.size(), 1, kPatience);
    edited.wait_until_idle();
    std::filesystem::remove(folder / "recovery");
    edited.autosave.save_now();  // nothing was done since the last attempt
    QTRY_COMPARE_WITH_TIMEOUT(saved.size(), 1, kPatience);
    QCOMPARE(failed.size(), 1);
  }
};

TIDEMARK_TEST(CaseAutosaveTest)

}  // namespace tidemark::test::case_autosave_test

#include "case_autosave_test.moc"
