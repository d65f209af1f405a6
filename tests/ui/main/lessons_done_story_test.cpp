// The program's own lessons as a student does them: by clicks, from the menu to the files that are handed in.
#include <QDockWidget>
#include <QFile>
#include <QRadioButton>

#include "document/lesson_figure.h"
#include "tests/support/test_program.h"
#include "tests/ui/main/student.h"
#include "ui/lessons/lesson_text.h"

namespace tidemark::test::lessons_done_story_test {
namespace {

constexpr const char* kName = "Ada \"Lace\", 3b";

// The fields of a CSV file, a list a line.
QList<QStringList> fields_of(const QString& csv) {
  QList<QStringList> lines{{QString()}};
  bool quoted = false;
  for (const QChar letter : csv) {
    if (letter == u'"') {
      quoted = !quoted;  // twice at a quote that is doubled
      lines.last().last() += letter;
    } else if (!quoted && letter == u',') {
      lines.last().append(QString());
    } else if (!quoted && letter == u'\n') {
      lines.append(QStringList(QString()));
    } else if (quoted || letter != u'\r') {
      lines.last().last() += letter;
    }
  }
  if (lines.last() == QStringList(QString())) lines.removeLast();
  for (QStringList& line : lines) {
    for (QString& field : line) {
      if (field.startsWith(u'"')) field = field.mid(1, field.size() - 2).replace("\"\"", "\"");
    }
  }
  return lines;
}

// The student is wrong in every third part.
std::size_t choice_in(const document::Lesson& lesson, std::size_t part) {
  const document::LessonQuestion& question = *lesson.parts[part].question;
  const std::size_t step = part % 3 == 2 ? 1 : 0;
  return (*question.right + step) % question.choices.size();
}

}  // namespace

class LessonsDoneStoryTest : public QObject {
  Q_OBJECT

 private slots:
  void each_is_done_to_the_end_and_handed_in_data();
  void each_is_done_to_the_end_and_handed_in();

 private:
  static void do_part(Desktop& desktop, Student& student);
  static void look_at_the_table(const engine::LessonCourse& course, const std::filesystem::path& file);
};

void LessonsDoneStoryTest::each_is_done_to_the_end_and_handed_in_data() {
  QTest::addColumn<int>("number");
  for (int number = 1; number <= static_cast<int>(document::own_lessons().size()); ++number)
    QTest::addRow("lesson %d", number) << number;
}

void LessonsDoneStoryTest::do_part(Desktop& desktop, Student& student) {
  const engine::LessonCourse& course = student.course();
  const document::LessonPart& part = course.part();
  const std::size_t index = course.index();
  const QString explanation = QString::fromStdString(part.explanation);
  QVERIFY(student.reads(QString::fromStdString(part.text)));
  QVERIFY(student.reads(QString::fromStdString(part.question->text)));
  QVERIFY(!student.reads(explanation));

  // A prediction counts before the try, and is not changed after it.
  QVERIFY(!student.button("Set up and play")->isEnabled());
  const std::size_t choice = choice_in(course.lesson(), index);
  student.choose(choice);
  if (QTest::currentTestFailed()) return;
  student.try_out();
  if (QTest::currentTestFailed()) return;
  for (const QRadioButton* button : student.panel()->findChildren<QRadioButton*>())
    QVERIFY(!button->isEnabled());
  QVERIFY(!student.reads(explanation));
  student.measure();
  if (QTest::currentTestFailed()) return;

  for (std::size_t i = 0; i < part.measures.size(); ++i) {
    const document::LessonMeasure& measure = part.measures[i];
    const std::optional<double> value = course.answers().parts[index].figures[i];
    QVERIFY2(value && measure.holds(*value),
             qPrintable(QStringLiteral("%1: %2").arg(measure.figure.c_str()).arg(value.value_or(-1.0))));
    QVERIFY(student.reads(ui::figure_text(measure.figure, *value)));
  }
  QVERIFY(student.reads("as expected"));
  QVERIFY(!student.reads("not as expected"));
  QVERIFY(student.reads(explanation));
  QCOMPARE(student.reads("Your prediction was right."), choice == *part.question->right);
  desktop.screenshot(QStringLiteral("%1-part-%2").arg(course.lesson().title.c_str()).arg(index + 1));
}

void LessonsDoneStoryTest::look_at_the_table(const engine::LessonCourse& course,
                                             const std::filesystem::path& file) {
  const QList<QStringList> lines = fields_of(QString::fromUtf8(bytes_of(file)));
  const document::Lesson& lesson = course.lesson();
  qsizetype at = 0;
  QCOMPARE(lines.value(at++), QStringList({"student", "date", "lesson", "part", "title", "asked", "answer",
                                           "expected", "agrees"}));
  const auto begins = [&](const QStringList& line, std::size_t part) {
    return line.size() == 9 && line[0] == kName && line[2] == QString::fromStdString(lesson.title) &&
           line[3] == QString::number(part + 1) &&
           line[4] == QString::fromStdString(lesson.parts[part].title);
  };
  for (std::size_t i = 0; i < lesson.parts.size(); ++i) {
    const document::LessonQuestion& question = *lesson.parts[i].question;
    const QStringList asked = lines.value(at++);
    QVERIFY2(begins(asked, i), qPrintable(asked.join(u'|')));
    const std::size_t choice = choice_in(lesson, i);
    QCOMPARE(asked[5], QString::fromStdString(question.text));
    QCOMPARE(asked[6], QString::fromStdString(question.choices[choice]));
    QCOMPARE(asked[7], QString::fromStdString(question.choices[*question.right]));
    QCOMPARE(asked[8], QString(choice == *question.right ? "yes" : "no"));
    for (const document::LessonMeasure& measure : lesson.parts[i].measures) {
      const QStringList measured = lines.value(at++);
      QVERIFY2(begins(measured, i), qPrintable(measured.join(u'|')));
      QCOMPARE(measured[5], QString::fromStdString(measure.figure));
      bool is_number = false;
      QVERIFY2(measure.holds(measured[6].toDouble(&is_number)), qPrintable(measured[6]));
      QVERIFY(is_number);
      QCOMPARE(measured[8], QString("yes"));
    }
  }
  QCOMPARE(lines.size(), at);
}

void LessonsDoneStoryTest::each_is_done_to_the_end_and_handed_in() {
  QFETCH(const int, number);
  Desktop desktop(story_executor(), {1366, 768});
  Student student(desktop);
  student.open_own(number);
  if (QTest::currentTestFailed()) return;
  const engine::LessonCourse& course = student.course();
  QCOMPARE(
      course.lesson().title,
      document::Lesson::parse(document::own_lessons()[static_cast<std::size_t>(number) - 1].text, "")->title);
  desktop.screenshot(QStringLiteral("lesson-%1-begin").arg(number));
  const std::size_t parts = course.lesson().parts.size();
  for (std::size_t part = 0; part < parts; ++part) {
    do_part(desktop, student);
    if (QTest::currentTestFailed()) return;
    if (part + 1 < parts) student.go_on();
    if (QTest::currentTestFailed()) return;
  }
  QVERIFY(!student.button("Next")->isEnabled());
  QCOMPARE(desktop.window().size(), QSize(1366, 768));

  // Nothing is handed in without a name.
  QVERIFY(!student.button("Save as table…")->isEnabled());
  student.sign(kName);
  const TemporaryFolder folder;
  student.hand_in("Save as table…", folder / "answers.csv");
  if (QTest::currentTestFailed()) return;
  student.hand_in("Save as PDF…", folder / "answers.pdf");
  if (QTest::currentTestFailed()) return;
  look_at_the_table(course, folder / "answers.csv");
  if (QTest::currentTestFailed()) return;
  const QByteArray sheet = bytes_of(folder / "answers.pdf");
  QVERIFY(sheet.startsWith("%PDF"));
  QVERIFY(sheet.trimmed().endsWith("%%EOF"));
  desktop.screenshot(QStringLiteral("lesson-%1-end").arg(number));
  student.end();
}

TIDEMARK_TEST(LessonsDoneStoryTest)

}  // namespace tidemark::test::lessons_done_story_test

#include "lessons_done_story_test.moc"
