// Answers of students: their score, and the table that is handed in.
#include <QProcess>
#include <clocale>

#include "document/lesson_answers.h"
#include "tests/document/lessons.h"
#include "tests/support/test_program.h"

namespace tidemark::test::lesson_answers_test {

using Json = nlohmann::json;

class LessonAnswersTest : public QObject {
  Q_OBJECT

 private slots:
  void a_score_counts_what_is_right() {
    const document::Lesson lesson = lesson_of(good_lesson());
    document::LessonAnswers answers;
    QCOMPARE(document::score(lesson, answers).questions, 1);  // the one in words has no right answer
    QCOMPARE(document::score(lesson, answers).figures, 6);
    QCOMPARE(document::score(lesson, answers).right, 0);
    answers.parts.resize(4);
    answers.parts[1] = {0, "", {10.05, 3.0}};
    answers.parts[2] = {{}, "Because.", {20.0, {}, 0.99}};
    const document::LessonScore score = document::score(lesson, answers);
    QCOMPARE(score.right, 1);
    QCOMPARE(score.in_range, 3);
    answers.parts[1].choice = 2;
    QCOMPARE(document::score(lesson, answers).right, 0);
  }

  void answers_become_a_table_data() {
    QTest::addColumn<bool>("comma");
    QTest::newRow("a decimal point") << false;
    QTest::newRow("a decimal comma") << true;
  }
  void answers_become_a_table() {
    QFETCH(bool, comma);
    // The locale is made here: machines have few of them installed.
    const TemporaryFolder locales;
    const QString german = QString::fromStdString((locales / "de_DE.UTF-8").string());
    QProcess localedef;
    localedef.start("localedef", {"-i", "de_DE", "-f", "UTF-8", german});
    QVERIFY2(localedef.waitForFinished(60'000), "localedef is needed (Debian: package locales)");
    const Variable path("LOCPATH", QByteArray::fromStdString(locales.path().string()));
    QVERIFY(std::setlocale(LC_ALL, comma ? "de_DE.UTF-8" : "C") != nullptr);
    QCOMPARE(*std::localeconv()->decimal_point, comma ? ',' : '.');
    document::LessonAnswers answers{"=HYPERLINK(\"x\")", "2026-03-31", {}};
    answers.parts.resize(4);
    answers.parts[1] = {1, "", {10.0625, {}}};
    answers.parts[2] = {{}, "First line,\nthen \"more\"", {-3.5}};
    const std::string csv = document::to_csv(lesson_of(good_lesson()), answers);
    std::setlocale(LC_ALL, "C");
    const QStringList lines = QString::fromStdString(csv).split("\r\n");
    const QString student = R"csv("'=HYPERLINK(""x"")","2026-03-31","Size",)csv";
    QCOMPARE(lines.size(), 10);  // eight, the header, and nothing behind the last line's end
    QCOMPARE(lines[0], QString("student,date,lesson,part,title,asked,answer,expected,agrees"));
    QCOMPARE(lines[1], student + R"(2,"Stay","How large?","20 mm","10 mm",no)");
    QCOMPARE(lines[2], student + R"(2,"Stay","radius_mm",10.0625,9.9 to 10.1,yes)");
    QCOMPARE(lines[3], student + R"(2,"Stay","steps",,0 to 0,no)");
    QCOMPARE(lines[4], student + "3,\"Grow\",\"Why?\",\"First line,\nthen \"\"more\"\"\",\"\",");
    QCOMPARE(lines[5], student + R"(3,"Grow","radius_mm",-3.5,19.5 to 20.5,no)");
    QCOMPARE(lines[8], student + R"(4,"Another","bodies",,1 to 1,no)");
    QCOMPARE(lines[9], QString());
  }

  void a_long_choice_comes_whole() {
    Json json = good_lesson();
    const std::string choice = "As large as the ball was before, and by a quarter of a voxel larger";
    json["parts"][1]["question"]["choices"][2] = choice;
    document::LessonAnswers answers{"A", "2026-03-31", {}};
    answers.parts.resize(2);
    answers.parts[1].choice = 2;
    const std::string csv = document::to_csv(lesson_of(json), answers);
    QVERIFY(csv.find("\"" + choice + "\",\"10 mm\",no") != std::string::npos);
  }

  void an_answer_that_is_no_choice_is_none() {
    document::LessonAnswers answers{"A", "2026-03-31", {}};
    answers.parts.resize(2);
    answers.parts[1].choice = 7;
    const std::string csv = document::to_csv(lesson_of(good_lesson()), answers);
    QVERIFY(csv.find("\"How large?\",\"\",\"10 mm\",no") != std::string::npos);
  }
};

TIDEMARK_TEST(LessonAnswersTest)

}  // namespace tidemark::test::lesson_answers_test

#include "lesson_answers_test.moc"
