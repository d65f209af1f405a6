// Copies of a lesson's answers: what a crash leaves is found, what was ended is not.
#include <QFile>
#include <QtTest>

#include "document/lesson_copy.h"
#include "document/recovery_folder.h"
#include "tests/support/test_program.h"

namespace tidemark::test::lesson_copy_test {

namespace {

std::string lesson_text() {
  return std::string(document::own_lessons()[1].text);
}

document::LessonProgress some_progress(const document::Lesson& lesson) {
  document::LessonProgress progress{1, {}, {}};
  progress.parts.resize(lesson.parts.size());
  progress.tried.resize(lesson.parts.size());
  progress.parts[0].choice = 1;
  progress.parts[0].words = "weil sie krümmt: \"κ\" \\ 1";
  progress.parts[0].figures.resize(lesson.parts[0].measures.size());
  progress.parts[0].figures[0] = 0.1234567890123456;
  progress.tried[0] = 1;
  return progress;
}

std::filesystem::path only_copy(const std::filesystem::path& folder) {
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() == ".lesson") return entry.path();
  }
  return {};
}

}  // namespace

class LessonCopyTest : public QObject {
  Q_OBJECT

 private slots:
  void answers_come_back_after_a_crash() {
    const TemporaryFolder folder;
    const auto lesson = document::Lesson::parse(lesson_text(), "own");
    QVERIFY(lesson.has_value());
    QVERIFY(!lesson->parts[0].measures.empty());
    const document::LessonProgress progress = some_progress(*lesson);
    {
      auto copy = document::LessonCopy::create(folder / "kept", lesson_text(), "/some/where/mine.json");
      QCOMPARE(failure(copy), QString());
      QCOMPARE(failure(copy->write({0, std::vector<document::PartAnswers>(lesson->parts.size()),
                                    std::vector<char>(lesson->parts.size())})),
               QString());
      QCOMPARE(failure(copy->write(progress)), QString());
      // Its own program still has it.
      QVERIFY(document::find_rescued_lessons(folder / "kept").empty());
    }
    const auto found = document::find_rescued_lessons(folder / "kept");
    QCOMPARE(found.size(), std::size_t{1});
    QVERIFY(found[0].progress == progress);
    QCOMPARE(found[0].lesson.title, lesson->title);
    QCOMPARE(found[0].file, std::filesystem::path("/some/where/mine.json"));
    document::discard_lesson(folder / "kept", found[0].id);
    QVERIFY(std::filesystem::is_empty(folder / "kept"));
  }

  void an_ended_lesson_leaves_nothing() {
    const TemporaryFolder folder;
    const auto lesson = document::Lesson::parse(lesson_text(), "own");
    auto copy = document::LessonCopy::create(folder / "kept", lesson_text(), {});
    QVERIFY(copy.has_value());
    QCOMPARE(failure(copy->write(some_progress(*lesson))), QString());
    copy->finish();
    QVERIFY(std::filesystem::is_empty(folder / "kept"));
  }

  void a_file_that_is_no_copy_is_not_offered_data() {
    QTest::addColumn<QByteArray>("from");
    QTest::addColumn<QByteArray>("to");
    QTest::addRow("cut off") << QByteArray() << QByteArray();
    QTest::addRow("another version") << QByteArray("\"version\": 1") << QByteArray("\"version\": 2");
    QTest::addRow("a part beyond the last") << QByteArray("\"part\": 1") << QByteArray("\"part\": 100");
    QTest::addRow("a choice that there is not") << QByteArray("\"choice\": 1") << QByteArray("\"choice\": 9");
    QTest::addRow("another lesson") << QByteArray("tidemark lesson\\\"") << QByteArray("tidemark lessen\\\"");
    QTest::addRow("a figure in words") << QByteArray("0.1234567890123456") << QByteArray("true");
  }

  void a_file_that_is_no_copy_is_not_offered() {
    QFETCH(const QByteArray, from);
    QFETCH(const QByteArray, to);
    const TemporaryFolder folder;
    const auto lesson = document::Lesson::parse(lesson_text(), "own");
    {
      auto copy = document::LessonCopy::create(folder / "kept", lesson_text(), {});
      QVERIFY(copy.has_value());
      QCOMPARE(failure(copy->write(some_progress(*lesson))), QString());
    }
    QCOMPARE(document::find_rescued_lessons(folder / "kept").size(), std::size_t{1});
    const auto file = only_copy(folder / "kept");
    QByteArray bytes = bytes_of(file);
    if (from.isEmpty()) {
      bytes.chop(bytes.size() / 2);
    } else {
      QVERIFY(bytes.contains(from));
      bytes.replace(from, to);
    }
    QFile changed(QString::fromStdString(file.string()));
    QVERIFY(changed.open(QIODevice::WriteOnly));
    QCOMPARE(changed.write(bytes), bytes.size());
    changed.close();
    QVERIFY(document::find_rescued_lessons(folder / "kept").empty());
  }
};

TIDEMARK_TEST(LessonCopyTest)

}  // namespace tidemark::test::lesson_copy_test

#include "lesson_copy_test.moc"
