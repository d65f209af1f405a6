// Coarse to fine: the same surface sooner, and a recipe, a history and a restart that lead to the same bits.
#include "document/coarse_levels.h"

#include "document/sweep.h"
#include "recipes.h"
#include "solver/coarse_grid.h"
#include "tests/support/test_program.h"

namespace tidemark::test::coarse_levels_test {

namespace {

document::Start in_levels(const Volume& volume, int levels) {
  document::Start start = seed_in(volume);
  start.levels = levels;
  return start;
}

std::unique_ptr<document::Case> case_in_levels(int levels,
                                               solver::ExecutorKind kind = solver::ExecutorKind::host) {
  auto made = make_case(lumpy_volume({61, 58, 49}), kind);
  if (const Status begun = made->level_set().begin(in_levels(*made->volume(), levels)); !begun) {
    qFatal("%s", begun.error().message.c_str());
  }
  return made;
}

document::Recipe recipe_in_levels(const Volume& volume, int levels) {
  document::Recipe recipe;
  recipe.source = {volume.geometry.size, volume.geometry.spacing_mm, {}, {}, {}};
  recipe.start = in_levels(volume, levels);
  recipe.executor.name = "host";
  recipe.parameters = lumpy_parameters();
  recipe.steps = 5000;
  return recipe;
}

document::Evolution at_rest(const document::Recipe& recipe, const std::shared_ptr<const Volume>& volume,
                            solver::ExecutorKind kind) {
  return evolved(recipe, volume, {kind, {}, true});
}

}  // namespace

class CoarseLevelsTest : public QObject {
  Q_OBJECT

 private slots:
  void the_surface_is_that_of_the_finest_level_alone_data() { add_executors(); }
  void the_surface_is_that_of_the_finest_level_alone() {
    const auto volume = lumpy_volume({61, 58, 49});
    const auto alone = at_rest(recipe_in_levels(*volume, 1), volume, this_executor());
    QVERIFY(alone.advance.converged);
    QVERIFY(alone.coarse_runs.empty());
    for (const int levels : {2, 3}) {
      const auto fine = at_rest(recipe_in_levels(*volume, levels), volume, this_executor());
      QVERIFY(fine.advance.converged);
      QCOMPARE(std::ssize(fine.coarse_runs), levels - 1);
      const double same = dice(fine.phi.mask(), alone.phi.mask());
      QVERIFY2(same > 0.995, qPrintable(QString::number(same)));
      // The finest level has less to do.
      QVERIFY(fine.advance.steps < alone.advance.steps);
      const document::CoarseRun& coarsest = fine.coarse_runs.front();
      QCOMPARE(coarsest.size, solver::CoarseGrid(volume->geometry, levels - 1).coarse().size);
      QVERIFY(coarsest.advance.converged);
    }
  }

  void every_start_has_levels() {
    const auto volume = lumpy_volume({61, 58, 49});
    document::Recipe recipe = recipe_in_levels(*volume, 1);
    const auto mask =
        std::make_shared<const BitMask>(at_rest(recipe, volume, solver::ExecutorKind::host).phi.mask());
    std::vector<document::Start> starts(3);
    starts[0].from = document::ThresholdStart{700.0, 2000.0};
    starts[1].from = document::FloodStart{{30, 28, 24}, 700.0, 2000.0};
    starts[2].from = document::MaskStart{mask, "mask"};
    for (document::Start& start : starts) {
      start.erasers = {ball_at(*volume, {0, 0, 8}, 4.0)};
      recipe.start = start;
      const auto alone = at_rest(recipe, volume, solver::ExecutorKind::host);
      recipe.start.levels = 2;
      const auto fine = at_rest(recipe, volume, solver::ExecutorKind::host);
      QCOMPARE(std::ssize(fine.coarse_runs), std::ptrdiff_t{1});
      const double same = dice(fine.phi.mask(), alone.phi.mask());
      QVERIFY2(same > 0.995, qPrintable(QString::fromStdString(start.describe()) + QString::number(same)));
    }
  }

  void its_recipe_leads_to_the_same_bits_data() { add_executors(); }
  void its_recipe_leads_to_the_same_bits() {
    const auto document = case_in_levels(2, this_executor());
    document::LevelSet& level_set = document->level_set();
    run(level_set, 12);
    const document::Recipe recipe = again(level_set.recipe());
    QCOMPARE(recipe.start.levels, 2);
    QVERIFY(replayed(recipe, document->volume()) == values_of(level_set));
  }

  // The start stays as it was computed, with the parameters of then; what follows has the new ones.
  void a_restart_with_other_parameters_is_replayed_too() {
    const auto document = case_in_levels(3);
    document::LevelSet& level_set = document->level_set();
    const std::vector<float> start = values_of(level_set);
    run(level_set, 12);
    QCOMPARE(failure(level_set.set_parameters(with_target(level_set.parameters(), 800.0))), QString());
    document::Drive drive = level_set.drive();
    auto walls = std::make_shared<solver::Constraints>(document->volume()->geometry.size);
    walls->set(document->volume()->geometry, ball_at(*document->volume(), {9, 0, 0}, 3.0),
               solver::Constraint::wall);
    drive.constraints = walls;
    QCOMPARE(failure(level_set.set_drive(drive)), QString());
    run(level_set, 5);
    QCOMPARE(failure(level_set.restart()), QString());
    QCOMPARE(level_set.step(), std::int64_t{0});
    QCOMPARE(level_set.parameters().target, 800.0);
    run(level_set, 15);
    const Seen seen(level_set);
    QVERIFY(replayed(again(level_set.recipe()), document->volume()) == seen.phi);
    // So is a step back, which computes again from there.
    QCOMPARE(failure(level_set.step_back(7)), QString());
    QVERIFY(replayed(again(level_set.recipe()), document->volume()) == values_of(level_set));
    for (int change = 0; change < 6 && level_set.step() != 0; ++change) {
      QCOMPARE(failure(document->undo()), QString());
    }
    QCOMPARE(failure(document->redo()), QString());
    QVERIFY(start.size() == seen.phi.size());
  }

  void a_run_of_a_sweep_is_replayed_too() {
    const auto document = case_in_levels(2);
    document::LevelSet& level_set = document->level_set();
    const auto start = level_set.sweep_start();
    QCOMPARE(failure(start), QString());
    document::SweepOptions options;
    options.axes = {{"alpha", 0.5, 0.9, 2}};
    options.threads = 1;
    options.steps = 40;
    const auto sweep = document::run_sweep(*start, options);
    QCOMPARE(failure(sweep), QString());
    QCOMPARE(failure(level_set.take_run(*start, sweep->at(1, 0))), QString());
    QVERIFY(level_set.parameters() == sweep->at(1, 0).parameters);
    QVERIFY(replayed(again(level_set.recipe()), document->volume()) == values_of(level_set));
  }

  void another_band_computes_the_levels_again() {
    const auto document = case_in_levels(2);
    document::LevelSet& level_set = document->level_set();
    run(level_set, 8);
    solver::Parameters wide = level_set.parameters();
    wide.band = 4.0;
    QCOMPARE(failure(level_set.set_parameters(wide)), QString());
    run(level_set, 8);
    QVERIFY(replayed(again(level_set.recipe()), document->volume()) == values_of(level_set));
  }

  void walls_hold_on_every_level() {
    const auto volume = lumpy_volume({61, 58, 49});
    document::Recipe recipe = recipe_in_levels(*volume, 3);
    document::Drive drive;
    auto walls = std::make_shared<solver::Constraints>(volume->geometry.size);
    std::vector<Index3> plane;
    for (std::int64_t k = 0; k < 49; ++k) {
      for (std::int64_t j = 0; j < 58; ++j) plane.push_back({37, j, k});
    }
    walls->set(plane, solver::Constraint::wall);
    drive.constraints = walls;
    recipe.drive = std::make_shared<const document::Drive>(drive);
    const Mask inside = at_rest(recipe, volume, solver::ExecutorKind::host).phi.mask();
    QVERIFY(inside.count() > 1000);
    for (std::int64_t offset = 0; offset < inside.geometry.voxel_count(); ++offset) {
      if (inside.voxels[static_cast<std::size_t>(offset)] == 0) continue;
      QVERIFY(inside.geometry.voxel_at(offset).x < 37);
    }
  }

  // Half of the resolution has no voxel for it.
  void what_is_too_small_begins_on_the_finest_level() {
    const auto volume = lumpy_volume({61, 58, 49});
    auto mask = std::make_shared<BitMask>(volume->geometry);
    mask->add(volume->geometry.offset({30, 28, 24}));
    document::Recipe recipe = recipe_in_levels(*volume, 2);
    recipe.start.seeds.clear();
    recipe.start.from = document::MaskStart{mask, "one voxel"};
    recipe.steps = 0;
    const auto fine = at_rest(recipe, volume, solver::ExecutorKind::host);
    QVERIFY(fine.coarse_runs.empty());
    QCOMPARE(fine.phi.mask().count(), std::int64_t{1});
  }

  // A block that is barely inside: none of its voxels is, once phi lies between blocks.
  void what_the_finer_grid_would_lose_begins_on_the_finest_level() {
    auto volume = std::make_shared<Volume>();
    volume->geometry.size = {24, 24, 24};
    std::vector<std::int16_t> voxels(static_cast<std::size_t>(volume->geometry.voxel_count()));
    for (std::int64_t i = 0; i < 8; ++i) {
      const Index3 voxel = Index3(10, 12, 8) + Index3(i & 1, i >> 1 & 1, i >> 2);
      voxels[static_cast<std::size_t>(volume->geometry.offset(voxel))] = 850;
    }
    volume->voxels = std::move(voxels);
    document::Recipe recipe = recipe_in_levels(*volume, 2);
    recipe.start.seeds.clear();
    recipe.start.from = document::ThresholdStart{800.0, 900.0};
    recipe.parameters.alpha = 1.0;
    recipe.steps = 0;
    const auto fine = at_rest(recipe, volume, solver::ExecutorKind::host);
    QVERIFY(fine.coarse_runs.empty());
    QCOMPARE(fine.phi.mask().count(), std::int64_t{8});
  }

  void a_cancelled_one_leaves_the_case_as_it_was() {
    const auto document = case_in_levels(1);
    document::LevelSet& level_set = document->level_set();
    run(level_set, 9);
    QCOMPARE(failure(level_set.end_run()), QString());
    const Seen before(level_set);
    std::stop_source stop;
    stop.request_stop();
    const Status begun =
        level_set.begin(in_levels(*document->volume(), 3), Progress{nullptr, stop.get_token()});
    QCOMPARE(begun.error().kind, ErrorKind::cancelled);
    QVERIFY(Seen(level_set) == before);
    run(level_set, 3);
  }

  void a_saved_level_set_has_no_levels() {
    const auto document = case_in_levels(1);
    document::Start start;
    start.from = document::FieldStart{
        std::make_shared<const solver::Field>(document->level_set().executor().snapshot().value()),
        "phi.nrrd"};
    start.levels = 2;
    const Status begun = document->level_set().begin(start);
    QVERIFY(!begun);
    QCOMPARE(begun.error().kind, ErrorKind::usage);
  }

  // Its D is not within [-1, 1], as the mean of a block has to be on a GPU.
  void the_raw_tent_has_no_levels_data() { add_executors(); }
  void the_raw_tent_has_no_levels() {
    const QString reason = "the raw form of the tent has no coarser levels";
    const auto document = case_in_levels(1, this_executor());
    document::LevelSet& level_set = document->level_set();
    solver::Parameters raw = level_set.parameters();
    raw.data_form = solver::DataForm::raw;
    QCOMPARE(failure(level_set.set_parameters(raw)), QString());
    const Seen before(level_set);
    const document::Start start = in_levels(*document->volume(), 2);
    const Status begun = level_set.begin(start);
    QCOMPARE(failure(begun), reason);
    QCOMPARE(begun.error().kind, ErrorKind::usage);
    QVERIFY(Seen(level_set) == before);
    run(level_set, 3);
    document::Recipe recipe = recipe_in_levels(*document->volume(), 2);
    recipe.parameters.data_form = solver::DataForm::raw;
    QCOMPARE(failure(document::evolve(recipe, document->volume(), {this_executor(), {}, true})), reason);
    // Another function has them, whatever the form of the tent is.
    document::Drive drive = level_set.drive();
    drive.setting.terms = {{"edges", {}}};
    recipe.drive = std::make_shared<const document::Drive>(drive);
    QCOMPARE(failure(document::evolve(recipe, document->volume(), {this_executor(), {}, true})), QString());
  }

  // Programs that know no levels refuse it; a recipe without them is still read by those.
  void a_recipe_has_the_first_version_that_can_read_it() {
    const auto volume = lumpy_volume();
    document::Recipe recipe = recipe_in_levels(*volume, 1);
    QVERIFY(recipe.to_text().value().find("\"version\": 1") != std::string::npos);
    QVERIFY(recipe.to_text().value().find("levels") == std::string::npos);
    recipe.start.levels = 3;
    std::string text = recipe.to_text().value();
    QVERIFY(text.find("\"version\": 3") != std::string::npos);
    const std::string field = "\"levels\": 3";
    for (const char* wrong : {"\"levels\": 0", "\"levels\": 4", "\"levels\": 2.5", "\"levels\": \"auto\""}) {
      std::string hostile = text;
      hostile.replace(hostile.find(field), field.size(), wrong);
      const auto read = document::Recipe::parse(hostile, "hostile.json");
      QVERIFY(!read);
      QVERIFY2(read.error().message.find("hostile.json") != std::string::npos &&
                   read.error().message.find("levels") != std::string::npos,
               read.error().message.c_str());
    }
  }
};

TIDEMARK_TEST(CoarseLevelsTest)

}  // namespace tidemark::test::coarse_levels_test

#include "coarse_levels_test.moc"
