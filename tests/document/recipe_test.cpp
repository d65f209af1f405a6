// Recipes: what is written can be read, what is read leads to the same voxels, and bad ones are refused.
#include <QFile>
#include <functional>
#include <nlohmann/json.hpp>

#include "document/evolution.h"
#include "document/session_contents.h"
#include "imaging/filters/filters.h"
#include "solver/speed/speed_registry.h"
#include "tests/document/recipes.h"
#include "tests/support/test_program.h"

namespace tidemark::test::recipe_test {

using Json = nlohmann::json;

namespace {

// Everything that can be in one.
std::unique_ptr<document::Case> eventful_case(solver::ExecutorKind kind) {
  auto document = begun_case(kind);
  document::LevelSet& level_set = document->level_set();
  const Volume& volume = *document->volume();
  const auto must = [](const Status& status) {
    if (!status) qFatal("%s", status.error().message.c_str());
  };
  solver::Parameters parameters = level_set.parameters();
  must(level_set.paint(ball_at(volume, {4, 0, 0}, 4.0), solver::Brush::add));
  run(level_set, 25);
  parameters.target += 37.25;
  must(level_set.set_parameters(parameters, 4));
  run(level_set, 3);
  parameters.alpha = 0.55;
  must(level_set.set_parameters(parameters, 4));
  must(level_set.paint(ball_at(volume, {0, 7, 0}, 4.0), solver::Brush::erase));
  run(level_set, 20);
  must(document->undo());
  must(document->undo());
  run(level_set, 20);
  must(document->smooth_source(0.9));
  run(level_set, 20);
  must(level_set.step_back(7));
  run(level_set, 19);
  return document;
}

// A good recipe as JSON, to be spoilt.
Json good_json() {
  static const Json json = [] {
    const auto document = begun_case();
    run(document->level_set(), 4);
    document::Start start = seed_in(*document->volume());
    Mask mask = document->level_set().executor().snapshot()->mask();
    start.from = document::MaskStart{std::make_shared<const BitMask>(mask), "before"};
    start.erasers = {ball_at(*document->volume(), {3, 3, 3}, 1.0)};
    if (!document->level_set().begin(start)) qFatal("a start that should work");
    run(document->level_set(), 6);
    const solver::Sphere sphere = ball_at(*document->volume(), {3, 0, 3}, 2.0);
    if (!document->level_set().paint(sphere, solver::Brush::add)) qFatal("paint that should work");
    return Json::parse(document->level_set().recipe().to_text().value());
  }();
  return json;
}

}  // namespace

class RecipeTest : public QObject {
  Q_OBJECT

 private slots:
  void a_replay_gives_the_same_bits_data() { add_executors(); }
  void a_replay_gives_the_same_bits() {
    const auto document = eventful_case(this_executor());
    const document::Recipe written = document::snapshot_of(*document)->recipe;
    const document::Recipe recipe = again(written);
    QVERIFY(recipe.events == written.events);
    QVERIFY(recipe.source == written.source);
    QVERIFY(recipe.executor == written.executor);
    QVERIFY(differences(recipe, *document->volume()).empty());
    QVERIFY(replayed(recipe, document->volume()) == values_of(document->level_set()));
  }

  void putting_phi_back_is_part_of_what_happened() {
    const auto document = make_case(lumpy_volume({61, 50, 47}, glm::dvec3(1.0)));
    document::LevelSet& level_set = document->level_set();
    QCOMPARE(failure(level_set.begin(seed_in(*document->volume()))), QString());
    for (int i = 0; i < 100 && level_set.executor().memory().quiet_pages == 0; ++i) run(level_set, 40);
    QVERIFY(level_set.executor().memory().quiet_pages > 0);
    QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {4, 0, 0}, 4.0), solver::Brush::erase)),
             QString());
    QCOMPARE(failure(document->undo()), QString());
    run(level_set, 100);
    document::Recipe recipe = again(level_set.recipe());
    QVERIFY(replayed(recipe, document->volume()) == values_of(level_set));
    QCOMPARE(recipe.events.size(), std::size_t{1});
    recipe.events.clear();
    QVERIFY(replayed(recipe, document->volume()) != values_of(level_set));
  }

  // What was undone is not replayed, and the means of regions must not remember it.
  void regions_replay_to_the_same_bits_after_undo() {
    for (const double radius : {0.0, 4.0}) {
      const auto document = make_case(lumpy_volume());
      document::LevelSet& level_set = document->level_set();
      QCOMPARE(failure(level_set.begin(seed_in(*document->volume()))), QString());
      document::Drive drive;
      drive.setting.terms = {{"regions", {{"radius", radius}}}};
      QCOMPARE(failure(level_set.set_drive(drive)), QString());
      const auto speed = solver::make_speed(drive.setting, {document->volume(), {}, {}, nullptr, nullptr});
      QCOMPARE(failure(speed), QString());
      QCOMPARE(failure(level_set.set_speed(*speed)), QString());
      run(level_set, 40);
      QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {4, 0, 0}, 1.5), solver::Brush::add)),
               QString());
      run(level_set, 33);
      QCOMPARE(failure(document->undo()), QString());
      QCOMPARE(failure(document->undo()), QString());
      run(level_set, 50);
      const document::Recipe recipe = again(level_set.recipe());
      QVERIFY(recipe.has_drive());
      QVERIFY(replayed(recipe, document->volume()) == values_of(level_set));
    }
  }

  void any_start_comes_back_data() {
    QTest::addColumn<int>("start");
    const char* const names[] = {"seeds", "threshold", "flood", "mask", "phi", "painted only", "speed"};
    for (int i = 0; i < 7; ++i) QTest::newRow(names[i]) << i;
  }
  void any_start_comes_back() {
    QFETCH(int, start);
    const auto document = make_case(lumpy_volume());
    document::LevelSet& level_set = document->level_set();
    const Volume& volume = *document->volume();
    document::Start wanted;
    Mask mask = imaging::threshold(volume, 900.0, 1e4);
    if (start == 0) wanted.seeds = {ball_at(volume, {0, 0, 0}, 6.0), ball_at(volume, {6, 0, 0}, 3.0)};
    if (start == 0) wanted.erasers = {ball_at(volume, {0, 5, 0}, 2.0)};
    if (start == 1) wanted.from = document::ThresholdStart{910.5, 1200.0};
    if (start == 2) wanted.from = document::FloodStart{volume.geometry.size / std::int64_t{2}, 850.0, 2000.0};
    if (start == 3) wanted.from = document::MaskStart{std::make_shared<const BitMask>(mask), "mask.nii"};
    if (start == 4) {
      const auto other = begun_case(solver::ExecutorKind::stream);  // with other pages
      run(other->level_set(), 5);
      wanted.from = document::FieldStart{other->level_set().checkpoint().value(), "phi.nrrd"};
    }
    if (start == 6) wanted.from = document::SpeedStart{};
    if (start == 5) {
      QCOMPARE(failure(level_set.paint(ball_at(volume, {0, 0, 0}, 6.0), solver::Brush::add)), QString());
    } else {
      QCOMPARE(failure(level_set.begin(wanted)), QString());
    }
    run(level_set, 10);
    const document::Recipe recipe = again(level_set.recipe());
    QCOMPARE(recipe.start.describe(), level_set.recipe().start.describe());
    QVERIFY(replayed(recipe, document->volume()) == values_of(level_set));
  }

  // The surface began where the speed of that time was above 0, whatever drives it later.
  void a_start_by_speed_keeps_the_speed_that_it_was_made_with() {
    const auto document = make_case(lumpy_volume());
    document::LevelSet& level_set = document->level_set();
    document::Start start;
    start.from = document::SpeedStart{};
    QCOMPARE(failure(level_set.begin(start)), QString());
    const auto begun = values_of(level_set);
    const auto shift_target = [&](double by) {
      solver::Parameters parameters = level_set.parameters();
      parameters.target += by;
      QCOMPARE(failure(level_set.set_parameters(parameters)), QString());
    };
    const auto replays = [&] {
      return replayed(again(level_set.recipe()), document->volume()) == values_of(level_set);
    };
    shift_target(20.0);
    QVERIFY(replays());
    run(level_set, 6);
    QVERIFY(replays());
    shift_target(-60.0);
    run(level_set, 4);
    QCOMPARE(failure(level_set.restart()), QString());
    QVERIFY(values_of(level_set) == begun);
    QVERIFY(replays());
    run(level_set, 6);
    QVERIFY(replays());
  }

  void every_parameter_comes_back() {
    document::Recipe recipe = begun_case()->level_set().recipe();
    solver::Parameters& parameters = recipe.parameters;
    parameters.band = std::numeric_limits<double>::infinity();
    parameters.rescale = 0.1 + 0.2;
    parameters.target_gradient = 0.97;
    parameters.scheme = solver::Scheme::paper;
    parameters.data_form = solver::DataForm::raw;
    parameters.data_term = parameters.curvature_term = parameters.rescaling_term = false;
    parameters.time_step_factor = 0.5;
    QVERIFY(again(recipe).parameters == parameters);
    parameters.band = 3.7;
    parameters.rescale.reset();
    QVERIFY(again(recipe).parameters == parameters);
  }

  void another_volume_is_noticed() {
    const document::Recipe recipe = document::snapshot_of(*begun_case())->recipe;
    Volume other = *lumpy_volume();
    QVERIFY(differences(recipe, other).empty());
    std::get<std::vector<std::int16_t>>(other.voxels)[1000] += 1;
    QCOMPARE(differences(recipe, other).size(), std::size_t{1});
    QVERIFY(differences(recipe, other)[0].find("other voxels") != std::string::npos);
    const std::vector<std::string> found = differences(recipe, *lumpy_volume({30, 30, 30}, {1, 1, 1.5}));
    QCOMPARE(found.size(), std::size_t{2});
    QVERIFY(found[0].find("spacing") != std::string::npos);
  }

  void a_mask_of_another_grid_is_refused() {
    const document::Recipe recipe = document::Recipe::parse(good_json().dump(), "r.json").value();
    const auto result = document::evolve(recipe, lumpy_volume({20, 20, 20}), {});
    QVERIFY(!result);
    QCOMPARE(result.error().kind, ErrorKind::usage);
  }

  void a_bad_recipe_is_refused_with_its_field_data() {
    QTest::addColumn<QByteArray>("text");
    QTest::addColumn<QString>("says");
    const auto text_row = [](const char* name, const std::string& text, const char* says) {
      QTest::newRow(name) << QByteArray::fromStdString(text) << QString(says);
    };
    const auto row = [&](const char* name, const std::function<void(Json&)>& spoil, const char* says) {
      Json json = good_json();
      spoil(json);
      text_row(name, json.dump(), says);
    };
    const std::string good = good_json().dump();
    text_row("empty", "", "not JSON");
    text_row("truncated", good.substr(0, good.size() / 2), "not JSON");
    text_row("garbage after", good + "x", "not JSON");
    text_row("NaN", "{\"steps\": NaN}", "not JSON");
    text_row("a list", "[]", "not an object");
    text_row("deep", std::string(40, '[') + std::string(40, ']'), "nested more than 32 deep");
    text_row("very deep", std::string(2'000'000, '['), "deep");
    text_row("other bytes", std::string("\xff\xfe\x00{", 4), "not JSON");
    row(
        "format", [](Json& j) { j["format"] = "recipe"; }, "format: ");
    row(
        "version 5", [](Json& j) { j["version"] = 5; }, "version: this version");
    row(
        "version text", [](Json& j) { j["version"] = "1"; }, "version: not a whole number");
    row(
        "no version", [](Json& j) { j.erase("version"); }, "version: is missing");
    row(
        "no start", [](Json& j) { j.erase("start"); }, "start: is missing");
    row(
        "null parameters", [](Json& j) { j["parameters"] = nullptr; }, "parameters: not an object");
    row(
        "alpha 2", [](Json& j) { j["parameters"]["alpha"] = 2; }, "parameters: ");
    row(
        "range 0", [](Json& j) { j["parameters"]["range"] = 0; }, "parameters: ");
    row(
        "target text", [](Json& j) { j["parameters"]["target"] = "1"; }, "parameters.target: not a number");
    row(
        "scheme", [](Json& j) { j["parameters"]["scheme"] = "x"; }, "parameters.scheme: 'x' is unknown");
    row(
        "band word", [](Json& j) { j["parameters"]["band"] = "wide"; }, "parameters.band: 'wide'");
    row(
        "flag 1", [](Json& j) { j["parameters"]["data_term"] = 1; }, "parameters.data_term: neither");
    row(
        "steps -1", [](Json& j) { j["steps"] = -1; }, "steps: -1 is not within");
    row(
        "steps 1.5", [](Json& j) { j["steps"] = 1.5; }, "steps: not a whole number");
    row(
        "steps huge", [](Json& j) { j["steps"] = 18446744073709551615U; }, "steps: 18446744073709551615");
    row(
        "size 0", [](Json& j) { j["source"]["size"][1] = 0; }, "source.size[1]: 0 is not within");
    row(
        "size of two", [](Json& j) { j["source"]["size"].erase(0); }, "source.size: not three");
    row(
        "spacing 0", [](Json& j) { j["source"]["spacing_mm"][0] = 0; }, "source.spacing_mm[0]: ");
    row(
        "executor", [](Json& j) { j["executor"]["name"] = "cuda"; }, "executor.name: 'cuda' is unknown");
    row(
        "page shape",
        [](Json& j) {
          j["executor"]["page_shape"] = {1, 2, 3};
        },
        "executor.page_shape: no pages");
    row(
        "smoothed -1", [](Json& j) { j["smoothed_mm"] = -1; }, "smoothed_mm: -1");
    row(
        "start kind", [](Json& j) { j["start"]["from"]["kind"] = "dream"; }, "start.from.kind: 'dream'");
    row(
        "threshold upside down",
        [](Json& j) {
          j["start"]["from"] = {{"kind", "threshold"}, {"low", 5}, {"high", 4}};
        },
        "start.from.high: 4 is not within");
    row(
        "flood voxel",
        [](Json& j) {
          j["start"]["from"] = {{"kind", "flood"}, {"voxel", {1, 2, -3}}, {"low", 5}, {"high", 6}};
        },
        "start.from.voxel[2]: -3");
    row(
        "seed radius 0", [](Json& j) { j["start"]["seeds"][0]["radius_mm"] = 0; },
        "start.seeds[0].radius_mm: ");
    row(
        "seed far away", [](Json& j) { j["start"]["seeds"][0]["centre_mm"][1] = 1e30; },
        "start.seeds[0].centre_mm[1]: ");
    row(
        "erasers object", [](Json& j) { j["start"]["erasers"] = Json::object(); },
        "start.erasers: not a list");
    row(
        "mask bits cut", [](Json& j) { j["start"]["from"]["bits"] = "eJw="; },
        "start.from.bits: does not hold");
    row(
        "mask bits text", [](Json& j) { j["start"]["from"]["bits"] = "?*%!"; },
        "start.from.bits: does not hold");
    row(
        "mask bomb",
        [](Json& j) {
          j["start"]["from"]["grid"]["size"] = {1000, 1000, 1000};
        },
        "start.from.bits: does not hold");
    row(
        "mask overflow",
        [](Json& j) {
          j["start"]["from"]["grid"]["size"] = {1 << 20, 1 << 20, 1 << 20};
        },
        "start.from.grid.size: more voxels");
    row(
        "mask axes",
        [](Json& j) {
          j["start"]["from"]["grid"]["direction"][0] = {0, 1, 0};
        },
        "start.from.grid.direction: ");
    row(
        "event before the one before",
        [](Json& j) {
          j["events"].push_back({{"step", 2}, {"resume", true}});
        },
        "events[1].step: 2 is not");
    row(
        "event after the end", [](Json& j) { j["events"][0]["step"] = 7; }, "events[0].step: 7 is not");
    row(
        "event kind",
        [](Json& j) {
          j["events"][0] = {{"step", 6}, {"wish", 1}};
        },
        "events[0]: an event of");
    row(
        "event parameters",
        [](Json& j) {
          j["events"][0] = {{"step", 6}, {"parameters", 1}};
        },
        "events[0].parameters: not an object");
    row(
        "event smoothing",
        [](Json& j) {
          j["events"][0] = {{"step", 6}, {"smoothed_mm", -2}};
        },
        "events[0].smoothed_mm: -2");
    row(
        "events text", [](Json& j) { j["events"] = "none"; }, "events: not a list");
  }
  void a_bad_recipe_is_refused_with_its_field() {
    QFETCH(QByteArray, text);
    QFETCH(QString, says);
    QVERIFY(document::Recipe::parse(good_json().dump(), "bad.json"));
    const auto recipe = document::Recipe::parse(text.toStdString(), "bad.json");
    QVERIFY(!recipe);
    QCOMPARE(recipe.error().kind, ErrorKind::input);
    const QString message = QString::fromStdString(recipe.error().message);
    QVERIFY2(message.startsWith("bad.json: ") && message.contains(says) && !message.contains('\n'),
             qPrintable(message));
  }

  void a_file_that_is_too_large_is_not_read() {
    const TemporaryFolder folder;
    const auto file = folder / "large.json";
    {
      QFile sparse(QString::fromStdString(file.string()));
      QVERIFY(sparse.open(QIODevice::WriteOnly));
      QVERIFY(sparse.resize(qint64{1} << 32));
    }
    const auto recipe = document::Recipe::load(file);
    QVERIFY(!recipe);
    QVERIFY(recipe.error().message.find("4294967296 bytes") != std::string::npos);
    QCOMPARE(document::Recipe::load(folder / "none.json").error().kind, ErrorKind::input);
  }
};

TIDEMARK_TEST(RecipeTest)

}  // namespace tidemark::test::recipe_test

#include "recipe_test.moc"
