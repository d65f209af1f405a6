// The program's own lessons: what they say comes out, with every executor.
#include "document/lesson_figure.h"
#include "document/lesson_run.h"
#include "tests/support/test_program.h"

namespace tidemark::test::own_lessons_test {

namespace {

document::Lesson lesson_of(const document::OwnLesson& own) {
  auto lesson = document::Lesson::parse(own.text, std::string(own.name));
  if (!lesson) qFatal("%s", lesson.error().message.c_str());
  return std::move(*lesson);
}

// The figures that are out of their ranges; empty: none.
QString misses(const document::Lesson& lesson, solver::ExecutorKind kind) {
  QString found;
  const auto note = [&](const document::LessonPart& part, const document::LessonOutcome& outcome) {
    for (std::size_t i = 0; i < outcome.figures.size(); ++i) {
      const document::LessonMeasure& measure = part.measures[i];
      const std::optional<double>& value = outcome.figures[i];
      if (value && measure.holds(*value)) continue;
      found += QString("%1: %2 is %3; ")
                   .arg(part.title.c_str(), measure.figure.c_str(), value ? QString::number(*value) : "none");
    }
  };
  const auto outcomes = document::carry_out(lesson, {}, kind, {}, {}, note);
  return found + failure(outcomes);
}

}  // namespace

class OwnLessonsTest : public QObject {
  Q_OBJECT

 private slots:
  void there_are_eight_that_begin_with_their_number() {
    const auto lessons = document::own_lessons();
    QCOMPARE(lessons.size(), std::size_t{8});
    for (std::size_t i = 0; i < lessons.size(); ++i) {
      QVERIFY(lessons[i].name.starts_with(std::to_string(i + 1) + "-"));
    }
  }

  // A student predicts before every try, and reads why afterwards.
  void every_try_has_a_question_a_figure_and_an_explanation() {
    for (const document::OwnLesson& own : document::own_lessons()) {
      const document::Lesson lesson = lesson_of(own);
      QVERIFY2(lesson.parts.size() >= 4 && lesson.parts.size() <= 8, own.name.data());
      QVERIFY2(lesson.minutes >= 10 && lesson.minutes <= 20, own.name.data());
      QVERIFY2(!lesson.about.empty(), own.name.data());
      for (const document::LessonPart& part : lesson.parts) {
        QVERIFY2(part.attempt && part.question && !part.measures.empty() && !part.explanation.empty(),
                 part.title.c_str());
        QVERIFY2(part.question->choices.size() >= 3 && part.question->right, part.title.c_str());
      }
    }
  }

  // Else who always takes the first choice is right.
  void the_right_choice_is_in_any_place() {
    std::vector<int> places(4, 0);
    for (const document::OwnLesson& own : document::own_lessons()) {
      for (const document::LessonPart& part : lesson_of(own).parts) ++places.at(*part.question->right);
    }
    for (std::size_t i = 0; i < 3; ++i) QVERIFY2(places[i] >= 8, qPrintable(QString::number(places[i])));
  }

  void every_figure_comes_out_data() {
    QTest::addColumn<int>("lesson");
    QTest::addColumn<int>("kind");
    const auto row = [](int lesson, solver::ExecutorKind kind, const char* executor) {
      const std::string name(document::own_lessons()[static_cast<std::size_t>(lesson)].name);
      QTest::addRow("%s, %s", name.c_str(), executor) << lesson << static_cast<int>(kind);
    };
    for (int lesson = 0; lesson < 8; ++lesson) row(lesson, solver::ExecutorKind::host, "host");
    row(1, solver::ExecutorKind::compute, "compute");
    row(1, solver::ExecutorKind::stream, "stream");
    row(1, solver::ExecutorKind::reference, "reference");
  }
  void every_figure_comes_out() {
    QFETCH(int, lesson);
    QFETCH(int, kind);
    const auto executor = static_cast<solver::ExecutorKind>(kind);
    document::Lesson carried_out = lesson_of(document::own_lessons()[static_cast<std::size_t>(lesson)]);
    // Where there is no GPU the others take long: they get short tries alone.
    if (executor != solver::ExecutorKind::host) {
      std::erase_if(carried_out.parts,
                    [](const document::LessonPart& part) { return part.attempt->steps > 100; });
      QVERIFY(carried_out.parts.size() >= 3);
    }
    QCOMPARE(misses(carried_out, executor), QString());
  }
};

TIDEMARK_TEST(OwnLessonsTest)

}  // namespace tidemark::test::own_lessons_test

#include "own_lessons_test.moc"
