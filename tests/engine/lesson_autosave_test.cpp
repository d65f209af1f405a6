// The copy of a lesson's answers, where its folder cannot be written for a while.
#include "engine/lesson_autosave.h"

#include <QSignalSpy>
#include <QTest>
#include <fstream>

#include "engine/background_job.h"
#include "tests/support/ball_lesson.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::lesson_autosave_test {

using namespace std::chrono_literals;

class LessonAutosaveTest : public QObject {
  Q_OBJECT

 private slots:
  void cleanup() { QVERIFY(engine::BackgroundJob::finish_all(60s)); }

  void answers_are_copied_again_once_there_is_room() {
    const TemporaryFolder folder;
    std::ofstream(folder / "recovery") << "a file in the folder's place";
    auto lesson = document::Lesson::parse(kBallLesson, "ball.json");
    QCOMPARE(failure(lesson), QString());
    engine::LessonCourse course(*lesson, folder.path());
    engine::LessonAutosave autosave(course, {}, folder / "recovery", 50ms);
    QSignalSpy saved(&autosave, &engine::LessonAutosave::saved);
    QSignalSpy failed(&autosave, &engine::LessonAutosave::failed);
    course.choose(0);
    QTRY_COMPARE(failed.size(), 1);
    QTest::qWait(200);  // it is tried several times by then
    QCOMPARE(failed.size(), 1);
    QCOMPARE(saved.size(), 0);
    std::filesystem::remove(folder / "recovery");
    QTRY_COMPARE(saved.size(), 1);
    QCOMPARE(failed.size(), 1);
  }
};

TIDEMARK_TEST(LessonAutosaveTest)

}  // namespace tidemark::test::lesson_autosave_test

#include "lesson_autosave_test.moc"
