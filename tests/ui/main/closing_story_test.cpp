// Sessions, files that are written, and the closing of cases, alone and at Quit.
#include <QApplication>
#include <QFileInfo>
#include <QMenu>
#include <QMenuBar>
#include <QMessageBox>
#include <QPointer>
#include <QTimer>
#include <filesystem>
#include <functional>
#include <future>
#include <memory>
#include <utility>

#include "core/atomic_file.h"
#include "imaging/files/volume_file.h"
#include "imaging/load_study.h"
#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/main/desktop.h"
#include "ui/main/case_exports.h"
#include "ui/main/case_files.h"
#include "ui/main/message_bar.h"

namespace tidemark::test::closing_story_test {

namespace {

QString path(const std::filesystem::path& file) {
  return QString::fromStdString(file.string());
}

// A cube of voxels, whose values begin with the darkest one.
void write_study(const std::filesystem::path& file, int darkest, std::int64_t edge = 24) {
  Volume volume;
  volume.geometry.size = Index3(edge);
  std::vector<std::int16_t> values;
  for (std::int64_t n = 0; n < volume.geometry.voxel_count(); ++n)
    values.push_back(static_cast<std::int16_t>(darkest + n % 500));
  volume.voxels = std::move(values);
  const Status written = imaging::write_volume_file(volume, file);
  if (!written) qFatal("%s", written.error().message.c_str());
}

// A phantom with a surface, which is not saved.
ui::CaseWindow* begin_phantom(Desktop& desktop, const char* kind) {
  ui::CaseWindow* window = desktop.open_phantom(kind);
  if (!window) qFatal("no %s", kind);
  desktop.begin(8.0);
  return window;
}

// A session of the study, with a label, is left by a case that is closed.
void leave_session(Desktop& desktop, const QString& study, const QString& session) {
  QVERIFY(desktop.open(study));
  desktop.proxy().add_label("kept");
  desktop.wait_until_idle();
  QVERIFY(desktop.save_session(session));
  desktop.close_case();
}

// The engine does nothing until the promise is kept or gone.
std::promise<void> hold(Desktop& desktop) {
  std::promise<void> until;
  desktop.engine().post(engine::Priority::edit, nullptr,
                        [done = until.get_future().share()](const std::stop_token&) { done.wait(); });
  return until;
}

// Writes the text once the promise is kept or gone.
ui::CaseFiles::Work write_later(std::promise<void>& promise, const std::filesystem::path& file,
                                const char* text) {
  return [file, text, held = promise.get_future().share()] {
    held.wait();
    return write_file(file, text);
  };
}

// Does that with each question that is open, until the timer stops.
std::unique_ptr<QTimer> at_each_question(const std::function<void(QMessageBox&)>& something) {
  auto timer = std::make_unique<QTimer>();
  QObject::connect(timer.get(), &QTimer::timeout, timer.get(), [something] {
    if (auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget())) something(*box);
  });
  timer->start(20);
  return timer;
}

// Cancels each question, and counts them.
std::unique_ptr<QTimer> cancel_each_question(int& questions) {
  return at_each_question([&questions](QMessageBox& box) {
    ++questions;
    box.button(QMessageBox::Cancel)->click();
  });
}

QString told(Desktop& desktop) {
  return desktop.window().findChild<ui::MessageBar*>()->text();
}

// Closes the last case, after a quit that was given up: the window stays.
void close_the_last_case(Desktop& desktop) {
  QCOMPARE(desktop.window().cases().size(), 1);
  desktop.window().cases().front()->close_saved();
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
  QTest::qWait(200);
  QVERIFY(desktop.window().isVisible());
}

}  // namespace

class ClosingStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void a_session_is_among_the_recent_studies();
  void a_quit_that_was_given_up_stays_given_up_data();
  void a_quit_that_was_given_up_stays_given_up();
  void a_quit_ends_with_a_study_that_comes_meanwhile_data();
  void a_quit_ends_with_a_study_that_comes_meanwhile();
  void a_case_that_is_kept_at_quit_keeps_the_others();
  void a_session_is_open_once();
  void a_session_of_other_voxels_is_not_written_over();
  void a_session_of_another_grid_is_refused();
  void the_session_of_another_case_is_not_written_over();
  void a_file_of_the_study_is_never_written_to();
  void a_case_that_is_changed_while_it_is_saved_stays_open();
  void a_case_that_is_being_saved_asks_no_second_time();
  void a_case_that_stays_open_goes_on_asking();
  void two_cases_are_not_saved_into_one_file();
  void a_case_that_is_saved_may_go_while_another_one_asks_at_quit();
  void the_last_of_two_writes_to_one_file_counts();
  void quitting_waits_for_files_that_are_being_written();
  void an_export_that_waits_for_its_case_is_written_all_the_same_data();
  void an_export_that_waits_for_its_case_is_written_all_the_same();
  void measurements_are_work_that_is_saved();
};

void ClosingStoryTest::a_session_is_among_the_recent_studies() {
  Desktop desktop(solver::ExecutorKind::host);
  const TemporaryFolder folder;
  const QString file = path(folder / "kept.tidemark");
  const auto entries = [&] {
    QList<QAction*> found;
    for (QMenu* menu : desktop.window().menuBar()->findChildren<QMenu*>()) {
      if (!menu->title().remove(u'&').contains("recent")) continue;
      for (QAction* action : menu->actions()) {
        if (action->toolTip() == file) found << action;
      }
    }
    return found;
  };
  begin_phantom(desktop, "sphere");
  QVERIFY(entries().isEmpty());
  QVERIFY(desktop.save_session(file));
  QVERIFY(Desktop::wait_for([&] { return entries().size() == 1; }));
  QVERIFY(entries().front()->text().contains("kept.tidemark"));
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
  entries().front()->trigger();
  QVERIFY(Desktop::wait_for([&] { return desktop.window().active_case() != nullptr; }));
  desktop.wait_until_idle();
  QVERIFY(desktop.state().begun);
  QCOMPARE(desktop.window().active_case()->session_file, file);
  QCOMPARE(entries().size(), 1);
}

void ClosingStoryTest::a_quit_that_was_given_up_stays_given_up_data() {
  QTest::addColumn<bool>("fails");
  QTest::newRow("one is kept open") << false;
  QTest::newRow("one cannot be saved") << true;
}

// Two cases, asked about at Quit: one is saved and closes then, one is kept. Closing that one later closes no
// more.
void ClosingStoryTest::a_quit_that_was_given_up_stays_given_up() {
  QFETCH(const bool, fails);
  Desktop desktop(solver::ExecutorKind::host);
  const TemporaryFolder folder;
  const QPointer saved(begin_phantom(desktop, "sphere"));
  ui::CaseWindow* kept = begin_phantom(desktop, "dumbbell");
  saved->session_file = path(folder / (fails ? "missing" : ".") / "saved.tidemark");
  const QString kept_name = kept->proxy().name();
  if (fails) {
    kept->close_saved();
    QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().size() == 1; }));
  }
  const auto answers = at_each_question([&](QMessageBox& box) {
    const bool is_kept = box.text().contains(kept_name);
    box.button(is_kept ? QMessageBox::Cancel : QMessageBox::Save)->click();
  });
  QVERIFY(!desktop.window().close());
  answers->stop();
  const auto is_over = [&] { return fails ? told(desktop).contains("saved.tidemark") : !saved; };
  QVERIFY(Desktop::wait_for(is_over));
  close_the_last_case(desktop);
}

void ClosingStoryTest::a_quit_ends_with_a_study_that_comes_meanwhile_data() {
  QTest::addColumn<bool>("asked");
  QTest::newRow("while a case is saved") << false;
  QTest::newRow("while it is asked about") << true;
}

// Closing that one later closes no more.
void ClosingStoryTest::a_quit_ends_with_a_study_that_comes_meanwhile() {
  QFETCH(const bool, asked);
  const TemporaryFolder folder;
  Desktop desktop(solver::ExecutorKind::host);
  const QPointer saved(begin_phantom(desktop, "sphere"));
  saved->session_file = path(folder / "saved.tidemark");
  std::promise<void> go = hold(desktop);  // saving takes until then
  const auto is_there = [&] { return desktop.window().cases().size() == 2; };
  if (asked) desktop.window().open_phantom("dumbbell");
  const auto answers = at_each_question([&](QMessageBox& box) {
    if (!asked || is_there()) box.button(QMessageBox::Save)->click();
  });
  QVERIFY(!desktop.window().close());
  answers->stop();
  if (!asked) desktop.window().open_phantom("dumbbell");
  QVERIFY(Desktop::wait_for(is_there));
  go.set_value();
  QVERIFY(Desktop::wait_for([&] { return !saved; }));
  close_the_last_case(desktop);
}

void ClosingStoryTest::a_case_that_is_kept_at_quit_keeps_the_others() {
  Desktop desktop(solver::ExecutorKind::host);
  QVERIFY(desktop.open_phantom("dumbbell"));  // without changes
  begin_phantom(desktop, "sphere");
  begin_phantom(desktop, "sphere");
  int questions = 0;
  const auto answers = cancel_each_question(questions);
  QVERIFY(!desktop.window().close());
  answers->stop();
  QCOMPARE(questions, 1);
  QTest::qWait(50);
  QCOMPARE(desktop.window().cases().size(), 3);
}

void ClosingStoryTest::a_session_is_open_once() {
  const TemporaryFolder folder;
  Desktop desktop(solver::ExecutorKind::host);
  ui::CaseWindow* first = begin_phantom(desktop, "sphere");
  QVERIFY(desktop.save_session(path(folder / "one.tidemark")));
  QVERIFY(desktop.open_phantom("dumbbell"));
  const std::filesystem::path link = folder / "link.tidemark";
  std::filesystem::create_symlink(folder / "one.tidemark", link);
  desktop.window().open(path(link));
  QVERIFY(Desktop::wait_for([&] { return desktop.window().active_case() == first; }));
  desktop.wait_until_idle();
  QCOMPARE(desktop.window().cases().size(), 2);
}

void ClosingStoryTest::a_session_of_other_voxels_is_not_written_over() {
  const TemporaryFolder folder;
  const auto study = folder / "study.nrrd";
  const QString session = path(folder / "one.tidemark");
  const QString other = path(folder / "other.tidemark");
  write_study(study, 0);
  Desktop desktop(solver::ExecutorKind::host);
  leave_session(desktop, path(study), session);
  const QByteArray before = bytes_of(folder / "one.tidemark");

  write_study(study, 1000);
  const auto refused = Desktop::answer(QMessageBox::No);
  desktop.window().open(session);
  QVERIFY(Desktop::wait_for([&] { return *refused; }));
  desktop.wait_until_idle();
  QVERIFY(desktop.window().cases().isEmpty());

  const auto accepted = Desktop::answer(QMessageBox::Yes);
  QVERIFY(desktop.open(session));
  QVERIFY(*accepted);
  QCOMPARE(desktop.state().labels.size(), std::size_t{1});
  QCOMPARE(desktop.window().active_case()->session_file, QString());
  QVERIFY(desktop.state().modified);
  name_file_when_asked(other);
  desktop.press(Qt::Key_S, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return !desktop.state().modified; }));
  QCOMPARE(desktop.window().active_case()->session_file, other);
  QVERIFY(bytes_of(folder / "one.tidemark") == before);
}

void ClosingStoryTest::a_session_of_another_grid_is_refused() {
  const TemporaryFolder folder;
  const auto study = folder / "study.nrrd";
  const QString session = path(folder / "one.tidemark");
  write_study(study, 0);
  Desktop desktop(solver::ExecutorKind::host);
  leave_session(desktop, path(study), session);

  write_study(study, 0, 25);
  desktop.window().open(session);
  Desktop::wait_for([&] { return told(desktop).contains("its size or place differ"); });
  desktop.wait_until_idle();
  QVERIFY2(told(desktop).contains("its size or place differ") && told(desktop).contains(session),
           qPrintable(told(desktop)));
  QVERIFY(desktop.window().cases().isEmpty());
}

void ClosingStoryTest::the_session_of_another_case_is_not_written_over() {
  const TemporaryFolder folder;
  const QString file = path(folder / "one.tidemark");
  Desktop desktop(solver::ExecutorKind::host);
  begin_phantom(desktop, "sphere");
  QVERIFY(desktop.save_session(file));
  const QByteArray before = bytes_of(folder / "one.tidemark");
  ui::CaseWindow* second = begin_phantom(desktop, "dumbbell");
  const auto asked = Desktop::answer(QMessageBox::Yes);  // to write over what is there
  name_file_when_asked(file);
  desktop.press(Qt::Key_S, Qt::ControlModifier | Qt::ShiftModifier);
  QVERIFY(*asked);
  desktop.wait_until_idle();
  QVERIFY2(told(desktop).contains("is the session of another open case"), qPrintable(told(desktop)));
  QVERIFY(bytes_of(folder / "one.tidemark") == before);
  QVERIFY(second->proxy().state().modified);
  QCOMPARE(second->session_file, QString());
}

void ClosingStoryTest::a_file_of_the_study_is_never_written_to() {
  const TemporaryFolder folder;
  const auto study = folder / "study.nrrd";
  write_study(study, 0);
  const QByteArray before = bytes_of(study);
  Desktop desktop(solver::ExecutorKind::host);
  QVERIFY(desktop.open(path(study)));
  document::Start start;
  start.seeds.push_back({desktop.proxy().volume().geometry.to_patient(glm::dvec3(12.0)), 6.0});
  desktop.proxy().begin(start);
  desktop.wait_until_idle();
  const auto asked = Desktop::answer(QMessageBox::Yes);  // to write over what is there
  name_file_when_asked(path(study));
  desktop.window().actions().export_mask->trigger();
  QVERIFY(*asked);
  desktop.wait_until_idle();
  QVERIFY2(told(desktop).contains("is a file of the study, which is never written to"),
           qPrintable(told(desktop)));
  QVERIFY(bytes_of(study) == before);
}

void ClosingStoryTest::a_case_that_is_changed_while_it_is_saved_stays_open() {
  const TemporaryFolder folder;
  const QString file = path(folder / "one.tidemark");
  Desktop desktop(solver::ExecutorKind::host);
  const QPointer window(begin_phantom(desktop, "sphere"));
  window->session_file = file;
  Desktop::answer(QMessageBox::Save);
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  window->proxy().add_label("changed");
  QVERIFY(Desktop::wait_for([&] { return QFileInfo::exists(file); }));
  desktop.wait_until_idle();
  QTest::qWait(100);
  QVERIFY(window);
  QVERIFY(window->proxy().state().modified);
  QVERIFY2(told(desktop).contains("stays open"), qPrintable(told(desktop)));
  Desktop::answer(QMessageBox::Save);
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  QVERIFY(Desktop::wait_for([&] { return !window; }));
}

void ClosingStoryTest::a_case_that_is_being_saved_asks_no_second_time() {
  const TemporaryFolder folder;
  Desktop desktop(solver::ExecutorKind::host);
  const QPointer window(begin_phantom(desktop, "sphere"));
  window->session_file = path(folder / "one.tidemark");
  std::promise<void> go = hold(desktop);
  Desktop::answer(QMessageBox::Save);
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  int questions = 0;
  const auto answers = cancel_each_question(questions);
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  QTest::qWait(50);
  QCOMPARE(questions, 0);
  QVERIFY(window);
  go.set_value();
  QVERIFY(Desktop::wait_for([&] { return !window; }));
  QCOMPARE(questions, 0);
}

// While its question is open, nothing else closes a case.
void ClosingStoryTest::a_case_that_stays_open_goes_on_asking() {
  Desktop desktop(solver::ExecutorKind::host);
  const QPointer window(begin_phantom(desktop, "sphere"));
  int questions = 0;
  const auto answers = at_each_question([&](QMessageBox& box) {
    if (++questions == 1) window->close_saved();
    box.button(QMessageBox::Cancel)->click();
  });
  for (int times = 1; times <= 2; ++times) {
    desktop.press(Qt::Key_W, Qt::ControlModifier);
    QTest::qWait(50);
    QVERIFY(window);
    QCOMPARE(questions, times);
  }
}

void ClosingStoryTest::two_cases_are_not_saved_into_one_file() {
  const TemporaryFolder folder;
  const QString file = path(folder / "one.tidemark");
  Desktop desktop(solver::ExecutorKind::host);
  ui::CaseWindow* first = begin_phantom(desktop, "sphere");
  ui::CaseWindow* second = begin_phantom(desktop, "sphere");
  std::promise<void> go = hold(desktop);
  for (ui::CaseWindow* window : {first, second}) {
    QVERIFY2(!told(desktop).contains("another open case"), qPrintable(told(desktop)));
    desktop.window().bring_to_front(*window);
    QVERIFY(Desktop::wait_for([&] { return desktop.window().active_case() == window; }));
    name_file_when_asked(file);
    desktop.press(Qt::Key_S, Qt::ControlModifier);
  }
  QVERIFY2(told(desktop).contains("another open case"), qPrintable(told(desktop)));
  go.set_value();
  QVERIFY(Desktop::wait_for([&] { return !first->proxy().state().modified; }));
  desktop.wait_until_idle();
  QCOMPARE(first->session_file, file);
  QCOMPARE(second->session_file, QString());
  QVERIFY(second->proxy().state().modified);
}

void ClosingStoryTest::a_case_that_is_saved_may_go_while_another_one_asks_at_quit() {
  const TemporaryFolder folder;
  Desktop desktop(solver::ExecutorKind::host);
  begin_phantom(desktop, "dumbbell");  // is asked about first
  const QPointer saved(begin_phantom(desktop, "sphere"));
  saved->session_file = path(folder / "one.tidemark");
  std::promise<void> go = hold(desktop);
  Desktop::answer(QMessageBox::Save);
  desktop.press(Qt::Key_W, Qt::ControlModifier);
  QVERIFY(saved);
  bool goes = false;
  const auto answers = at_each_question([&](QMessageBox& box) {
    if (!std::exchange(goes, true)) go.set_value();
    if (!saved) box.button(QMessageBox::Discard)->click();
  });
  QVERIFY(desktop.window().close());
  QVERIFY(std::filesystem::exists(folder / "one.tidemark"));
  QVERIFY(desktop.window().cases().isEmpty());
}

void ClosingStoryTest::the_last_of_two_writes_to_one_file_counts() {
  const TemporaryFolder folder;
  const std::filesystem::path text = folder / "text.txt";
  Desktop desktop(solver::ExecutorKind::host);
  ui::CaseWindow& window = *desktop.open_phantom("sphere");
  std::promise<void> go;
  int ended = 0;
  const auto ends = [&](bool written) { ended += written ? 1 : 0; };
  ui::CaseFiles& files = desktop.window().files();
  files.write(window, path(text), write_later(go, text, "old"), ends);
  files.write(
      window, path(text), [text] { return write_file(text, "new"); }, ends);
  QTest::qWait(100);
  QVERIFY(!std::filesystem::exists(text));
  go.set_value();
  QVERIFY(Desktop::wait_for([&] { return ended == 2; }));
  QCOMPARE(bytes_of(text), QByteArray("new"));
  QVERIFY(!files.writing());
}

void ClosingStoryTest::quitting_waits_for_files_that_are_being_written() {
  const TemporaryFolder folder;
  const std::filesystem::path text = folder / "text.txt";
  Desktop desktop(solver::ExecutorKind::host);
  ui::CaseWindow& window = *desktop.open_phantom("sphere");
  std::promise<void> go;
  desktop.window().files().write(window, path(text), write_later(go, text, "whole"));
  QVERIFY(!desktop.window().close());
  QTest::qWait(100);
  QVERIFY(desktop.window().isVisible());
  QVERIFY(desktop.window().cases().isEmpty());
  QVERIFY2(told(desktop).contains("all files are written"), qPrintable(told(desktop)));
  go.set_value();
  QVERIFY(Desktop::wait_for([&] { return !desktop.window().isVisible(); }));
  QCOMPARE(bytes_of(text), QByteArray("whole"));
}

void ClosingStoryTest::an_export_that_waits_for_its_case_is_written_all_the_same_data() {
  QTest::addColumn<bool>("quits");
  QTest::newRow("the case is closed") << false;
  QTest::newRow("the window is closed") << true;
}

void ClosingStoryTest::an_export_that_waits_for_its_case_is_written_all_the_same() {
  QFETCH(const bool, quits);
  Desktop desktop(solver::ExecutorKind::host);
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "mask.nii.gz";
  ui::CaseWindow* window = begin_phantom(desktop, "sphere");
  const std::int64_t inside = desktop.state().surface.voxels_inside;
  std::promise<void> go = hold(desktop);
  int questions = 0;
  const auto answers = at_each_question([&](QMessageBox& box) {
    ++questions;
    box.button(QMessageBox::Discard)->click();
  });
  desktop.window().exports().write_mask(*window, path(file));
  if (quits) {
    QVERIFY(!desktop.window().close());
  } else {
    desktop.press(Qt::Key_W, Qt::ControlModifier);
  }
  QTest::qWait(100);
  QCOMPARE(desktop.window().cases().size(), 1);
  QCOMPARE(questions, 0);
  go.set_value();
  QVERIFY(Desktop::wait_for([&] { return desktop.window().cases().isEmpty(); }));
  QVERIFY(Desktop::wait_for([&] { return desktop.window().isVisible() != quits; }));
  answers->stop();
  QCOMPARE(questions, 1);
  QVERIFY(Desktop::wait_for([&] { return !desktop.window().files().writing(); }));
  const auto mask = imaging::load_mask(file);
  QVERIFY2(mask, qPrintable(failure(mask)));
  QCOMPARE(mask->count(), inside);
}

void ClosingStoryTest::measurements_are_work_that_is_saved() {
  const TemporaryFolder folder;
  const QString file = path(folder / "one.tidemark");
  Desktop desktop(solver::ExecutorKind::host);
  QVERIFY(desktop.open_phantom("sphere"));
  QVERIFY(!desktop.state().modified);
  const auto measure = [&](const glm::dvec3& end) {
    desktop.proxy().display().change([&](engine::DisplaySettings& settings) {
      settings.measurements = {{engine::Measurement::Kind::distance, {glm::dvec3(0.0), end}}};
    });
  };
  measure(glm::dvec3(5.0));
  QVERIFY(desktop.state().modified);
  QVERIFY(desktop.save_session(file));
  desktop.close_case();
  QVERIFY(desktop.open(file));
  QCOMPARE(desktop.proxy().display().settings().measurements.size(), std::size_t{1});
  QVERIFY(!desktop.state().modified);
  measure(glm::dvec3(6.0));
  QVERIFY(desktop.state().modified);
}

TIDEMARK_TEST(ClosingStoryTest)

}  // namespace tidemark::test::closing_story_test

#include "closing_story_test.moc"
