// Walls and anchors in recipes: each change costs what it marks, all come back, and bad ones are refused.
#include <functional>
#include <nlohmann/json.hpp>

#include "tests/document/cases.h"
#include "tests/support/test_program.h"

namespace tidemark::test::constraints_json_test {

using Json = nlohmann::json;
using solver::Constraint;
using solver::Constraints;

namespace {

// A recipe whose drive has the first of these, and whose events have the others one after the other.
document::Recipe recipe_of(const std::vector<Constraints>& held) {
  const auto document = make_case(lumpy_volume());
  if (!document->level_set().begin(seed_in(*document->volume()))) qFatal("no surface");
  document::Recipe recipe = document->level_set().recipe();
  for (const Constraints& one : held) {
    document::Drive drive;
    drive.constraints = std::make_shared<const Constraints>(one);
    auto shared = std::make_shared<const document::Drive>(std::move(drive));
    if (recipe.drive == nullptr) {
      recipe.drive = std::move(shared);
    } else {
      recipe.events.push_back({0, document::DriveEvent{std::move(shared)}});
    }
  }
  return recipe;
}

Constraints ball(Constraint what, double radius_mm = 3.0) {
  const auto volume = lumpy_volume();
  Constraints constraints(volume->geometry.size);
  constraints.set(volume->geometry, ball_at(*volume, {4, 0, 0}, radius_mm), what);
  return constraints;
}

// All of a recipe's, in their order.
std::vector<Constraints> constraints_in(const document::Recipe& recipe) {
  std::vector<Constraints> found;
  const auto add = [&](const document::Drive& drive) {
    found.push_back(drive.constraints ? *drive.constraints : Constraints(recipe.source.size));
  };
  add(*recipe.drive);
  for (const document::RecipeEvent& event : recipe.events) {
    if (const auto* change = std::get_if<document::DriveEvent>(&event.what)) add(*change->drive);
  }
  return found;
}

Json json_of(const std::vector<Constraints>& held) {
  return Json::parse(recipe_of(held).to_text().value());
}

}  // namespace

class ConstraintsJsonTest : public QObject {
  Q_OBJECT

 private slots:
  void all_changes_come_back() {
    std::vector<Constraints> held{ball(Constraint::wall)};
    held.push_back(held.back());
    held.back().set(std::vector<Index3>{{0, 0, 0}, {1, 0, 0}, {36, 33, 28}}, Constraint::anchor);
    held.push_back(held.back());  // unchanged
    held.push_back(held.back());
    held.back().set(lumpy_volume()->geometry, ball_at(*lumpy_volume(), {4, 0, 0}, 1.5), Constraint::none);
    held.push_back(held.back());
    held.back().set(lumpy_volume()->geometry, ball_at(*lumpy_volume(), {6, 0, 0}, 1.5), Constraint::anchor);
    held.emplace_back(lumpy_volume()->geometry.size);  // none any more
    held.push_back(ball(Constraint::anchor));
    const document::Recipe recipe = recipe_of(held);
    const auto text = recipe.to_text();
    QCOMPARE(failure(text), QString());
    const auto read = document::Recipe::parse(*text, "r.json");
    QCOMPARE(failure(read), QString());
    QVERIFY(constraints_in(*read) == held);
    QCOMPARE(QByteArray::fromStdString(read->to_text().value()), QByteArray::fromStdString(*text));
  }

  void half_a_volume_of_walls_comes_back() {
    const std::vector<Constraints> held{ball(Constraint::wall, 12.0), ball(Constraint::anchor, 12.0)};
    const Json json = json_of(held);
    QVERIFY(json["drive"].contains("walls"));
    const auto read = document::Recipe::parse(json.dump(), "r.json");
    QCOMPARE(failure(read), QString());
    QVERIFY(constraints_in(*read) == held);
  }

  void a_stroke_costs_what_it_marks() {
    std::vector<Constraints> held{ball(Constraint::wall)};
    for (std::int64_t stroke = 0; stroke < 200; ++stroke) {
      held.push_back(held.back());
      held.back().set(std::vector<Index3>{{stroke % 37, 0, stroke / 37}}, Constraint::wall);
    }
    std::vector<Constraints> unchanged(held.size(), held.front());
    const std::size_t least = recipe_of(unchanged).to_text()->size();
    const std::size_t all = recipe_of(held).to_text()->size();
    QVERIFY2(all < least + 200 * 200,
             qPrintable(QString("%1 bytes, %2 without changes").arg(all).arg(least)));
  }

  void bad_ones_are_refused_with_their_field_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("says");
    const auto row = [](const char* name, double radius_mm, const std::function<void(Json&)>& spoil,
                        const char* says) {
      Json json = json_of({ball(Constraint::wall, radius_mm)});
      spoil(json["drive"]);
      QTest::newRow(name) << QByteArray::fromStdString(json.dump()) << QString(says);
    };
    row(
        "list cut", 3.0, [](Json& j) { j["constraints"]["walls"]["steps"] = "eJw="; },
        "drive.constraints.walls.steps: does not hold");
    row(
        "list of none", 3.0, [](Json& j) { j["constraints"]["walls"]["count"] = 0; },
        "drive.constraints.walls.count: ");
    row(
        "list of more than the volume has", 3.0,
        [](Json& j) { j["constraints"]["walls"]["count"] = std::int64_t{1} << 60; },
        "drive.constraints.walls.count: ");
    // Sixteen bytes each: 0 and then 0, and 0 and then as far as it goes.
    row(
        "voxel twice", 3.0,
        [](Json& j) {
          j["constraints"]["walls"] = {{"count", 2}, {"steps", "eAFjYEAFAAAQAAE="}};
        },
        "drive.constraints.walls.steps: are not voxels");
    row(
        "voxel beyond the volume", 3.0,
        [](Json& j) {
          j["constraints"]["walls"] = {{"count", 2}, {"steps", "eAFjYICA/xBQDwAjbAd5"}};
        },
        "drive.constraints.walls.steps: are not voxels");
    row(
        "bits cut", 12.0, [](Json& j) { j["walls"] = "eJw="; }, "drive.walls: does not hold");
    row(
        "no anchors beside the walls' bits", 12.0, [](Json& j) { j.erase("anchors"); }, "drive.anchors: ");
  }
  void bad_ones_are_refused_with_their_field() {
    QFETCH(QByteArray, text);
    QFETCH(QString, says);
    const auto recipe = document::Recipe::parse(text.toStdString(), "bad.json");
    QVERIFY(!recipe);
    QCOMPARE(recipe.error().kind, ErrorKind::input);
    QVERIFY2(failure(recipe).startsWith("bad.json: " + says), qPrintable(failure(recipe)));
  }

  void bits_of_a_large_volume_take_no_memory() {
    Json json = json_of({ball(Constraint::wall, 12.0)});
    json["source"]["size"] = {1000, 1000, 2000};
    const auto recipe = document::Recipe::parse(json.dump(), "bad.json");
    QVERIFY2(failure(recipe).startsWith("bad.json: drive.walls: does not hold"), qPrintable(failure(recipe)));
  }
};

TIDEMARK_TEST(ConstraintsJsonTest)

}  // namespace tidemark::test::constraints_json_test

#include "constraints_json_test.moc"
