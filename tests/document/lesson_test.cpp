// Lessons as files: what is written can be read, and bad ones are refused with their field.
#include <functional>

#include "core/atomic_file.h"
#include "tests/document/lessons.h"
#include "tests/support/test_program.h"

namespace tidemark::test::lesson_test {

using Json = nlohmann::json;

class LessonTest : public QObject {
  Q_OBJECT

 private slots:
  void everything_is_read() {
    const document::Lesson lesson = lesson_of(good_lesson());
    QCOMPARE(lesson.title, std::string("Size"));
    QCOMPARE(lesson.author, std::string("A. Lecturer"));
    QCOMPARE(lesson.minutes, 12);
    QCOMPARE(lesson.study.phantom, std::string("sphere:0"));
    QCOMPARE(lesson.parts.size(), std::size_t{4});
    QVERIFY(!lesson.parts[0].question && !lesson.parts[0].attempt);
    const document::LessonPart& stay = lesson.parts[1];
    QCOMPARE(stay.question->choices.size(), std::size_t{3});
    QCOMPARE(*stay.question->right, std::size_t{0});  // counted from 1 in the file
    QVERIFY((stay.attempt->show ==
             std::vector<document::LessonView>{document::LessonView::contours, document::LessonView::truth}));
    QCOMPARE(stay.attempt->parameters.alpha, 0.8);
    const document::LessonTry& grow = *lesson.parts[2].attempt;
    QVERIFY(grow.goes_on && grow.until_rest);
    QCOMPARE(grow.parameters.alpha, 1.0);
    QCOMPARE(*grow.parameters.rescale, 0.2);
    QCOMPARE(*grow.parameters.band, 3.0);  // the lesson's
    QVERIFY(!lesson.parts[3].attempt->parameters.band);
    QVERIFY(lesson.start_of(stay) == &*lesson.start);
    QVERIFY(lesson.start_of(lesson.parts[3]) == &*lesson.parts[3].attempt->start);
  }

  // The lesson's start lies in the lesson's study.
  void a_part_with_another_study_begins_with_the_phantoms_own_start() {
    Json json = good_lesson();
    json["parts"][3]["try"].erase("start");
    const document::Lesson lesson = lesson_of(json);
    QVERIFY(lesson.start_of(lesson.parts[3]) == nullptr);
  }

  void what_is_written_is_read_again() {
    const document::Lesson lesson = lesson_of(good_lesson());
    const std::string text = lesson.to_text().value();
    const auto again = document::Lesson::parse(text, "again.json");
    QCOMPARE(failure(again), QString());
    QCOMPARE(again->to_text().value(), text);
    for (std::size_t i = 0; i < lesson.parts.size(); ++i) {
      const document::LessonPart& part = lesson.parts[i];
      const document::LessonPart& other = again->parts[i];
      QVERIFY(part.study == other.study && part.question == other.question &&
              part.measures == other.measures);
      QCOMPARE(part.attempt.has_value(), other.attempt.has_value());
      if (!part.attempt) continue;
      QVERIFY(part.attempt->parameters == other.attempt->parameters);
      QCOMPARE(part.attempt->goes_on, other.attempt->goes_on);
      QCOMPARE(part.attempt->until_rest, other.attempt->until_rest);
      QCOMPARE(part.attempt->steps, other.attempt->steps);
      QCOMPARE(part.attempt->smoothed_mm, other.attempt->smoothed_mm);
      QVERIFY(part.attempt->show == other.attempt->show);
      QCOMPARE(part.attempt->start.has_value(), other.attempt->start.has_value());
    }
    QCOMPARE(again->start->seeds[0].radius_mm, 10.0);
  }

  void a_start_keeps_its_levels() {
    document::Lesson lesson = lesson_of(good_lesson());
    lesson.start->levels = 3;
    const auto text = lesson.to_text();
    QCOMPARE(failure(text), QString());
    const auto again = document::Lesson::parse(*text, "again.json");
    QCOMPARE(failure(again), QString());
    QCOMPARE(again->start->levels, 3);
  }

  void what_could_not_be_read_is_not_written() {
    document::Lesson lesson = lesson_of(good_lesson());
    lesson.parts[1].title = std::string(400, 'x');
    const auto text = lesson.to_text();
    QVERIFY(!text);
    QCOMPARE(text.error().kind, ErrorKind::usage);
    QCOMPARE(failure(text), QString("parts[1].title: more than 300 bytes are not read"));
    lesson = lesson_of(good_lesson());
    document::MaskStart mask{std::make_shared<const BitMask>(Geometry()), "mine"};
    lesson.start->from = mask;
    QVERIFY(failure(lesson.to_text()).startsWith("start.from"));
  }

  void a_bad_lesson_is_refused_with_its_field_data();
  void a_bad_lesson_is_refused_with_its_field();

  void a_file_is_loaded() {
    const TemporaryFolder folder;
    QVERIFY(write_file(folder / "mine.json", good_lesson().dump()));
    QCOMPARE(failure(document::Lesson::load(folder / "mine.json")), QString());
    QCOMPARE(document::Lesson::load(folder / "none.json").error().kind, ErrorKind::input);
    QVERIFY(!document::Lesson::load(folder.path()));
    std::filesystem::resize_file(folder / "mine.json", std::uintmax_t{1} << 32U);
    QVERIFY(failure(document::Lesson::load(folder / "mine.json")).contains("4294967296 bytes"));
  }
};

void LessonTest::a_bad_lesson_is_refused_with_its_field_data() {
  QTest::addColumn<QByteArray>("text");
  QTest::addColumn<QString>("says");
  const auto text_row = [](const char* name, const std::string& text, const char* says) {
    QTest::newRow(name) << QByteArray::fromStdString(text) << QString(says);
  };
  using Spoil = std::function<void(Json&)>;
  const auto row = [&](const char* name, const char* says, const Spoil& spoil) {
    Json json = good_lesson();
    spoil(json);
    text_row(name, json.dump(), says);
  };
  // A field by its path, with another value or, where that is discarded, without it.
  const auto set = [&](const char* path, const Json& value, const char* says) {
    row(fmt::format("{} {}", path, value.dump().substr(0, 40)).c_str(), says,
        [&](Json& json) { json[Json::json_pointer(path)] = value; });
  };
  const auto without = [&](const char* path, const char* says) {
    row(fmt::format("without {}", path).c_str(), says, [&](Json& json) {
      const Json::json_pointer at(path);
      Json& outer = json[at.parent_pointer()];
      outer.erase(at.back());
    });
  };
  const std::string good = good_lesson().dump();
  text_row("empty", "", "not JSON");
  text_row("truncated", good.substr(0, good.size() / 2), "not JSON");
  text_row("a list", "[]", "not an object");
  text_row("deep", std::string(40, '[') + std::string(40, ']'), "nested more than 32 deep");
  text_row("other bytes", std::string("\xff\xfe\x00{", 4), "not JSON");
  std::string huge = good;
  huge.replace(huge.find("\"minutes\":12"), 12, "\"minutes\":1e400");
  text_row("1e400 minutes", huge, "minutes: not a whole number");
  huge = good;
  huge.replace(huge.find("\"high\":10.1"), 11, "\"high\":1e400");
  text_row("1e400 high", huge, "parts[1].measure[0].high: inf is not within");
  without("/format", "format: is missing");
  set("/format", "tidemark recipe", "format: 'tidemark recipe' is unknown");
  without("/version", "version: is missing");
  set("/version", 2, "version: this version cannot be read");
  set("/version", "1", "version: not a whole number");
  without("/title", "title: is missing");
  set("/title", "", "title: is empty");
  set("/title", "two\nlines", "title: holds a control character");
  set("/title", "C1\u009b31m", "title: holds a control character");
  set("/title", "bell\a", "title: holds a control character");
  set("/title", std::string(301, 'x'), "title: more than 300 bytes are not read");
  set("/title", 5, "title: not a text");
  set("/titel", "x", "'titel' is no field that is known here");
  set("/about", " ", "about: is empty");
  set("/about", "\x1b[31m", "about: holds a control character");
  set("/minutes", -1, "minutes: -1 is not within 0 to 1000");
  without("/study", "study: is missing");
  set("/study/phantom", "teapot", "study.phantom: unknown phantom 'teapot'; there are sphere,");
  set("/study/phantom", "sphere\n", "study.phantom: holds a control character");
  set("/study/phantom", "sphere:", "study.phantom: noise of ''");
  set("/study/phantom", "sphere:200", "study.phantom: noise of '200'");
  set("/study/phantom", "sphere:nan", "study.phantom: noise of 'nan'");
  set("/study/file", "x.nii", "study: has a phantom and a file");
  set("/study/folder", "x", "study: 'folder' is no field");
  for (const char* path : {"../x.nii", "a/../../x.nii", "/etc/passwd", ".."}) {
    set("/study", {{"file", path}}, "study.file: must be a path below the lesson's folder");
  }
  set("/study", {{"file", ""}}, "study.file: is empty");
  set("/study", Json::object(), "study.file: is missing");
  without("/parameters", "parameters: is missing");
  without("/parameters/target", "parameters.target: is missing");
  without("/parameters/alpha", "parameters.alpha: is missing");
  set("/parameters/alpha", 2, "parameters: alpha must be between 0 and 1");
  set("/parameters/range", 0, "parameters: ");
  set("/parameters/beta", 1, "parameters: 'beta' is no field");
  set("/parameters/band", "wide", "parameters.band: 'wide' is unknown");
  set("/parameters/time_step_factor", "3", "parameters.time_step_factor: not a number");
  set("/start/seeds", Json::array(), "start: has nothing inside");
  set("/start/seed", 1, "start: 'seed' is no field");
  set("/start/levels", 4, "start.levels: ");
  set("/start/levels", "auto", "start.levels: ");
  set("/start/seeds/0/radius_mm", 0, "start.seeds[0].radius_mm: ");
  set("/start/seeds/0/radius", 1, "start.seeds[0]: 'radius' is no field");
  set("/start/from", {{"kind", "mask"}}, "start.from.kind: 'mask' is unknown");
  set("/start/from", {{"kind", "phi"}}, "start.from.kind: 'phi' is unknown");
  set("/start/from", {{"kind", "spheres"}, {"low", 1}}, "start.from: 'low' is no field");
  set("/start/from", {{"kind", "threshold"}, {"low", 2}, {"high", 1}}, "start.from.high: 1 is not within 2");
  without("/parts", "parts: is missing");
  set("/parts", Json::array(), "parts: has no part");
  set("/parts", Json(std::vector<Json>(101, good_lesson()["parts"][0])), "parts: more than 100 entries");
  without("/parts/0/text", "parts[0].text: is missing");
  set("/parts/0/text", std::string(8001, 'x'), "parts[0].text: more than 8000 bytes");
  set("/parts/0/measure", Json::array(), "parts[0].measure: needs a try");
  set("/parts/0/measures", Json::array(), "parts[0]: 'measures' is no field");
  set("/parts/0/explanation", "\r", "parts[0].explanation: holds a control character");
  set("/parts/1/question/choices", {"one"}, "parts[1].question.choices: needs two or more");
  set("/parts/1/question/choices/1", "", "parts[1].question.choices[1]: is empty");
  set("/parts/1/question/choices", Json(std::vector<Json>(11, "x")),
      "parts[1].question.choices: more than 10 entries");
  set("/parts/1/question/right", 0, "parts[1].question.right: 0 is not within 1 to 3");
  set("/parts/1/question/right", 4, "parts[1].question.right: 4 is not within 1 to 3");
  set("/parts/2/question/right", 1, "parts[2].question.right: needs choices");
  without("/parts/1/try/steps", "parts[1].try.steps: is missing");
  set("/parts/1/try/steps", 1000001, "parts[1].try.steps: 1000001 is not within 0 to 1000000");
  set("/parts/1/try/steps", -1, "parts[1].try.steps: -1 is not");
  set("/parts/1/try/goes_on", true, "parts[1].try: has nothing to go on from");
  set("/parts/2/try/parameters/band", 4, "parts[2].try: changes the band");
  set("/parts/2/study", {{"phantom", "dumbbell"}}, "parts[2].try: goes on with another study");
  set("/parts/3/try/goes_on", true, "parts[3].try.start: contradicts goes_on");
  row("a file without a start", "parts[3].try: needs a start", [](Json& json) {
    json["parts"][3]["study"] = {{"file", "x.nii"}};
    json["parts"][3]["try"].erase("start");
  });
  set("/parts/1/try/show/0", "fireworks", "parts[1].try.show[0]: 'fireworks' is unknown");
  set("/parts/2/try/smoothed_mm", -1, "parts[2].try.smoothed_mm: -1 is not within");
  set("/parts/1/measure/0/figure", "mass",
      "parts[1].measure[0].figure: 'mass' is unknown; there are volume_ml,");
  set("/parts/1/measure/0/high", 9, "parts[1].measure[0].high: 9 is not within 9.9");
  without("/parts/1/measure/0/low", "parts[1].measure[0].low: is missing");
  set("/parts/1/measure", Json(std::vector<Json>(11, good_lesson()["parts"][1]["measure"][0])),
      "parts[1].measure: more than 10 entries");
}

void LessonTest::a_bad_lesson_is_refused_with_its_field() {
  QFETCH(QByteArray, text);
  QFETCH(QString, says);
  const auto lesson = document::Lesson::parse(text.toStdString(), "bad.json");
  QVERIFY(!lesson);
  QCOMPARE(lesson.error().kind, ErrorKind::input);
  const QString message = failure(lesson);
  QVERIFY2(message.startsWith("bad.json: " + says) || (message.contains(says) && !says.contains(": ")),
           qPrintable(message));
  QVERIFY2(!message.contains('\n'), qPrintable(message));
}

TIDEMARK_TEST(LessonTest)

}  // namespace tidemark::test::lesson_test

#include "lesson_test.moc"
