// The page about lessons (handbook/lessons.md): its example works, and it names all that a lesson can have.
#include <QFile>
#include <QRegularExpression>

#include "document/lesson_figure.h"
#include "document/lesson_run.h"
#include "imaging/phantom/phantom.h"
#include "tests/support/test_program.h"

namespace tidemark::test::lesson_page_test {

namespace {

QString page() {
  QFile file(QStringLiteral(TIDEMARK_SOURCE "/handbook/lessons.md"));
  if (!file.open(QIODevice::ReadOnly)) qFatal("the page cannot be read");
  return QString::fromUtf8(file.readAll());
}

std::string example() {
  const QString begin = "```json\n";
  const QString text = page();
  const qsizetype at = text.indexOf(begin) + begin.size();
  return text.mid(at, text.indexOf("```", at) - at).toStdString();
}

bool in_code(const QString& text, std::string_view word) {
  const QString wanted = QString::fromUtf8(word.data(), static_cast<qsizetype>(word.size()));
  return text.contains("`" + wanted + "`") || text.contains("`\"" + wanted + "\"`");
}

}  // namespace

class LessonPageTest : public QObject {
  Q_OBJECT

 private slots:
  void the_example_is_a_lesson_that_comes_out() {
    const auto lesson = document::Lesson::parse(example(), "lessons.md");
    QCOMPARE(failure(lesson), QString());
    QCOMPARE(lesson->parts.size(), std::size_t{4});
    const auto outcomes = document::carry_out(*lesson, {}, solver::ExecutorKind::host, {});
    QCOMPARE(failure(outcomes), QString());
    for (std::size_t i = 0; i < lesson->parts.size(); ++i) {
      QVERIFY2((*outcomes)[i].holds(lesson->parts[i]), lesson->parts[i].title.c_str());
    }
  }

  void every_figure_view_phantom_and_lesson_is_named() {
    const QString text = page();
    for (const document::LessonFigure& figure : document::lesson_figures()) {
      QVERIFY2(in_code(text, figure.name), figure.name.data());
    }
    for (const std::string_view view : document::lesson_view_names()) {
      QVERIFY2(in_code(text, view), view.data());
    }
    for (const std::string_view kind : imaging::phantom_kinds()) {
      QVERIFY2(in_code(text, kind), kind.data());
    }
    for (const document::OwnLesson& own : document::own_lessons()) {
      const auto lesson = document::Lesson::parse(own.text, "own");
      const QRegularExpression row(QString("\\| `%1` \\|[^|]+\\| %2 \\|")
                                       .arg(QString::fromStdString(std::string(own.name)))
                                       .arg(lesson->minutes));
      QVERIFY2(text.contains(row), own.name.data());
    }
  }
};

TIDEMARK_TEST(LessonPageTest)

}  // namespace tidemark::test::lesson_page_test

#include "lesson_page_test.moc"
