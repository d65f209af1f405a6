// Lessons as files: what is written can be read, bad ones are refused with their field, and tries come out.
#include <QProcess>
#include <clocale>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>

#include "core/atomic_file.h"
#include "document/lesson_answers.h"
#include "document/lesson_figure.h"
#include "document/lesson_run.h"
#include "imaging/files/volume_file.h"
#include "imaging/phantom/phantom.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

using namespace tidemark;
using namespace tidemark::test;
using Json = nlohmann::json;

namespace {

// Everything that can be in one.
Json good_json() {
  const Json ball{{"centre_mm", {0, 0, 0}}, {"radius_mm", 10}};
  const Json small{{"centre_mm", {4, 0, 0}}, {"radius_mm", 2.5}};
  const Json start{{"seeds", {ball}}};
  return {{"format", "tidemark lesson"},
          {"version", 1},
          {"title", "Size"},
          {"about", "A ball, \"quoted\", and a Größe."},
          {"author", "A. Lecturer"},
          {"minutes", 12},
          {"study", {{"phantom", "sphere:0"}}},
          {"start", start},
          {"parameters", {{"target", 800}, {"range", 300}, {"alpha", 0.8}, {"band", 3}}},
          {"parts",
           {{{"title", "Read"}, {"text", "One.\n\nTwo."}},
            {{"title", "Stay"},
             {"text", "Nothing moves."},
             {"question", {{"text", "How large?"}, {"choices", {"10 mm", "20 mm", "30 mm"}}, {"right", 1}}},
             {"try", {{"steps", 0}, {"show", {"contours", "truth"}}}},
             {"measure",
              {{{"figure", "radius_mm"}, {"low", 9.9}, {"high", 10.1}},
               {{"figure", "steps"}, {"low", 0}, {"high", 0}}}},
             {"explanation", "It is the seed."}},
            {{"title", "Grow"},
             {"text", "It grows."},
             {"question", {{"text", "Why?"}}},
             {"try",
              {{"goes_on", true},
               {"parameters", {{"alpha", 1}, {"rescale", 0.2}}},
               {"smoothed_mm", 1},
               {"steps", 300},
               {"until_rest", true}}},
             {"measure",
              {{{"figure", "radius_mm"}, {"low", 19.5}, {"high", 20.5}},
               {{"figure", "rests"}, {"low", 1}, {"high", 1}},
               {{"figure", "dice"}, {"low", 0.98}, {"high", 1}}}}},
            {{"title", "Another"},
             {"text", "Elsewhere."},
             {"study", {{"phantom", "dumbbell"}}},
             {"try",
              {{"start",
                {{"from", {{"kind", "threshold"}, {"low", 500}, {"high", 900}}},
                 {"seeds", Json::array()},
                 {"erasers", {small}}}},
               {"parameters", {{"band", "default"}}},
               {"steps", 3}}},
             {"measure", {{{"figure", "bodies"}, {"low", 1}, {"high", 1}}}}}}}};
}

document::Lesson lesson_of(const Json& json) {
  auto lesson = document::Lesson::parse(json.dump(), "good.json");
  if (!lesson) qFatal("%s", lesson.error().message.c_str());
  return std::move(*lesson);
}

// A lesson with that part alone.
document::Lesson lesson_of_part(Json part) {
  Json json = good_json();
  part["title"] = "Part";
  part["text"] = "Text.";
  json["parts"] = Json::array({std::move(part)});
  return lesson_of(json);
}

Result<std::vector<document::LessonOutcome>> carried_out(
    const document::Lesson& lesson, solver::ExecutorKind kind = solver::ExecutorKind::host,
    const std::filesystem::path& folder = {}) {
  return document::carry_out(lesson, folder, kind, {.threads = 1});
}

}  // namespace

class LessonTest : public QObject {
  Q_OBJECT

 private slots:
  void everything_is_read() {
    const document::Lesson lesson = lesson_of(good_json());
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
    Json json = good_json();
    json["parts"][3]["try"].erase("start");
    const document::Lesson lesson = lesson_of(json);
    QVERIFY(lesson.start_of(lesson.parts[3]) == nullptr);
  }

  void what_is_written_is_read_again() {
    const document::Lesson lesson = lesson_of(good_json());
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

  void what_could_not_be_read_is_not_written() {
    document::Lesson lesson = lesson_of(good_json());
    lesson.parts[1].title = std::string(400, 'x');
    const auto text = lesson.to_text();
    QVERIFY(!text);
    QCOMPARE(text.error().kind, ErrorKind::usage);
    QCOMPARE(failure(text), QString("parts[1].title: more than 300 bytes are not read"));
    lesson = lesson_of(good_json());
    document::MaskStart mask{std::make_shared<const Mask>(), "mine"};
    lesson.start->from = mask;
    QVERIFY(failure(lesson.to_text()).startsWith("start.from"));
  }

  void a_bad_lesson_is_refused_with_its_field_data();
  void a_bad_lesson_is_refused_with_its_field();

  void a_file_is_loaded() {
    const TemporaryFolder folder;
    QVERIFY(write_file(folder / "mine.json", good_json().dump()));
    QCOMPARE(failure(document::Lesson::load(folder / "mine.json")), QString());
    QCOMPARE(document::Lesson::load(folder / "none.json").error().kind, ErrorKind::input);
    QVERIFY(!document::Lesson::load(folder.path()));
    std::filesystem::resize_file(folder / "mine.json", std::uintmax_t{1} << 32U);
    QVERIFY(failure(document::Lesson::load(folder / "mine.json")).contains("4294967296 bytes"));
  }

  void a_lesson_is_carried_out() {
    const document::Lesson lesson = lesson_of(good_json());
    std::vector<std::string> titles;
    const auto outcomes =
        document::carry_out(lesson, {}, solver::ExecutorKind::host, {.threads = 1}, {},
                            [&](const document::LessonPart& part, const document::LessonOutcome&) {
                              titles.push_back(part.title);
                            });
    QCOMPARE(failure(outcomes), QString());
    QVERIFY((titles == std::vector<std::string>{"Read", "Stay", "Grow", "Another"}));
    QVERIFY((*outcomes)[0].figures.empty());
    for (std::size_t i = 0; i < lesson.parts.size(); ++i) {
      QVERIFY2((*outcomes)[i].holds(lesson.parts[i]), lesson.parts[i].title.c_str());
    }
  }

  // Where it began anew the ball of 10 mm could not be 20 mm after so few steps.
  void a_try_goes_on_from_the_one_before() {
    Json json = good_json();
    json["parts"][1]["try"]["steps"] = 20;
    json["parts"][2]["try"] = {{"goes_on", true}, {"steps", 5}};
    json["parts"][2]["measure"] = {{{"figure", "steps"}, {"low", 25}, {"high", 25}},
                                   {{"figure", "radius_mm"}, {"low", 0}, {"high", 100}}};
    json["parts"].erase(3);
    const auto outcomes = carried_out(lesson_of(json));
    QCOMPARE(failure(outcomes), QString());
    QCOMPARE(*(*outcomes)[2].figures[0], 25.0);
    QVERIFY(*(*outcomes)[2].figures[1] > *(*outcomes)[1].figures[0] + 0.1);
    json["parts"][2]["try"]["goes_on"] = false;
    QCOMPARE(*(*carried_out(lesson_of(json)))[2].figures[0], 5.0);
  }

  void a_figure_out_of_its_range_does_not_hold() {
    const document::Lesson lesson = lesson_of_part(
        {{"try", {{"steps", 0}}}, {"measure", {{{"figure", "radius_mm"}, {"low", 11}, {"high", 12}}}}});
    const auto outcomes = carried_out(lesson);
    QCOMPARE(failure(outcomes), QString());
    QVERIFY(!outcomes->front().holds(lesson.parts[0]));
    QVERIFY(!document::LessonOutcome{}.holds(lesson.parts[0]));
    QVERIFY(!lesson.parts[0].measures[0].holds(std::nan("")));
  }

  void every_figure_is_measured() {
    Json measures = Json::array();
    for (const document::LessonFigure& figure : document::lesson_figures()) {
      measures.push_back({{"figure", figure.name}, {"low", -1e9}, {"high", 1e9}});
    }
    Json part{{"try", {{"steps", 2}}}};
    std::map<std::string_view, double> values;
    for (std::size_t first = 0; first < measures.size(); first += 10) {
      part["measure"] = Json::array();
      for (std::size_t i = first; i < std::min(first + 10, measures.size()); ++i) {
        part["measure"].push_back(measures[i]);
      }
      const auto outcomes = carried_out(lesson_of_part(part));
      QCOMPARE(failure(outcomes), QString());
      for (std::size_t i = 0; i < outcomes->front().figures.size(); ++i) {
        const document::LessonFigure& figure = document::lesson_figures()[first + i];
        QVERIFY2(outcomes->front().figures[i].has_value(), figure.name.data());
        values[figure.name] = *outcomes->front().figures[i];
      }
    }
    QVERIFY(values["radius_mm"] > 10.0 && values["radius_mm"] < 12.0);
    const double r = values["radius_mm"];
    QVERIFY(std::abs(values["volume_ml"] - 4.0 / 3.0 * 3.14159265 * r * r * r / 1000.0) < 0.01);
    QVERIFY(std::abs(values["area_cm2"] - 4.0 * 3.14159265 * r * r / 100.0) < 0.3);
    QVERIFY(values["sphericity"] > 0.97 && values["sphericity"] < 1.01);
    QCOMPARE(values["bodies"], 1.0);
    QCOMPARE(values["steps"], 2.0);
    QCOMPARE(values["rests"], 0.0);
    QVERIFY(values["time_step"] > 0.1 && values["time_step"] < 0.6);
    QVERIFY(values["dice"] > 0.2 && values["dice"] < 0.5);
    QVERIFY(std::abs(values["mean_distance_mm"] - (20.0 - r)) < 0.3);
    QVERIFY(std::abs(values["largest_distance_mm"] - (20.0 - r)) < 1.0);
    QVERIFY(values["gradient_error"] < 0.1);
    QVERIFY(values["resident_pages"] > 20 && values["resident_pages"] < 500);
    QVERIFY(values["resident_percent"] > 1 && values["resident_percent"] < 50);
    QVERIFY(values["memory_mib"] > 0.01 && values["memory_mib"] < 100);
  }

  // A distance to a surface that is not there is no figure.
  void figures_that_do_not_exist_are_unset() {
    const Json curvature{{"alpha", 0}, {"data_term", false}};
    // Not in the middle of a voxel: the slope there is 0, and such a voxel stays for ever.
    const Json start{{"seeds", {{{"centre_mm", {0.4, 0.3, 0.2}}, {"radius_mm", 8}}}}};
    const document::Lesson lesson =
        lesson_of_part({{"try", {{"steps", 400}, {"start", start}, {"parameters", curvature}}},
                        {"measure",
                         {{{"figure", "volume_ml"}, {"low", 0}, {"high", 0}},
                          {{"figure", "mean_distance_mm"}, {"low", 0}, {"high", 1}},
                          {{"figure", "largest_distance_mm"}, {"low", 0}, {"high", 1}},
                          {{"figure", "gradient_error"}, {"low", 0}, {"high", 1}}}}});
    const auto outcomes = carried_out(lesson);
    QCOMPARE(failure(outcomes), QString());
    QCOMPARE(*outcomes->front().figures[0], 0.0);
    QVERIFY(!outcomes->front().figures[1] && !outcomes->front().figures[2] && !outcomes->front().figures[3]);
    QVERIFY(!outcomes->front().holds(lesson.parts[0]));
  }

  void distances_exist_in_any_band() {
    for (const Json& band : {Json("infinite"), Json(2), Json(9)}) {
      const Json attempt{{"steps", 0}, {"parameters", {{"band", band}}}};
      const Json measure{{"figure", "mean_distance_mm"}, {"low", 9.7}, {"high", 10.3}};
      const document::Lesson lesson = lesson_of_part({{"try", attempt}, {"measure", {measure}}});
      const auto outcomes = carried_out(lesson);
      QCOMPARE(failure(outcomes), QString());
      const double distance = outcomes->front().figures[0].value_or(-1.0);
      QVERIFY2(outcomes->front().holds(lesson.parts[0]), qPrintable(QString::number(distance)));
    }
  }

  void a_study_beside_the_lesson_is_loaded() {
    const TemporaryFolder folder;
    Json json = good_json();
    json["study"] = {{"file", "data/ball.nrrd"}};
    json["parts"] = Json::array({json["parts"][1]});
    const document::Lesson lesson = lesson_of(json);
    const auto missing = carried_out(lesson, solver::ExecutorKind::host, folder.path());
    QVERIFY(!missing);
    QCOMPARE(missing.error().kind, ErrorKind::input);
    QVERIFY2(failure(missing).startsWith("part 1 'Stay': "), qPrintable(failure(missing)));
    std::filesystem::create_directory(folder / "data");
    const auto phantom = imaging::make_phantom("sphere").value();
    QCOMPARE(failure(imaging::write_volume_file(phantom.volume, folder / "data" / "ball.nrrd")), QString());
    const auto outcomes = carried_out(lesson, solver::ExecutorKind::host, folder.path());
    QCOMPARE(failure(outcomes), QString());
    QVERIFY(outcomes->front().holds(lesson.parts[0]));
  }

  void cancelling_ends_it() {
    std::stop_source stop;
    stop.request_stop();
    const auto outcomes = document::carry_out(lesson_of(good_json()), {}, solver::ExecutorKind::host,
                                              {.threads = 1}, Progress{nullptr, stop.get_token()});
    QVERIFY(!outcomes);
    QCOMPARE(outcomes.error().kind, ErrorKind::cancelled);
  }

  void a_score_counts_what_is_right() {
    const document::Lesson lesson = lesson_of(good_json());
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
    const std::string csv = document::to_csv(lesson_of(good_json()), answers);
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

  void an_answer_that_is_no_choice_is_none() {
    document::LessonAnswers answers{"A", "2026-03-31", {}};
    answers.parts.resize(2);
    answers.parts[1].choice = 7;
    const std::string csv = document::to_csv(lesson_of(good_json()), answers);
    QVERIFY(csv.find("\"How large?\",\"\",\"10 mm\",no") != std::string::npos);
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
    Json json = good_json();
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
  const std::string good = good_json().dump();
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
  set("/start/seeds/0/radius_mm", 0, "start.seeds[0].radius_mm: ");
  set("/start/seeds/0/radius", 1, "start.seeds[0]: 'radius' is no field");
  set("/start/from", {{"kind", "mask"}}, "start.from.kind: 'mask' is unknown");
  set("/start/from", {{"kind", "phi"}}, "start.from.kind: 'phi' is unknown");
  set("/start/from", {{"kind", "spheres"}, {"low", 1}}, "start.from: 'low' is no field");
  set("/start/from", {{"kind", "threshold"}, {"low", 2}, {"high", 1}}, "start.from.high: 1 is not within 2");
  without("/parts", "parts: is missing");
  set("/parts", Json::array(), "parts: has no part");
  set("/parts", Json(std::vector<Json>(101, good_json()["parts"][0])), "parts: more than 100 entries");
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
  set("/parts/1/measure", Json(std::vector<Json>(11, good_json()["parts"][1]["measure"][0])),
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
#include "lesson_test.moc"
