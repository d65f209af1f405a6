// Recipes with speed functions, walls and anchors: what is written is read again, and replays to the same
// bits.
#include <functional>
#include <nlohmann/json.hpp>

#include "document/checksum.h"
#include "document/evolution.h"
#include "solver/distance_transform.h"
#include "solver/speed/motion_limit.h"
#include "tests/document/recipes.h"
#include "tests/support/test_program.h"

namespace tidemark::test::drive_recipe_test {

using Json = nlohmann::json;

namespace {

document::Drive learning(const Volume& volume) {
  auto strokes = std::make_shared<solver::Strokes>();
  for (std::int64_t offset = 0; offset < volume.geometry.voxel_count(); offset += 17) {
    if (volume.value(offset) > 800.0F) strokes->inside.push_back(offset);
    if (volume.value(offset) < 650.0F) strokes->outside.push_back(offset);
  }
  document::Drive drive;
  drive.setting.terms = {{"examples", {{"trees", 12.0}}}};
  drive.strokes = std::move(strokes);
  return drive;
}

document::Drive with_ball(document::Drive drive, const Volume& volume, glm::dvec3 off_mm,
                          solver::Constraint what) {
  auto constraints = drive.constraints ? std::make_shared<solver::Constraints>(*drive.constraints)
                                       : std::make_shared<solver::Constraints>(volume.geometry.size);
  constraints->set(volume.geometry, ball_at(volume, off_mm, 3.0), what);
  drive.constraints = std::move(constraints);
  return drive;
}

// As the engine does it: the function is made for what is wanted, and handed over.
void drive(document::LevelSet& level_set, const document::Drive& wanted) {
  QCOMPARE(failure(level_set.set_drive(wanted)), QString());
  if (wanted.setting.is_tent()) return;
  const auto speed = document::make_speed(wanted, level_set.source(), level_set.parameters());
  QCOMPARE(failure(speed), QString());
  QCOMPARE(failure(level_set.set_speed(*speed)), QString());
}

// A recipe with everything that drives and holds, as JSON.
Json good_json() {
  static const Json json = [] {
    const auto document = begun_case();
    const Volume& volume = *document->volume();
    document::Recipe recipe = document->level_set().recipe();
    document::Drive all = with_ball(learning(volume), volume, {6, 0, 0}, solver::Constraint::wall);
    all = with_ball(all, volume, {0, 0, 0}, solver::Constraint::anchor);
    all.setting.terms.push_back({"edges", {{"sigma", 1.5}}});
    all.setting.combine = solver::Combine::product;
    document::CaseImage image;
    image.name = "PET";
    image.series_uid = "1.2.3";
    image.frame_of_reference_uid = "1.2.4";
    image.checksum = std::string(64, 'a');
    image.to_case[3] = {1.0, -2.5, 30.0, 1.0};
    all.images = {std::make_shared<const document::CaseImage>(image)};
    all.map = std::make_shared<const document::SpeedMap>(
        document::SpeedMap{"map.nrrd", std::string(64, 'b'), nullptr, {}});
    recipe.drive = std::make_shared<const document::Drive>(all);
    return Json::parse(recipe.to_text().value());
  }();
  return json;
}

}  // namespace

class DriveRecipeTest : public QObject {
  Q_OBJECT

 private slots:
  void a_replay_gives_the_same_bits_data() { add_executors(); }
  void a_replay_gives_the_same_bits() {
    const auto document = begun_case(this_executor());
    document::LevelSet& level_set = document->level_set();
    const auto volume = document->volume();
    run(level_set, 12);
    drive(level_set, learning(*volume));
    run(level_set, 30);
    const auto function = level_set.executor().speed();
    QVERIFY(function);
    QCOMPARE(failure(level_set.set_drive(
                 with_ball(level_set.drive(), *volume, {9, 0, 0}, solver::Constraint::wall))),
             QString());
    QCOMPARE(level_set.executor().speed(), function);  // a wall makes no function anew
    run(level_set, 20);
    document::Drive joined = level_set.drive();
    joined.setting.terms = {{"tent", {}}, {"edges", {}}};
    drive(level_set, joined);
    run(level_set, 10);
    QCOMPARE(failure(level_set.set_parameters(with_target(level_set.parameters(), 870.0))), QString());
    run(level_set, 10);
    const std::vector<float> phi = values_of(level_set);
    const document::Recipe recipe = again(level_set.recipe());
    QCOMPARE(recipe.events.size(), std::size_t{4});
    QVERIFY(replayed(recipe, volume) == phi);
    document::Recipe without = recipe;
    std::erase_if(without.events,
                  [](const auto& e) { return std::holds_alternative<document::DriveEvent>(e.what); });
    QVERIFY(replayed(without, volume) != phi);
  }

  // The function is learned again then, and pages that rested wake, though nothing is another.
  void strokes_drawn_again_over_themselves_replay_to_the_same_bits_data() { add_executors(); }
  void strokes_drawn_again_over_themselves_replay_to_the_same_bits() {
    const auto document = begun_case(this_executor());
    document::LevelSet& level_set = document->level_set();
    drive(level_set, learning(*document->volume()));
    for (int i = 0; i < 100 && level_set.executor().memory().quiet_pages == 0; ++i) run(level_set, 10);
    QVERIFY(level_set.executor().memory().quiet_pages > 0);
    document::Drive again_drawn = level_set.drive();
    again_drawn.strokes = std::make_shared<const solver::Strokes>(*again_drawn.strokes);
    drive(level_set, again_drawn);
    run(level_set, 40);
    const document::Recipe recipe = again(level_set.recipe());
    QCOMPARE(recipe.events.size(), std::size_t{2});
    QVERIFY(replayed(recipe, document->volume()) == values_of(level_set));
  }

  void a_refined_mask_stays_near_replays_and_is_undone_data() { add_executors(); }
  void a_refined_mask_stays_near_replays_and_is_undone() {
    const auto document = begun_case(this_executor());
    document::LevelSet& level_set = document->level_set();
    const auto volume = document->volume();
    run(level_set, 5);
    const std::vector<float> before = values_of(level_set);
    const auto mask = std::make_shared<const BitMask>(level_set.checkpoint().value()->mask());
    constexpr double kWithin = 1.5;
    document::Start start;
    start.from = document::limited({mask, "mask.nrrd"}, kWithin).value();
    QCOMPARE(failure(level_set.begin(start)), QString());
    QVERIFY(level_set.executor().constraints());
    run(level_set, 40);
    // Walls are held beside the limit, and take nothing of it away.
    drive(level_set, with_ball(level_set.drive(), *volume, {9, 0, 0}, solver::Constraint::wall));
    run(level_set, 40);
    const std::vector<float> phi = values_of(level_set);
    const solver::Field distance = solver::distance_transform(inside_of(*mask), 6.0);
    const std::vector<float> far = distance.dense();
    std::int64_t outside = 0;
    for (std::size_t i = 0; i < phi.size(); ++i) {
      if (phi[i] > 0.0F) QVERIFY(static_cast<double>(far[i]) > -kWithin);
      if (phi[i] <= 0.0F && far[i] > 0.0F) QVERIFY(static_cast<double>(far[i]) < kWithin + 3.0);
      if (phi[i] > 0.0F && far[i] < 0.0F) ++outside;
    }
    QVERIFY(outside > 50);
    const document::Recipe recipe = again(level_set.recipe());
    QVERIFY(recipe.start.limit());
    QCOMPARE(recipe.start.limit()->within_mm(), kWithin);
    QVERIFY(replayed(recipe, volume) == phi);
    document::Recipe free = recipe;
    std::get<document::MaskStart>(free.start.from).limit = nullptr;
    QVERIFY(replayed(free, volume) != phi);

    while (level_set.recipe().start.limit()) QCOMPARE(failure(document->undo()), QString());
    QVERIFY(!level_set.executor().constraints());
    QVERIFY(values_of(level_set) == before);
    while (document->history().redo_description()) QCOMPARE(failure(document->redo()), QString());
    QVERIFY(values_of(level_set) == phi);
    QVERIFY(level_set.executor().constraints());
    // Another start takes the limit away, but not the wall.
    start.from = document::MaskStart{mask, "mask.nrrd"};
    QCOMPARE(failure(level_set.begin(start)), QString());
    QVERIFY(level_set.executor().constraints() == level_set.drive().constraints);
    // As a session does it.
    const auto opened = begun_case(this_executor());
    auto kept = std::make_shared<const solver::Field>(solver::Field::from_dense(
        volume->geometry, phi, level_set.executor().band(), level_set.executor().memory().page_shape));
    QCOMPARE(failure(opened->level_set().resume_from(recipe, kept)), QString());
    run(opened->level_set(), 60);
    const std::vector<float> later = values_of(opened->level_set());
    for (std::size_t i = 0; i < later.size(); ++i) {
      if (later[i] > 0.0F) QVERIFY(static_cast<double>(far[i]) > -kWithin);
    }
  }

  void a_limit_that_is_none_is_refused() {
    const auto mask = std::make_shared<const BitMask>(Geometry());
    for (const double within_mm : {0.0, -1.0, std::nan("")}) {
      const auto refined = document::limited({mask, {}}, within_mm);
      QVERIFY(!refined && refined.error().kind == ErrorKind::usage);
    }
  }

  // Means that follow the surface are those of the run, also when a wall comes in the middle of a window.
  void a_function_that_follows_the_surface_replays() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    document::Drive regions;
    regions.setting.terms = {{"regions", {}}};
    drive(level_set, regions);
    run(level_set, 37);
    drive(level_set, with_ball(level_set.drive(), *document->volume(), {7, 0, 0}, solver::Constraint::wall));
    run(level_set, 41);
    QVERIFY(replayed(again(level_set.recipe()), document->volume()) == values_of(level_set));
  }

  void a_wall_that_is_taken_away_again_has_moved_the_surface() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    const Volume& volume = *document->volume();
    run(level_set, 10);
    const glm::dvec3 place{1.3, -0.7, 0.4};
    const auto wall = with_ball({}, volume, place, solver::Constraint::wall);
    drive(level_set, wall);
    const auto wider = with_ball(wall, volume, place + glm::dvec3(2, 0, 0), solver::Constraint::wall);
    drive(level_set, wider);
    QCOMPARE(level_set.recipe().events.size(), std::size_t{1});  // the second covers the first
    drive(level_set, with_ball(wider, volume, place, solver::Constraint::none));
    QCOMPARE(level_set.recipe().events.size(), std::size_t{2});
    run(level_set, 3);
    QVERIFY(replayed(again(level_set.recipe()), document->volume()) == values_of(level_set));
  }

  // A wall that stays, and one beside it, need no other start.
  void a_restart_replays_where_walls_of_the_start_are_gone_data() {
    QTest::addColumn<bool>("before_the_start");
    QTest::addColumn<bool>("by_speed");
    QTest::newRow("walls before the start") << true << false;
    QTest::newRow("walls after the start") << false << false;
    QTest::newRow("walls before a start by the speed") << true << true;
    QTest::newRow("walls after a start by the speed") << false << true;
  }
  void a_restart_replays_where_walls_of_the_start_are_gone() {
    QFETCH(const bool, before_the_start);
    QFETCH(const bool, by_speed);
    const auto volume = lumpy_volume();
    document::Start start = seed_in(*volume);
    if (by_speed) {
      start = {};
      start.from = document::SpeedStart{};
    }
    const auto document = make_case(volume);
    document::LevelSet& level_set = document->level_set();
    const auto walled = with_ball({}, *volume, {4, 0, 0}, solver::Constraint::wall);
    if (before_the_start) drive(level_set, walled);
    QCOMPARE(failure(level_set.begin(start)), QString());
    if (!before_the_start) drive(level_set, walled);
    // Painted against a wall that is gone later on.
    QCOMPARE(failure(level_set.paint(ball_at(*volume, {6, 0, 0}, 4.0), solver::Brush::add)), QString());
    const std::vector<float> cut = values_of(level_set);
    run(level_set, 20);
    const auto wider = with_ball(walled, *volume, {-7, 0, 0}, solver::Constraint::wall);
    drive(level_set, wider);
    const auto as_it_was = level_set.start();
    QCOMPARE(failure(level_set.restart()), QString());
    QVERIFY(level_set.start() == as_it_was);
    run(level_set, 10);
    QVERIFY(replayed(again(level_set.recipe()), volume) == values_of(level_set));
    drive(level_set, {});
    const Seen before(level_set);
    QCOMPARE(failure(level_set.restart()), QString());
    // A start by the speed keeps the walls that it was computed with.
    QCOMPARE(values_of(level_set) == cut, by_speed && before_the_start);
    run(level_set, 30);
    QVERIFY(replayed(again(level_set.recipe()), volume) == values_of(level_set));
    QCOMPARE(failure(document->undo()), QString());
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(Seen(level_set) == before);
  }

  void undo_and_redo_bring_the_function_back() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 10);
    const Seen before(level_set);
    drive(level_set, learning(*document->volume()));
    run(level_set, 15);
    const Seen after(level_set);
    QVERIFY(after.phi != before.phi);
    while (document->history().undo_description() && level_set.step() > 10) {
      QCOMPARE(failure(document->undo()), QString());
    }
    while (undo_text(*document) == "examples" || undo_text(*document) == "speed function") {
      QCOMPARE(failure(document->undo()), QString());
    }
    QVERIFY(!level_set.executor().speed());
    QVERIFY(level_set.drive().setting.is_tent());
    QVERIFY(Seen(level_set).phi == before.phi);
    while (document->history().redo_description()) QCOMPARE(failure(document->redo()), QString());
    // Nobody waits for it before a step is to be computed.
    QVERIFY(level_set.lacks_speed());
    QVERIFY(!level_set.executor().speed());
    QVERIFY(Seen(level_set).phi == after.phi);
    run(level_set, 5);
    QVERIFY(level_set.executor().speed());
    QVERIFY(replayed(again(level_set.recipe()), document->volume()) == values_of(level_set));
  }

  void a_source_that_was_smoothed_elsewhere_replays() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    const auto volume = document->volume();
    drive(level_set, learning(*volume));
    run(level_set, 9);
    // Another function and another source arrive together.
    document::Drive wanted = level_set.drive();
    wanted.setting.terms.front().values["trees"] = 20.0;
    QCOMPARE(failure(level_set.set_drive(wanted)), QString());
    const auto source = document::smoothed_source(volume, 0.9);
    QCOMPARE(failure(source), QString());
    const auto speed = document::make_speed(wanted, *source, level_set.parameters());
    QCOMPARE(failure(speed), QString());
    QCOMPARE(failure(level_set.set_source(*source, 0.9, *speed)), QString());
    QCOMPARE(level_set.executor().speed(), *speed);
    QCOMPARE(level_set.smoothed_mm(), 0.9);
    run(level_set, 14);
    QVERIFY(replayed(again(level_set.recipe()), volume) == values_of(level_set));
    QCOMPARE(failure(document->undo()), QString());
    QCOMPARE(failure(document->undo()), QString());
    QCOMPARE(level_set.smoothed_mm(), 0.0);
    run(level_set, 3);
    QVERIFY(replayed(again(level_set.recipe()), volume) == values_of(level_set));
  }

  void only_recipes_with_something_new_are_of_the_new_version() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 4);
    Json json = Json::parse(level_set.recipe().to_text().value());
    QCOMPARE(json["version"].get<int>(), 1);
    QVERIFY(!json.contains("drive"));
    drive(level_set, with_ball({}, *document->volume(), {6, 0, 0}, solver::Constraint::wall));
    json = Json::parse(level_set.recipe().to_text().value());
    QCOMPARE(json["version"].get<int>(), 2);
  }

  void a_map_that_no_function_uses_is_not_asked_for() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    document::Drive wanted = learning(*document->volume());
    wanted.setting.terms = {{"edges", {}}};
    wanted.map = std::make_shared<const document::SpeedMap>(
        document::SpeedMap{"map.nrrd", std::string(64, 'b'), nullptr, {}});
    drive(level_set, wanted);
    run(level_set, 20);
    // What waits for another function is no part of the recipe.
    QVERIFY(level_set.drive() == wanted);
    QVERIFY(level_set.recipe().final_drive());
    QVERIFY(!level_set.recipe().final_drive()->map);
    QVERIFY(!level_set.recipe().final_drive()->strokes);
    const std::vector<float> values = values_of(level_set);
    QVERIFY(replayed(again(level_set.recipe()), document->volume()) == values);
    run(level_set, 5);
    QCOMPARE(failure(level_set.step_back(5)), QString());
    QVERIFY(values_of(level_set) == values);
    QVERIFY(level_set.drive() == wanted);
  }

  void everything_comes_back() {
    const auto recipe = document::Recipe::parse(good_json().dump(), "r.json");
    QCOMPARE(failure(recipe), QString());
    QVERIFY(recipe->drive);
    const document::Drive& read = *recipe->drive;
    const document::Drive expected = learning(*lumpy_volume());
    QVERIFY(*read.strokes == *expected.strokes);
    QCOMPARE(read.setting.terms.size(), std::size_t{2});
    QCOMPARE(read.setting.terms[1].values.at("sigma"), 1.5);
    QVERIFY(read.setting.combine == solver::Combine::product);
    QVERIFY(read.constraints->count(solver::Constraint::wall) > 50);
    QVERIFY(read.constraints->count(solver::Constraint::anchor) > 50);
    QCOMPARE(read.images.front()->name, std::string("PET"));
    QCOMPARE(read.images.front()->to_case[3].z, 30.0);
    QCOMPARE(read.map->checksum, std::string(64, 'b'));
    QCOMPARE(Json::parse(recipe->to_text().value()).dump(), good_json().dump());
  }

  void an_image_that_is_missing_is_named() {
    const auto recipe = document::Recipe::parse(good_json().dump(), "r.json");
    QCOMPARE(failure(recipe), QString());
    const auto result = document::evolve(*recipe, lumpy_volume(), {});
    QVERIFY(!result);
    QCOMPARE(result.error().kind, ErrorKind::usage);
    QVERIFY2(
        failure(result).contains("\"map.nrrd\" is missing") || failure(result).contains("\"PET\" is missing"),
        qPrintable(failure(result)));
  }

  void a_bad_drive_is_refused_with_its_field_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("says");
    const auto row = [](const char* name, const std::function<void(Json&)>& spoil, const char* says) {
      Json json = good_json();
      spoil(json);
      QTest::newRow(name) << QByteArray::fromStdString(json.dump()) << QString(says);
    };
    row(
        "unknown function", [](Json& j) { j["drive"]["speed"][0]["function"] = "witchcraft"; },
        "drive.speed[0].function: ");
    row(
        "no function", [](Json& j) { j["drive"]["speed"] = Json::array(); },
        "drive.speed: no speed function");
    row(
        "unknown number", [](Json& j) { j["drive"]["speed"][1]["values"]["wish"] = 1; },
        "drive.speed[1].values");
    row(
        "number out of range", [](Json& j) { j["drive"]["speed"][1]["values"]["sigma"] = 1e9; },
        "drive.speed[1].values.sigma: ");
    row(
        "combine", [](Json& j) { j["drive"]["combine"] = "sum"; }, "drive.combine: ");
    row(
        "strokes cut", [](Json& j) { j["drive"]["strokes"]["inside"]["offsets"] = "eJw="; },
        "drive.strokes.inside.offsets: ");
    row(
        "as many strokes as there is no memory for",
        [](Json& j) { j["drive"]["strokes"]["inside"]["count"] = std::int64_t{1} << 60; },
        "drive.strokes.inside.count: ");
    row(
        "inside and outside",
        [](Json& j) { j["drive"]["strokes"]["outside"] = j["drive"]["strokes"]["inside"]; },
        "drive.strokes: a voxel is both");
    row(
        "walls of an endless volume",
        [](Json& j) {
          j["source"]["size"] = {1 << 20, 1 << 20, 1 << 20};
          j["drive"].erase("strokes");
        },
        "drive: the volume has more voxels");
    row(
        "transform of fifteen", [](Json& j) { j["drive"]["images"][0]["to_case"].erase(0); },
        "drive.images[0].to_case: ");
    row(
        "transform that shrinks", [](Json& j) { j["drive"]["images"][0]["to_case"][0] = 0.5; },
        "drive.images[0].to_case: is not a rotation and a shift");
    row(
        "transform that stretches one way and shrinks another",
        [](Json& j) {
          j["drive"]["images"][0]["to_case"][0] = 2.0;
          j["drive"]["images"][0]["to_case"][5] = 0.5;
        },
        "drive.images[0].to_case: is not a rotation and a shift");
    row(
        "transform that shears", [](Json& j) { j["drive"]["images"][0]["to_case"][1] = 0.1; },
        "drive.images[0].to_case: is not a rotation and a shift");
    row(
        "transform that mirrors", [](Json& j) { j["drive"]["images"][0]["to_case"][0] = -1.0; },
        "drive.images[0].to_case: is not a rotation and a shift");
    row(
        "map without a name", [](Json& j) { j["drive"]["map"].erase("name"); }, "drive.map.name: is missing");
  }
  void a_bad_drive_is_refused_with_its_field() {
    QFETCH(QByteArray, text);
    QFETCH(QString, says);
    const auto recipe = document::Recipe::parse(text.toStdString(), "bad.json");
    QVERIFY(!recipe);
    QCOMPARE(recipe.error().kind, ErrorKind::input);
    QVERIFY2(failure(recipe).startsWith("bad.json: " + says), qPrintable(failure(recipe)));
    QVERIFY(!failure(recipe).contains('\n'));
  }
};

TIDEMARK_TEST(DriveRecipeTest)

}  // namespace tidemark::test::drive_recipe_test

#include "drive_recipe_test.moc"
