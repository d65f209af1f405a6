// The answers of a lesson outlive a program that is killed, and go with a lesson that is ended.
#include <QApplication>
#include <QLineEdit>
#include <QProcess>
#include <QRadioButton>
#include <QTimer>
#include <cstdio>
#include <fstream>

#include "document/lesson_copy.h"
#include "engine/case_autosave.h"
#include "tests/support/ball_lesson.h"
#include "tests/support/test_program.h"
#include "tests/ui/file_dialog.h"
#include "tests/ui/main/student.h"
#include "ui/main/session_reader.h"

namespace tidemark::test::lesson_recovery_story_test {

constexpr const char* kStudent = "--answer-until-killed";
constexpr const char* kLessonFile = "TIDEMARK_TEST_LESSON";
constexpr const char* kWords = "Curvature wins, I think.";

void open_lesson(Desktop& desktop, Student& student) {
  name_file_when_asked(qEnvironmentVariable(kLessonFile));
  desktop.choose("Teach", desktop.menu_entry("Teach", "Open lesson"));
  QVERIFY(Desktop::wait_for([&] { return student.panel() && student.panel()->isVisible(); }));
}

std::vector<std::filesystem::path> copies() {
  std::vector<std::filesystem::path> found;
  std::error_code ignored;
  for (const auto& entry : std::filesystem::directory_iterator(engine::recovery_folder(), ignored)) {
    if (entry.path().extension() == ".lesson") found.push_back(entry.path());
  }
  return found;
}

// The program that will be killed: one part done, and words typed into the next.
int answer_until_killed() {
  Desktop desktop(story_executor(), {1366, 768});
  Student student(desktop);
  open_lesson(desktop, student);
  student.choose(1);
  student.try_out();
  student.measure();
  student.go_on();
  student.answer(kWords);
  const auto is_copied = [] {
    const auto there = copies();
    return there.size() == 1 && bytes_of(there[0]).contains(kWords);
  };
  if (!Desktop::wait_for(is_copied)) return 1;
  std::puts("ready");
  std::fflush(stdout);
  return QApplication::exec();
}

class LessonRecoveryStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void init();
  void answers_are_there_again_after_a_kill();
  void an_ended_lesson_leaves_nothing();
  void the_program_asks_before_it_ends_with_answers();

 private:
  std::unique_ptr<TemporaryFolder> home_;
};

void LessonRecoveryStoryTest::init() {
  home_ = std::make_unique<TemporaryFolder>();
  qputenv("HOME", QByteArray::fromStdString(home_->path().string()));
  const std::string file = (*home_ / "ball.json").string();
  qputenv(kLessonFile, QByteArray::fromStdString(file));
  std::ofstream(file) << kBallLesson;
}

void LessonRecoveryStoryTest::answers_are_there_again_after_a_kill() {
  QProcess victim;
  victim.setProcessChannelMode(QProcess::ForwardedErrorChannel);
  victim.start(QCoreApplication::applicationFilePath(), {kStudent});
  QByteArray said;
  const auto ready_or_ended = [&] {
    said += victim.readAllStandardOutput();
    return said.contains("ready") || victim.state() == QProcess::NotRunning;
  };
  QVERIFY(Desktop::wait_for(ready_or_ended, kLessonPatience));
  QVERIFY2(said.contains("ready"), said.constData());
  // While it runs, its copy is its own.
  QVERIFY(document::find_rescued_lessons(engine::recovery_folder()).empty());
  victim.kill();
  QVERIFY(victim.waitForFinished());
  QCOMPARE(document::find_rescued_lessons(engine::recovery_folder()).size(), std::size_t{1});
  const auto left = copies();

  Desktop desktop(story_executor(), {1366, 768});
  QTimer user;
  QString offered;
  connect(&user, &QTimer::timeout, this, [&] {
    auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
    if (!box || !box->isVisible()) return;
    offered = box->informativeText();
    desktop.screenshot_at_once("lesson-rescued-question");
    for (QPushButton* button : box->findChildren<QPushButton*>()) {
      if (button->text().remove('&').startsWith("Open ")) return button->click();
    }
  });
  user.start(20);
  desktop.window().session_reader().offer_rescued();
  Student student(desktop);
  QVERIFY(Desktop::wait_for([&] { return student.panel() && student.panel()->isVisible(); }));
  user.stop();
  QVERIFY2(offered.contains("A ball &amp; its curvature"), qPrintable(offered));
  const engine::LessonCourse& course = student.course();
  QCOMPARE(course.index(), std::size_t{1});
  QCOMPARE(course.answers().parts[0].choice, std::optional<std::size_t>(1));
  QCOMPARE(course.answers().parts[0].figures.at(1), std::optional<double>(60.0));
  QVERIFY(course.done(0));
  QStringList written;
  for (const QLineEdit* line : student.panel()->findChildren<QLineEdit*>()) written << line->text();
  QVERIFY2(written.contains(kWords), qPrintable(written.join('|')));
  desktop.screenshot("lesson-rescued");

  // What was read stays read, and a try that goes on from a case that is gone begins before it.
  QTest::mouseClick(student.button("Back"), Qt::LeftButton);
  QVERIFY(student.reads("Curvature pulls inwards."));
  QVERIFY(!student.panel()->findChildren<QRadioButton*>().at(0)->isEnabled());
  student.go_on();
  student.go_on();
  if (QTest::currentTestFailed()) return;
  student.try_out();
  if (QTest::currentTestFailed()) return;
  student.measure();
  if (QTest::currentTestFailed()) return;
  QCOMPARE(course.answers().parts[2].figures.at(0), std::optional<double>(100.0));

  // Its own copy is there in place of the one that it came from.
  QVERIFY(Desktop::wait_for([&] { return copies().size() == 1 && copies() != left; }));
  student.end();
  QVERIFY(Desktop::wait_for([] { return copies().empty(); }));
}

void LessonRecoveryStoryTest::an_ended_lesson_leaves_nothing() {
  {
    Desktop desktop(story_executor(), {1366, 768});
    Student student(desktop);
    open_lesson(desktop, student);
    if (QTest::currentTestFailed()) return;
    student.choose(0);
    QVERIFY(Desktop::wait_for([] { return copies().size() == 1; }));
    student.end();
    QVERIFY(Desktop::wait_for([] { return copies().empty(); }));
    // Of one that nothing was done in there is none.
    open_lesson(desktop, student);
    if (QTest::currentTestFailed()) return;
    desktop.wait_until_idle();
    QVERIFY(copies().empty());
    student.choose(0);
    QVERIFY(Desktop::wait_for([] { return copies().size() == 1; }));
  }
  // The program's end ends the lesson, too.
  QVERIFY(Desktop::wait_for([] { return copies().empty(); }));
}

void LessonRecoveryStoryTest::the_program_asks_before_it_ends_with_answers() {
  Desktop desktop(story_executor(), {1366, 768});
  Student student(desktop);
  open_lesson(desktop, student);
  if (QTest::currentTestFailed()) return;
  student.choose(0);
  Desktop::answer(QMessageBox::No);
  QVERIFY(!desktop.window().close());
  QVERIFY(desktop.window().isVisible());
  for (int part = 1; part < 4; ++part) student.go_on();
  if (QTest::currentTestFailed()) return;
  student.sign("Ada");
  student.hand_in("Save as table…", *home_ / "answers.csv");
  if (QTest::currentTestFailed()) return;
  QVERIFY(desktop.window().close());
}

static const tidemark::test::RegisteredTest kVictimProcess(kStudent,
                                                           [](int, char**) { return answer_until_killed(); });

TIDEMARK_TEST(LessonRecoveryStoryTest)

}  // namespace tidemark::test::lesson_recovery_story_test

#include "lesson_recovery_story_test.moc"
