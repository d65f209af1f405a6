// Lessons carried out: where tries begin, how far they go, and what is measured.
#include <glm/geometric.hpp>
#include <map>
#include <numbers>

#include "document/lesson_figure.h"
#include "document/lesson_run.h"
#include "imaging/files/volume_file.h"
#include "imaging/phantom/phantom.h"
#include "tests/document/lessons.h"
#include "tests/support/test_program.h"

namespace tidemark::test::lesson_run_test {

using Json = nlohmann::json;

namespace {

Result<std::vector<document::LessonOutcome>> carried_out(
    const document::Lesson& lesson, solver::ExecutorKind kind = solver::ExecutorKind::host,
    const std::filesystem::path& folder = {}) {
  return document::carry_out(lesson, folder, kind, {.threads = 1});
}

}  // namespace

class LessonRunTest : public QObject {
  Q_OBJECT

 private slots:
  void a_lesson_is_carried_out() {
    const document::Lesson lesson = lesson_of(good_lesson());
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
    Json json = good_lesson();
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

  void a_study_of_one_slice_along_any_axis_has_a_disc() {
    for (int axis = 0; axis < 3; ++axis) {
      Geometry grid;
      grid.size = Index3(32);
      grid.size[axis] = 1;
      grid.spacing_mm[axis] = 5.0;
      const glm::dvec3 centre = grid.to_patient(0.5 * glm::dvec3(grid.size - Index3(1)));
      std::vector<float> values;
      for (std::int64_t offset = 0; offset < grid.voxel_count(); ++offset) {
        const glm::dvec3 place = grid.to_patient(glm::dvec3(grid.voxel_at(offset)));
        values.push_back(static_cast<float>(9.0 - glm::distance(place, centre)));
      }
      const solver::Field phi = solver::Field::from_dense(grid, values, 2.5);
      const document::LessonState state{phi, 0, false, 0.0, {}, nullptr};
      const auto figure = [&](const char* name) {
        return document::lesson_figure(name)->measure(state, {}).value();
      };
      const double radius_mm = figure("radius_mm").value_or(-1.0);
      QVERIFY2(std::abs(radius_mm - 9.0) < 0.1, qPrintable(QString::number(radius_mm)));
      const double area_cm2 = figure("area_cm2").value_or(-1.0);
      QVERIFY2(std::abs(area_cm2 - 2.0 * std::numbers::pi * 9.0 * 5.0 / 100.0) < 0.05,
               qPrintable(QString::number(area_cm2)));
      QVERIFY(!figure("sphericity"));
    }
  }

  // Half a ball: its area is 3 pi r^2 with the face where the study ends.
  void a_surface_that_the_studys_end_cuts_is_no_ball() {
    const Json start{{"seeds", {{{"centre_mm", {40.0, 0.0, 0.0}}, {"radius_mm", 15}}}}};
    const document::Lesson lesson =
        lesson_of_part({{"try", {{"steps", 0}, {"start", start}}},
                        {"measure", {{{"figure", "sphericity"}, {"low", 0.8}, {"high", 0.88}}}}});
    const auto outcomes = carried_out(lesson);
    QCOMPARE(failure(outcomes), QString());
    const double sphericity = outcomes->front().figures[0].value_or(-1.0);
    QVERIFY2(outcomes->front().holds(lesson.parts[0]), qPrintable(QString::number(sphericity)));
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
    Json json = good_lesson();
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
    const auto outcomes = document::carry_out(lesson_of(good_lesson()), {}, solver::ExecutorKind::host,
                                              {.threads = 1}, Progress{nullptr, stop.get_token()});
    QVERIFY(!outcomes);
    QCOMPARE(outcomes.error().kind, ErrorKind::cancelled);
  }
};

TIDEMARK_TEST(LessonRunTest)

}  // namespace tidemark::test::lesson_run_test

#include "lesson_run_test.moc"
