// The command lesson: what it lists and measures, and how a lesson that does not come out ends.
#include <QJsonArray>

#include "core/atomic_file.h"
#include "tests/app/cli_runner.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::cli_lesson_test {

namespace {

const QByteArray kLesson = R"({
  "format": "tidemark lesson", "version": 1, "title": "Mine", "study": {"phantom": "sphere:0"},
  "parameters": {"target": 800, "range": 300, "alpha": 1},
  "parts": [
    {"title": "Read", "text": "Words."},
    {"title": "Size", "text": "A ball.",
     "try": {"start": {"seeds": [{"centre_mm": [0, 0, 0], "radius_mm": 8}]}, "steps": 0},
     "measure": [{"figure": "radius_mm", "low": 7.9, "high": 8.1}, {"figure": "bodies", "low": 1, "high": 1}]}
  ]
})";

}  // namespace

class CliLessonTest : public QObject {
  Q_OBJECT

 private slots:
  void the_list_has_the_programs_own() {
    const QJsonArray lessons = json_of(must_run({"lesson", "list", "--json"}).out)["lessons"].toArray();
    QCOMPARE(lessons.size(), 8);
    const QByteArray words = must_run({"lesson", "list"}).out;
    for (const QJsonValue lesson : lessons) {
      QVERIFY(words.contains(lesson["name"].toString().toUtf8()));
      QVERIFY(words.contains(lesson["title"].toString().toUtf8()));
      QVERIFY(lesson["minutes"].toInt() > 0);
    }
  }

  void an_own_lesson_begins_another() {
    const QByteArray shown = must_run({"lesson", "show", "1-implicit-surfaces"}).out;
    QVERIFY(json_of(shown)["parts"].toArray().size() >= 4);
    must_run(QStringList{"lesson", "check", write(shown), "--executor", "host"});
    const Outcome none = run_cli({"lesson", "show", "9-none"});
    QVERIFY2(none.failed_in_one_line(2) && none.err.contains("there are 1-implicit-surfaces, 2-"),
             none.told());
  }

  void an_own_lesson_is_checked_by_its_name() {
    const Outcome outcome = must_run({"lesson", "check", "2-curvature-flow", "--executor", "host"});
    QVERIFY2(outcome.out.contains("Lesson     2-curvature-flow: Curvature flow"), outcome.told());
    QVERIFY2(outcome.out.contains(": ok\n") && !outcome.out.contains("NOT OK"), outcome.told());
  }

  void a_file_is_checked() {
    const QJsonObject said = json_of(must_run(QStringList{"lesson", "check", write(kLesson), "--json"}).out);
    QCOMPARE(said["figures"].toInt(), 2);
    QCOMPARE(said["out_of_range"].toInt(), 0);
    const QJsonArray parts = said["lessons"].toArray().at(0)["parts"].toArray();
    QCOMPARE(parts.size(), 2);
    QVERIFY(parts[0]["figures"].toArray().isEmpty());
    const QJsonValue radius = parts[1]["figures"].toArray().at(0);
    QCOMPARE(radius["figure"].toString(), QString("radius_mm"));
    QVERIFY(std::abs(radius["value"].toDouble() - 8.0) < 0.1);
    QVERIFY(radius["holds"].toBool());
  }

  void a_figure_out_of_its_range_ends_with_3() {
    const QString file = write(QByteArray(kLesson).replace("8.1", "7.95"));
    const Outcome outcome = run_cli({"lesson", "check", file, "--json"});
    QVERIFY2(outcome.failed_in_one_line(3), outcome.told());
    QVERIFY2(outcome.err.contains("1 of 2 figures are out of their ranges, first ") &&
                 outcome.err.contains("part 'Size': radius_mm is 8.0") &&
                 outcome.err.contains("expected 7.9 to 7.95"),
             outcome.told());
    const QJsonObject said = json_of(outcome.out);
    QCOMPARE(said["out_of_range"].toInt(), 1);
    QVERIFY(!said["lessons"].toArray().at(0)["parts"].toArray().at(1)["holds"].toBool());
  }

  void what_is_no_lesson_ends_with_3_and_its_field() {
    const Outcome misspelt =
        run_cli(QStringList{"lesson", "check", write(QByteArray(kLesson).replace("steps", "step"))});
    QVERIFY2(misspelt.failed_in_one_line(3), misspelt.told());
    QVERIFY2(misspelt.err.contains("parts[1].try: 'step' is no field"), misspelt.told());
    const Outcome none = run_cli({"lesson", "check", "2-curvature-flow", text(folder_ / "none.json")});
    QVERIFY2(none.failed_in_one_line(3), none.told());
    QVERIFY2(none.err.contains("there are 1-") && none.out.isEmpty(), none.told());
    const Outcome alone = run_cli(QStringList{"lesson"});
    QVERIFY2(alone.failed_in_one_line(2), alone.told());
  }

 private:
  QString write(const QByteArray& lesson) {
    const auto file = folder_ / "mine.json";
    if (!write_file(file, lesson.toStdString())) qFatal("the lesson cannot be written");
    return text(file);
  }

  TemporaryFolder folder_;
};

TIDEMARK_TEST(CliLessonTest)

}  // namespace tidemark::test::cli_lesson_test

#include "cli_lesson_test.moc"
