// Sweeps: axes in words, runs as bits, what they agree on, and what ends them.
#include "document/sweep.h"

#include <fmt/format.h>

#include <thread>

#include "document/sweep_picture.h"
#include "recipes.h"
#include "solver/inside_region.h"
#include "solver/speed/motion_limit.h"
#include "tests/support/test_program.h"

namespace tidemark::test::sweep_test {

namespace {

document::Recipe lumpy_recipe(const Volume& volume) {
  document::Recipe recipe;
  recipe.source = {volume.geometry.size, volume.geometry.spacing_mm, {}, {}, {}};
  recipe.start = seed_in(volume);
  recipe.parameters = lumpy_parameters();
  recipe.steps = 60;
  return recipe;
}

document::SweepOptions over(std::vector<document::SweepAxis> axes) {
  document::SweepOptions options;
  options.axes = std::move(axes);
  options.steps = 60;
  options.threads = 2;
  return options;
}

const document::SweepAxis kAlphas{"alpha", 0.5, 0.9, 3};
const document::SweepAxis kRanges{"range", 150.0, 250.0, 2};

document::Sweep swept(const document::Recipe& recipe, const std::shared_ptr<const Volume>& volume,
                      const document::SweepOptions& options) {
  const auto start = document::sweep_start(recipe, volume);
  if (!start) qFatal("%s", start.error().message.c_str());
  auto sweep = document::run_sweep(*start, options);
  if (!sweep) qFatal("%s", sweep.error().message.c_str());
  return std::move(*sweep);
}

// The run by itself, as segment computes it.
document::Evolution alone(document::Recipe recipe, const document::SweepRun& run,
                          const std::shared_ptr<const Volume>& volume, bool until_converged) {
  recipe.parameters = run.parameters;
  if (run.drive != nullptr) recipe.drive = run.drive;
  return evolved(recipe, volume, {solver::ExecutorKind::host, {}, until_converged});
}

}  // namespace

class SweepTest : public QObject {
  Q_OBJECT

 private slots:
  void an_axis_is_read_from_a_word() {
    const auto axis = document::parse_sweep_axis("alpha=0.2:0.9:6");
    QCOMPARE(failure(axis), QString());
    QVERIFY(*axis == (document::SweepAxis{"alpha", 0.2, 0.9, 6}));
    QCOMPARE(axis->value(0), 0.2);
    QCOMPARE(axis->value(2), 0.48);  // as it is printed, not 0.48000000000000004
    QCOMPARE(axis->value(5), 0.9);
    const auto negative = document::parse_sweep_axis("target=-100:40:8");
    QCOMPARE(failure(negative), QString());
    QCOMPARE(negative->value(7), 40.0);
    const auto with_plus = document::parse_sweep_axis("alpha=+0:+1:3");
    QCOMPARE(failure(with_plus), QString());
    QCOMPARE(with_plus->value(2), 1.0);
  }

  void a_bad_axis_is_refused_by_its_part_data() {
    QTest::addColumn<QString>("text");
    QTest::addColumn<QString>("message");
    QTest::newRow("no values") << "alpha"
                               << "NAME=FROM:TO:COUNT";
    QTest::newRow("no count") << "alpha=0.2:0.9"
                              << "NAME=FROM:TO:COUNT";
    QTest::newRow("no name") << "=0.2:0.9:6"
                             << "NAME=FROM:TO:COUNT";
    QTest::newRow("no number") << "alpha=x:0.9:6"
                               << "'x' is not a finite number";
    QTest::newRow("infinite") << "alpha=0:inf:6"
                              << "'inf' is not a finite number";
    QTest::newRow("one value") << "alpha=0.2:0.9:1"
                               << "'1' is not a whole number from 2 to 8";
    QTest::newRow("nine values") << "alpha=0.2:0.9:9"
                                 << "'9' is not a whole number from 2 to 8";
    QTest::newRow("half a value") << "alpha=0.2:0.9:2.5"
                                  << "'2.5' is not a whole number from 2 to 8";
    QTest::newRow("more") << "alpha=0.2:0.9:6:7"
                          << "'6:7' is not a whole number from 2 to 8";
  }
  void a_bad_axis_is_refused_by_its_part() {
    QFETCH(QString, text);
    QFETCH(QString, message);
    const auto axis = document::parse_sweep_axis(text.toStdString());
    QVERIFY(!axis);
    QCOMPARE(axis.error().kind, ErrorKind::usage);
    QVERIFY2(failure(axis).contains(message), qPrintable(failure(axis)));
  }

  void axes_that_the_level_set_does_not_take_are_refused_data() {
    QTest::addColumn<std::vector<document::SweepAxis>>("axes");
    QTest::addColumn<QString>("message");
    using Axes = std::vector<document::SweepAxis>;
    QTest::newRow("none") << Axes{} << "one or two parameters, not 0";
    QTest::newRow("three") << Axes{kAlphas, kRanges, kAlphas} << "one or two parameters, not 3";
    QTest::newRow("twice") << Axes{kAlphas, kAlphas} << "alpha: is both axes";
    QTest::newRow("unknown") << Axes{{"beta", 0.0, 1.0, 2}} << "beta: there is no such parameter";
    QTest::newRow("band") << Axes{{"band", 3.0, 4.0, 2}} << "band: there is no such parameter";
    QTest::newRow("not in use") << Axes{{"edges.balloon", 0.0, 1.0, 2}} << "alpha, range, target, rescale";
    QTest::newRow("above 1") << Axes{{"alpha", 0.5, 1.5, 3}} << "alpha must be between 0 and 1";
    QTest::newRow("range of 0") << Axes{{"range", 0.0, 1.0, 3}} << "range epsilon must be at least";
    QTest::newRow("backward") << Axes{{"alpha", 0.9, 0.2, 3}} << "must be below the last";
  }
  void axes_that_the_level_set_does_not_take_are_refused() {
    QFETCH(std::vector<document::SweepAxis>, axes);
    QFETCH(QString, message);
    const Status good = document::check(axes, lumpy_parameters(), {});
    QVERIFY(!good);
    QCOMPARE(good.error().kind, ErrorKind::usage);
    QVERIFY2(failure(good).contains(message), qPrintable(failure(good)));
  }

  void numbers_of_the_functions_in_use_can_be_swept() {
    solver::SpeedSetting setting;
    setting.terms = {{"edges", {}}};
    const auto names = document::sweep_parameters(setting);
    QVERIFY(std::find(names.begin(), names.end(), "edges.balloon") != names.end());
    QVERIFY(std::find(names.begin(), names.end(), "range") == names.end());
    solver::Parameters parameters;
    document::set_parameter("edges.balloon", 0.25, parameters, setting);
    QCOMPARE(setting.terms.front().values.at("balloon"), 0.25);
    QCOMPARE(document::parameter_of("edges.balloon", parameters, setting), std::optional(0.25));
    QVERIFY(!document::check({{"edges.balloon", 0.0, 2.0, 3}}, parameters, setting));
  }

  void bits_hold_what_a_mask_holds_data() {
    QTest::addColumn<Index3>("page");
    QTest::newRow("host") << Index3(8);
    QTest::newRow("stream") << Index3(16, 16, 1);
    QTest::newRow("small") << Index3(4);
  }
  void bits_hold_what_a_mask_holds() {
    QFETCH(Index3, page);
    Geometry grid;
    grid.size = {45, 21, 19};
    std::vector<float> values(static_cast<std::size_t>(grid.voxel_count()), -3.0F);
    for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
      const glm::dvec3 off = glm::dvec3(grid.voxel_at(i)) - glm::dvec3(30.0, 12.0, 11.0);
      values[static_cast<std::size_t>(i)] = static_cast<float>(std::clamp(7.5 - glm::length(off), -3.0, 3.0));
    }
    const auto phi = solver::Field::from_dense(grid, values, 3.0, page);
    const Mask mask = phi.mask();
    const Region bits = solver::inside_region(phi);
    QCOMPARE(bits.count(), mask.count());
    for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
      QCOMPARE(bits.contains(grid.voxel_at(i)), mask.voxels[static_cast<std::size_t>(i)] != 0);
    }
    QVERIFY(!bits.contains({-1, 12, 11}));
    QCOMPARE(dice(bits, Region(mask)), 1.0);
    // Of a ball that is cut in two, by counting.
    Mask half = mask;
    for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
      if (grid.voxel_at(i).x > 30) half.voxels[static_cast<std::size_t>(i)] = 0;
    }
    QCOMPARE(dice(bits, Region(half)), dice(mask, half));
  }

  void nothing_inside_takes_no_bits() {
    Geometry grid;
    grid.size = {20, 20, 20};
    const Region nothing = solver::inside_region(solver::Field::empty(grid, 2.5));
    QCOMPARE(nothing.count(), std::int64_t{0});
    QCOMPARE(nothing.bytes(), std::int64_t{0});
    QVERIFY(!nothing.contains({0, 0, 0}));
    QCOMPARE(dice(nothing, nothing), 1.0);
  }

  void each_run_is_what_it_is_alone_data() {
    QTest::addColumn<bool>("until_converged");
    QTest::newRow("so many steps") << false;
    QTest::newRow("to rest") << true;
  }
  void each_run_is_what_it_is_alone() {
    QFETCH(bool, until_converged);
    const auto volume = lumpy_volume();
    document::Recipe recipe = lumpy_recipe(*volume);
    recipe.smoothed_mm = 1.1;
    recipe.steps = until_converged ? 2000 : 60;
    auto options = over({kAlphas, kRanges});
    options.steps = recipe.steps;
    options.until_converged = until_converged;
    const auto sweep = swept(recipe, volume, options);
    QCOMPARE(sweep.columns(), 3);
    QCOMPARE(sweep.rows(), 2);
    for (int row = 0; row < sweep.rows(); ++row) {
      for (int column = 0; column < sweep.columns(); ++column) {
        const document::SweepRun& run = sweep.at(column, row);
        QCOMPARE(run.parameters.alpha, kAlphas.value(column));
        QCOMPARE(run.parameters.range, kRanges.value(row));
        const auto single = alone(recipe, run, volume, until_converged);
        QVERIFY(run.inside == solver::inside_region(single.phi));
        QCOMPARE(run.volume_ml, single.surface.volume_ml);
        QCOMPARE(run.steps, single.advance.steps);
        QCOMPARE(run.converged, single.advance.converged);
        QCOMPARE(run.outcome, single.outcome);
        QVERIFY(run.problem.empty());
      }
    }
    QVERIFY(sweep.at(0, 0).inside.count() != sweep.at(2, 1).inside.count());
  }

  void functions_and_walls_drive_the_runs_too() {
    const auto volume = lumpy_volume();
    document::Recipe recipe = lumpy_recipe(*volume);
    document::Drive drive;
    drive.setting.terms = {{"tent", {}}, {"edges", {}}};
    auto walls = std::make_shared<solver::Constraints>(volume->geometry.size);
    walls->set(volume->geometry, ball_at(*volume, {6, 0, 0}, 4.0), solver::Constraint::wall);
    drive.constraints = walls;
    recipe.drive = std::make_shared<const document::Drive>(drive);
    const auto sweep = swept(recipe, volume, over({kRanges, {"edges.balloon", 0.3, 0.9, 3}}));
    for (int row = 0; row < sweep.rows(); ++row) {
      for (int column = 0; column < sweep.columns(); ++column) {
        const document::SweepRun& run = sweep.at(column, row);
        QCOMPARE(run.parameters.range, kRanges.value(column));
        const auto single = alone(recipe, run, volume, true);
        QVERIFY(run.inside == solver::inside_region(single.phi));
      }
    }
  }

  void a_refined_start_keeps_its_limit() {
    const auto volume = lumpy_volume();
    document::Recipe recipe = lumpy_recipe(*volume);
    document::SweepRun plain;
    plain.parameters = recipe.parameters;
    const auto before = alone(recipe, plain, volume, true);
    recipe.start = {};
    recipe.start.from =
        document::limited({std::make_shared<const BitMask>(before.start.mask()), "mask"}, 2.0).value();
    const auto sweep = swept(recipe, volume, over({kAlphas}));
    for (const document::SweepRun& run : sweep.runs) {
      const auto single = alone(recipe, run, volume, true);
      QVERIFY(run.inside == solver::inside_region(single.phi));
      QVERIFY(run.inside.count() < before.surface.voxels_inside);
    }
  }

  void threads_change_no_bit() {
    const auto volume = lumpy_volume();
    auto options = over({kAlphas, kRanges});
    const auto two = swept(lumpy_recipe(*volume), volume, options);
    options.threads = 5;
    const auto five = swept(lumpy_recipe(*volume), volume, options);
    for (std::size_t i = 0; i < two.runs.size(); ++i) QVERIFY(two.runs[i].inside == five.runs[i].inside);
  }

  void agreement_is_the_share_of_runs() {
    const auto volume = lumpy_volume();
    const auto sweep = swept(lumpy_recipe(*volume), volume, over({kAlphas, kRanges}));
    QCOMPARE(sweep.agreement.surfaces(), 6);
    bool some_disagree = false;
    for (std::int64_t i = 0; i < volume->geometry.voxel_count(); ++i) {
      const Index3 voxel = volume->geometry.voxel_at(i);
      int count = 0;
      for (const document::SweepRun& run : sweep.runs) count += run.inside.contains(voxel) ? 1 : 0;
      QCOMPARE(sweep.agreement.count(voxel), count);
      some_disagree = some_disagree || (count > 0 && count < 6);
    }
    QVERIFY(some_disagree);
    QCOMPARE(sweep.agreement.count({-1, 0, 0}), 0);
  }

  void dice_is_of_the_truth() {
    const auto volume = lumpy_volume();
    auto options = over({kAlphas});
    const auto first = swept(lumpy_recipe(*volume), volume, options);
    QVERIFY(!first.runs.front().dice);
    options.truth = std::make_shared<const Region>(first.at(1, 0).inside);
    const auto compared = swept(lumpy_recipe(*volume), volume, options);
    QCOMPARE(compared.at(1, 0).dice, std::optional(1.0));
    QVERIFY(*compared.at(0, 0).dice < 1.0);
  }

  void a_request_to_stop_ends_all_runs() {
    const auto volume = lumpy_volume({90, 90, 90});
    const auto start = document::sweep_start(lumpy_recipe(*volume), volume);
    QCOMPARE(failure(start), QString());
    auto options = over({kAlphas, kRanges});
    options.steps = 1'000'000'000;
    options.until_converged = false;
    std::stop_source stop;
    std::jthread stopper([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      stop.request_stop();
    });
    const auto sweep = document::run_sweep(*start, options, {nullptr, stop.get_token()});
    QVERIFY(!sweep);
    QCOMPARE(sweep.error().kind, ErrorKind::cancelled);
  }

  void progress_ends_with_all_runs() {
    const auto volume = lumpy_volume();
    const auto start = document::sweep_start(lumpy_recipe(*volume), volume);
    std::vector<double> fractions;
    const Progress progress{[&](double fraction, std::string_view) { fractions.push_back(fraction); }, {}};
    QCOMPARE(failure(document::run_sweep(*start, over({kAlphas, kRanges}), progress)), QString());
    QCOMPARE(fractions.size(), std::size_t{6});
    QVERIFY(std::is_sorted(fractions.begin(), fractions.end()));
    QCOMPARE(fractions.back(), 1.0);
  }

  void a_budget_that_does_not_hold_the_results_is_refused_at_once() {
    const auto volume = lumpy_volume();
    const auto start = document::sweep_start(lumpy_recipe(*volume), volume);
    auto options = over({kAlphas, kRanges});
    options.memory_budget_bytes = 20'000;  // 37 x 34 x 29 voxels are 36,482 bytes of counts alone
    const auto sweep = document::run_sweep(*start, options);
    QVERIFY(!sweep);
    QCOMPARE(sweep.error().kind, ErrorKind::capability);
    QVERIFY2(failure(sweep).contains("does not hold the results of 6 runs"), qPrintable(failure(sweep)));
  }

  void a_run_without_memory_is_left_out() {
    const auto volume = lumpy_volume({90, 90, 90});
    document::Recipe recipe = lumpy_recipe(*volume);
    recipe.parameters.alpha = 1.0;
    const auto start = document::sweep_start(recipe, volume);
    auto options = over({{"range", 30.0, 2000.0, 2}});  // the second fills the volume
    options.steps = 400;
    options.threads = 1;
    options.memory_budget_bytes = 6'000'000;
    const auto sweep = document::run_sweep(*start, options);
    QCOMPARE(failure(sweep), QString());
    QVERIFY(sweep->at(0, 0).problem.empty());
    QVERIFY(!sweep->at(1, 0).problem.empty());
    QCOMPARE(sweep->agreement.surfaces(), 1);
    options.memory_budget_bytes = 800'000;  // what the counts take, and next to nothing for the runs
    const auto none = document::run_sweep(*start, options);
    QVERIFY(!none);
    QCOMPARE(none.error().kind, ErrorKind::capability);
  }

  void pictures_show_the_inside_where_most_of_it_is() {
    const auto volume = lumpy_volume();
    const auto sweep = swept(lumpy_recipe(*volume), volume, over({kAlphas}));
    const auto cut = document::sweep_cut(sweep.agreement, volume->geometry);
    std::int64_t there = 0;
    std::vector<std::int64_t> a_slice(static_cast<std::size_t>(volume->geometry.size.z));
    for (std::int64_t i = 0; i < volume->geometry.voxel_count(); ++i) {
      const Index3 voxel = volume->geometry.voxel_at(i);
      if (sweep.agreement.count(voxel) > 0) ++a_slice[static_cast<std::size_t>(voxel.z)];
    }
    there = a_slice[static_cast<std::size_t>(cut.k)];
    QCOMPARE(there, *std::max_element(a_slice.begin(), a_slice.end()));
    const auto picture = document::picture_of(sweep.runs.front().inside, *volume, {700.0, 900.0}, cut, 64);
    int yellow = 0;
    int grey = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); i += 4) {
      yellow += picture.pixels[i] == 255 && picture.pixels[i + 1] == 214 && picture.pixels[i + 2] == 10;
      grey += picture.pixels[i] == picture.pixels[i + 1] && picture.pixels[i] == picture.pixels[i + 2];
    }
    QVERIFY2(yellow > 40 && yellow < 600, qPrintable(QString::number(yellow)));  // an outline
    QVERIFY(grey > 800);
    const auto none = document::picture_of(Region(), *volume, {700.0, 900.0}, cut, 64);
    for (std::size_t i = 0; i < none.pixels.size(); i += 4) QCOMPARE(none.pixels[i], none.pixels[i + 2]);
  }
};

TIDEMARK_TEST(SweepTest)

}  // namespace tidemark::test::sweep_test

#include "sweep_test.moc"
