// The file of the lesson that is edited, written while the user goes on.
#include "ui/lessons/lesson_file.h"

#include <QSignalSpy>

#include "engine/background_job.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::lesson_file_test {

using namespace std::chrono_literals;
using document::Lesson;

class LessonFileTest : public QObject {
  Q_OBJECT

  static Lesson short_lesson(const char* title) {
    Lesson lesson;
    lesson.title = title;
    lesson.study.phantom = "sphere";
    document::LessonPart& part = lesson.parts.emplace_back();
    part.title = "One";
    part.text = "Look.";
    part.attempt.emplace();
    return lesson;
  }
  // One that takes long to write.
  static Lesson long_lesson(const char* title) {
    Lesson lesson = short_lesson(title);
    lesson.parts.front().attempt->start.emplace().seeds.assign(1000,
                                                               solver::Sphere{{1.25, 2.5, 3.125}, 4.0625});
    lesson.parts.resize(50, lesson.parts.front());
    return lesson;
  }
  static void finish() {
    QVERIFY(engine::BackgroundJob::finish_all(60s));
    QCoreApplication::processEvents();
  }

 private slots:
  void init() {
    window_ = std::make_unique<QWidget>();
    lesson_ = short_lesson("First");
    file_ = new ui::LessonFile(
        *window_, [this]() -> const Lesson& { return lesson_; }, [] { return QString(); });
  }
  void cleanup() {
    window_.reset();
    finish();
  }

  void a_save_that_ends_late_is_none_of_the_next_lesson() {
    const TemporaryFolder folder;
    const QSignalSpy saved(file_, &ui::LessonFile::saved);
    file_->begin(folder / "first.json");
    file_->note_edit();
    file_->save();
    lesson_ = short_lesson("Second");
    file_->begin({});
    file_->note_edit();
    finish();
    QCOMPARE(saved.count(), 1);
    QVERIFY(file_->path().empty());
    QVERIFY(file_->is_modified());
    QCOMPARE(Lesson::load(folder / "first.json")->title, std::string("First"));
  }

  void of_two_saves_the_later_one_is_in_the_file() {
    const TemporaryFolder folder;
    const QSignalSpy saved(file_, &ui::LessonFile::saved);
    file_->begin(folder / "lesson.json");
    lesson_ = long_lesson("Earlier");
    file_->note_edit();
    file_->save();
    lesson_ = short_lesson("Later");
    file_->note_edit();
    file_->save();
    finish();
    QCOMPARE(saved.count(), 2);
    QVERIFY(!file_->is_modified());
    const auto read = Lesson::load(folder / "lesson.json");
    QCOMPARE(failure(read), QString());
    QCOMPARE(read->title, std::string("Later"));
  }

  void what_was_typed_while_it_was_written_is_not_saved() {
    const TemporaryFolder folder;
    file_->begin(folder / "lesson.json");
    file_->note_edit();
    file_->save();
    file_->note_edit();
    finish();
    QVERIFY(file_->is_modified());
    QCOMPARE(file_->path(), folder / "lesson.json");
  }

  void a_lesson_that_is_read_late_does_not_take_the_place_of_a_new_one() {
    const TemporaryFolder folder;
    file_->begin(folder / "lesson.json");
    file_->save();
    finish();
    const QSignalSpy opened(file_, &ui::LessonFile::opened);
    file_->open(folder / "lesson.json");
    file_->begin({});
    finish();
    QCOMPARE(opened.count(), 0);
  }

 private:
  std::unique_ptr<QWidget> window_;
  Lesson lesson_;
  ui::LessonFile* file_ = nullptr;  // the window's
};

TIDEMARK_TEST(LessonFileTest)

}  // namespace tidemark::test::lesson_file_test

#include "lesson_file_test.moc"
