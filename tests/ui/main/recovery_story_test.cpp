// A program that is killed leaves its work behind, and the next one goes on with it.
#include <QApplication>
#include <QJsonDocument>
#include <QJsonObject>
#include <QProcess>
#include <QPushButton>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "document/autosave.h"
#include "document/recovery_folder.h"
#include "document/session_file.h"
#include "engine/background_job.h"
#include "engine/display_json.h"
#include "imaging/phantom/phantom.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/message_bar.h"
#include "ui/main/session_reader.h"

namespace tidemark::test::recovery_story_test {

constexpr const char* kVictim = "--work-until-killed";

// What must come back, as text: the same in both programs.
QString facts(const engine::CaseProxy& proxy) {
  const engine::CaseState& state = proxy.state();
  return QStringLiteral("%1 step %2 inside %3 labels %4 of %5 voxels")
      .arg(proxy.name())
      .arg(state.step)
      .arg(state.surface.voxels_inside)
      .arg(state.labels.size())
      .arg(state.label_statistics.empty() ? 0 : state.label_statistics.front().voxels);
}

std::size_t files_of_copies() {
  std::size_t count = 0;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(engine::recovery_folder(), ignored))
    count += entry.path().extension() == ".sha256" ? 1 : 0;
  return count;
}

// The program that will be killed: two cases with changes, of which copies are written by themselves.
int work_until_killed() {
  Desktop desktop(story_executor(), {900, 640});
  for (const char* kind : {"sphere", "dumbbell"}) {
    desktop.open_phantom(kind);
    engine::CaseProxy& proxy = desktop.proxy();
    desktop.begin(9.0);
    proxy.step(17);
    proxy.add_label("Ball");
    desktop.wait_until_idle();
    proxy.accept_surface(desktop.state().labels[0].id);
    // As many edits as bring about a copy, all before it is made.
    for (std::uint64_t edit = 0; edit < engine::CaseAutosave::kEdits; ++edit)
      proxy.paint({desktop.seed_mm(), 9.5}, solver::Brush::add, engine::CaseProxy::new_gesture());
    QTest::qWait(100);
    desktop.wait_until_idle();
  }
  if (!Desktop::wait_for([] { return files_of_copies() >= 2; })) return 1;
  for (ui::CaseWindow* window : desktop.window().cases()) std::puts(qPrintable(facts(window->proxy())));
  std::puts("ready");
  std::fflush(stdout);
  return QApplication::exec();
}

class RecoveryStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void work_is_there_again_after_a_kill();
  void a_damaged_session_brings_the_copies_that_there_are();
  void copies_are_offered_again_until_they_are_thrown_away();
  void the_copy_of_a_rescued_case_has_its_measurements();
  void nothing_is_offered_after_a_clean_end();

 private:
  static void leave_a_copy(Desktop& desktop, const std::string& view_state = "{}");

  TemporaryFolder home_;
};

void RecoveryStoryTest::work_is_there_again_after_a_kill() {
  qputenv("HOME", QByteArray::fromStdString(home_.path().string()));
  QVERIFY(document::find_recoverable(engine::recovery_folder()).empty());
  QProcess victim;
  victim.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  victim.start(QCoreApplication::applicationFilePath(), {kVictim});
  QByteArray said;
  QVERIFY2(Desktop::wait_for(
               [&] {
                 said += victim.readAllStandardOutput();
                 return said.contains("ready") || victim.state() == QProcess::NotRunning;
               },
               60000),
           said.constData());
  QVERIFY2(said.contains("ready"), said.constData());
  // While it runs, its copies are its own.
  QVERIFY(document::find_recoverable(engine::recovery_folder()).empty());
  victim.kill();
  QVERIFY(victim.waitForFinished());
  QCOMPARE(victim.exitStatus(), QProcess::CrashExit);
  QStringList expected = QString::fromUtf8(said).split('\n', Qt::SkipEmptyParts);
  expected.removeLast();
  expected.sort();
  QCOMPARE(expected.size(), 2);
  QCOMPARE(document::find_recoverable(engine::recovery_folder()).size(), std::size_t{2});

  Desktop desktop(story_executor(), {900, 640});
  QTimer user;
  QString offered;
  connect(&user, &QTimer::timeout, this, [&offered] {
    const auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (!box) return;
    offered = box->informativeText();
    for (QPushButton* button : box->findChildren<QPushButton*>()) {
      if (button->text().remove('&') == "Open them") return button->click();
    }
  });
  user.start(20);
  desktop.window().session_reader().offer_rescued();
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().size() == 2; }));
  user.stop();
  QVERIFY2(offered.contains("Sphere") && offered.contains("Dumbbell"), qPrintable(offered));
  desktop.wait_until_idle();
  QStringList found;
  for (ui::CaseWindow* window : desktop.window().cases()) {
    QVERIFY(window->proxy().state().modified);
    QVERIFY(window->session_file.isEmpty());
    found << facts(window->proxy());
  }
  found.sort();
  QCOMPARE(found, expected);
  for (ui::PictureView* view : desktop.window().active_case()->views()) QVERIFY(shows_a_picture(*view));
  qInfo("%s", qPrintable(found.join("; ")));
  // They have copies of their own, at once, instead of those that they came from.
  QVERIFY(Desktop::wait_for([] { return document::find_recoverable(engine::recovery_folder()).empty(); }));
  QVERIFY(files_of_copies() >= 2);

  Desktop::answer(QMessageBox::Discard);
  Desktop::answer(QMessageBox::Discard);
  QVERIFY(desktop.window().close());
  QVERIFY(Desktop::wait_for([] { return files_of_copies() == 0; }));
}

// Of the active case, as a program that died.
void RecoveryStoryTest::leave_a_copy(Desktop& desktop, const std::string& view_state) {
  bool kept = false;
  desktop.proxy().take_snapshot(view_state, [&kept](const auto& snapshot) {
    auto copies = document::Autosave::create(engine::recovery_folder(), document::new_copy_id());
    kept = copies && copies->write(snapshot->contents);
  });
  QVERIFY(Desktop::wait_for([&] { return kept; }));
}

void RecoveryStoryTest::a_damaged_session_brings_the_copies_that_there_are() {
  Desktop desktop(solver::ExecutorKind::host, {900, 640});
  QVERIFY(desktop.open_phantom("dumbbell"));
  desktop.begin(9.0);
  const std::string damaged = (home_ / "damaged.tidemark").string();
  { std::ofstream(damaged) << "PK, but nothing of ours"; }
  const auto* messages = desktop.window().findChild<ui::MessageBar*>();
  // Without copies it is said, and nothing is asked.
  desktop.window().open(QString::fromStdString(damaged));
  QVERIFY(Desktop::wait_for([&] { return !messages->text().isEmpty(); }));
  QVERIFY2(
      messages->text().contains(QString::fromStdString(damaged)) && messages->text().contains("another copy"),
      qPrintable(messages->text()));
  QVERIFY(!messages->text().contains("zip", Qt::CaseInsensitive));

  leave_a_copy(desktop);
  QString offered;
  QTimer user;
  connect(&user, &QTimer::timeout, this, [&offered] {
    const auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (!box || !box->isVisible()) return;
    offered = box->text() + box->informativeText();
    for (QPushButton* button : box->findChildren<QPushButton*>()) {
      if (button->text().remove('&') == "Open it") return button->click();
    }
  });
  user.start(20);
  desktop.window().open(QString::fromStdString(damaged));
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().size() == 2; }));
  user.stop();
  QVERIFY2(offered.contains("damaged.tidemark") && offered.contains("Dumbbell"), qPrintable(offered));
  desktop.wait_until_idle();
  QVERIFY(desktop.state().begun);
  // What could not be opened is over.
  QCOMPARE(messages->text(), QString());
  for (int window = 0; window < 2; ++window) Desktop::answer(QMessageBox::Discard);
  QVERIFY(desktop.window().close());
  QVERIFY(Desktop::wait_for([] { return files_of_copies() == 0; }));
}

void RecoveryStoryTest::copies_are_offered_again_until_they_are_thrown_away() {
  Desktop desktop(solver::ExecutorKind::host, {900, 640});
  QVERIFY(desktop.open_phantom("dumbbell"));
  desktop.begin(9.0);
  for (int copy = 0; copy < 2; ++copy) leave_a_copy(desktop);
  const auto kept = [] { return document::find_recoverable(engine::recovery_folder()).size(); };
  QCOMPARE(kept(), std::size_t{2});
  const auto reply = [&](const QString& wanted) {
    bool pressed = false;
    QTimer user;
    connect(&user, &QTimer::timeout, this, [&] {
      const auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (!box) return;
      for (QPushButton* button : box->findChildren<QPushButton*>()) {
        if (button->text().remove('&') != wanted) continue;
        pressed = true;
        return button->click();
      }
    });
    user.start(20);
    desktop.window().session_reader().offer_rescued();
    QVERIFY(Desktop::wait_for([&] { return pressed; }));
    desktop.wait_until_idle();
    QCOMPARE(desktop.window().cases().size(), 1);
  };
  reply("Ask again later");
  QCOMPARE(kept(), std::size_t{2});
  reply("Throw them away");
  QCOMPARE(kept(), std::size_t{0});
  Desktop::answer(QMessageBox::Discard);
  QVERIFY(desktop.window().close());
  QVERIFY(Desktop::wait_for([] { return files_of_copies() == 0; }));
}

// It replaces the copy that the case came from.
void RecoveryStoryTest::the_copy_of_a_rescued_case_has_its_measurements() {
  {
    Desktop desktop(solver::ExecutorKind::host, {900, 640});
    QVERIFY(desktop.open_phantom("sphere"));
    desktop.begin(9.0);
    desktop.proxy().display().change([](engine::DisplaySettings& settings) {
      settings.measurements = {{engine::Measurement::Kind::distance, {glm::dvec3(0.0), glm::dvec3(5.0)}}};
    });
    leave_a_copy(desktop, desktop.window().active_case()->view_state());
    Desktop::answer(QMessageBox::Discard);
    QVERIFY(desktop.window().close());
  }
  Desktop desktop(solver::ExecutorKind::host, {900, 640});
  QTimer user;
  connect(&user, &QTimer::timeout, this, [] {
    const auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (!box) return;
    for (QPushButton* button : box->findChildren<QPushButton*>()) {
      if (button->text().remove('&') == "Open it") return button->click();
    }
  });
  user.start(20);
  desktop.window().session_reader().offer_rescued();
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().size() == 1; }));
  user.stop();
  QVERIFY(Desktop::wait_for([] { return document::find_recoverable(engine::recovery_folder()).empty(); }));
  QStringList measured;
  for (const auto& entry : std::filesystem::directory_iterator(engine::recovery_folder())) {
    if (entry.path().extension() != ".tidemark") continue;
    const auto copy = document::load_session(entry.path());
    QCOMPARE(failure(copy), QString());
    const auto state = QJsonDocument::fromJson(QByteArray::fromStdString(copy->view_state)).object();
    const auto shown = engine::display_settings(state["display"].toString().toStdString(), {});
    QCOMPARE(failure(shown), QString());
    measured << QString::number(shown->measurements.size());
  }
  QCOMPARE(measured, QStringList{"1"});
  Desktop::answer(QMessageBox::Discard);
  QVERIFY(desktop.window().close());
  QVERIFY(Desktop::wait_for([] { return files_of_copies() == 0; }));
}

void RecoveryStoryTest::nothing_is_offered_after_a_clean_end() {
  {
    Desktop desktop(story_executor(), {900, 640});
    QVERIFY(desktop.open_phantom("sphere"));
    desktop.begin(9.0);
    desktop.window().active_case()->autosave().save_now();
    QVERIFY(Desktop::wait_for([] { return files_of_copies() == 1; }));
    Desktop::answer(QMessageBox::Discard);
    QVERIFY(desktop.window().close());
    QVERIFY(Desktop::wait_for([] { return files_of_copies() == 0; }));
  }
  Desktop desktop(story_executor(), {900, 640});
  QTimer user;
  int questions = 0;
  connect(&user, &QTimer::timeout, this, [&questions] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (box) box->reject();
    questions += box ? 1 : 0;
  });
  user.start(20);
  desktop.window().session_reader().offer_rescued();
  QVERIFY(engine::BackgroundJob::finish_all(std::chrono::seconds(60)));
  QCoreApplication::processEvents();  // what the job delivered
  QCOMPARE(questions, 0);
  QVERIFY(desktop.window().cases().isEmpty());
}

static const tidemark::test::RegisteredTest kVictimProcess(kVictim,
                                                           [](int, char**) { return work_until_killed(); });

TIDEMARK_TEST(RecoveryStoryTest)

}  // namespace tidemark::test::recovery_story_test

#include "recovery_story_test.moc"
