// A case becomes one of the runs of a sweep, and comes back.
#include "document/session_contents.h"
#include "document/sweep.h"
#include "recipes.h"
#include "solver/inside_region.h"
#include "tests/support/test_program.h"

namespace tidemark::test::taken_run_test {

namespace {

document::Sweep swept(const document::SweepStart& start) {
  document::SweepOptions options;
  options.axes = {{"alpha", 0.5, 0.9, 2}, {"range", 150.0, 250.0, 2}};
  options.threads = 1;
  auto sweep = document::run_sweep(start, options);
  if (!sweep) qFatal("%s", sweep.error().message.c_str());
  return std::move(*sweep);
}

document::SweepStart start_of(document::LevelSet& level_set) {
  auto start = level_set.sweep_start();
  if (!start) qFatal("%s", start.error().message.c_str());
  return std::move(*start);
}

Region inside(const document::LevelSet& level_set) {
  return solver::inside_region(level_set.executor().snapshot().value());
}

}  // namespace

class TakenRunTest : public QObject {
  Q_OBJECT

 private slots:
  void a_run_is_taken_in_one_step_data() { add_executors(); }
  void a_run_is_taken_in_one_step() {
    const auto document = begun_case(this_executor());
    document::LevelSet& level_set = document->level_set();
    QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 3.0), solver::Brush::add)),
             QString());
    run(level_set, 25);
    const auto start = start_of(level_set);
    const auto sweep = swept(start);
    QCOMPARE(failure(level_set.end_run()), QString());
    const Seen before(level_set);
    const document::SweepRun& wanted = sweep.at(1, 0);
    QCOMPARE(failure(level_set.take_run(start, wanted)), QString());
    QVERIFY(level_set.parameters() == wanted.parameters);
    QCOMPARE(level_set.step(), wanted.steps);
    // Where the case computes as runs do, it is the same surface to the last voxel.
    const double same = dice(inside(level_set), wanted.inside);
    if (this_executor() == solver::ExecutorKind::host) {
      QVERIFY(inside(level_set) == wanted.inside);
    } else {
      QVERIFY2(same > 0.999, qPrintable(QString::number(same)));
    }
    QCOMPARE(undo_text(*document), fmt::format("run of a sweep, {} steps", wanted.steps));
    const Seen taken(level_set);
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(Seen(level_set) == before);
    QCOMPARE(failure(document->redo()), QString());
    QVERIFY(Seen(level_set) == taken);
    // Another one from the same sweep.
    QCOMPARE(failure(level_set.take_run(start, sweep.at(0, 1))), QString());
    QVERIFY(level_set.parameters() == sweep.at(0, 1).parameters);
  }

  void its_recipe_leads_to_the_same_bits() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 10);
    const auto start = start_of(level_set);
    const auto sweep = swept(start);
    QCOMPARE(failure(level_set.take_run(start, sweep.at(1, 1))), QString());
    QVERIFY(replayed(again(level_set.recipe()), document->volume()) == values_of(level_set));
    // And a step back from there leads to what was there.
    QCOMPARE(failure(level_set.step_back(5)), QString());
    run(level_set, 5);
    QVERIFY(inside(level_set) == sweep.at(1, 1).inside);
  }

  void runs_begin_without_walls_that_are_gone() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    QCOMPARE(failure(level_set.set_drive(with_wall(*document, {1.3, -0.7, 0.4}, 3.0))), QString());
    run(level_set, 10);
    QCOMPARE(failure(level_set.set_drive({})), QString());
    const Seen before(level_set);
    const auto start = start_of(level_set);
    QVERIFY(Seen(level_set) == before);
    const auto sweep = swept(start);
    for (const int row : {0, 1}) {  // each from the same sweep
      QCOMPARE(failure(level_set.take_run(start, sweep.at(1, row))), QString());
      QVERIFY(inside(level_set) == sweep.at(1, row).inside);
      QVERIFY(replayed(again(level_set.recipe()), document->volume()) == values_of(level_set));
    }
  }

  void functions_are_taken_with_their_numbers() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    document::Drive drive = level_set.drive();
    drive.setting.terms = {{"edges", {}}};
    QCOMPARE(failure(level_set.set_drive(drive)), QString());
    const auto speed = document::make_speed(drive, level_set.source(), level_set.parameters());
    QCOMPARE(failure(speed), QString());
    QCOMPARE(failure(level_set.set_speed(*speed)), QString());
    run(level_set, 10);
    const auto start = start_of(level_set);
    document::SweepOptions options;
    options.axes = {{"edges.balloon", -0.5, 0.9, 2}};
    options.steps = 40;
    options.until_converged = false;
    const auto sweep = document::run_sweep(start, options);
    QCOMPARE(failure(sweep), QString());
    QCOMPARE(failure(level_set.take_run(start, sweep->at(1, 0))), QString());
    QCOMPARE(level_set.drive().setting.terms.front().values.at("balloon"), 0.9);
    QVERIFY(inside(level_set) == sweep->at(1, 0).inside);
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(level_set.drive().setting.terms.front().values.empty());
  }

  void one_of_another_start_is_refused() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    const auto start = start_of(level_set);
    const auto sweep = swept(start);
    document::Start other;
    other.seeds = {ball_at(*document->volume(), {0, 0, 0}, 7.0)};
    QCOMPARE(failure(level_set.begin(other)), QString());
    run(level_set, 3);
    const Seen before(level_set);
    const Status taken = level_set.take_run(start, sweep.at(0, 0));
    QVERIFY(!taken);
    QCOMPARE(taken.error().kind, ErrorKind::usage);
    QVERIFY(Seen(level_set) == before);
    QCOMPARE(failure(document->undo()), QString());  // the steps
    QCOMPARE(failure(document->undo()), QString());  // the other start
    QCOMPARE(failure(level_set.take_run(start, sweep.at(0, 0))), QString());
  }

  void a_cancelled_one_changes_nothing() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 12);
    QCOMPARE(failure(level_set.end_run()), QString());
    const auto start = start_of(level_set);
    const auto sweep = swept(start);
    const Seen before(level_set);
    std::stop_source stop;
    stop.request_stop();
    QCOMPARE(level_set.take_run(start, sweep.at(0, 0), {nullptr, stop.get_token()}).error().kind,
             ErrorKind::cancelled);
    QVERIFY(Seen(level_set) == before);
    QCOMPARE(undo_text(*document), std::string("evolution, 12 steps"));
  }

  void nothing_can_be_swept_without_a_surface() {
    const auto document = make_case(lumpy_volume());
    const auto start = document->level_set().sweep_start();
    QVERIFY(!start);
    QCOMPARE(start.error().kind, ErrorKind::usage);
  }

  void a_session_that_was_saved_later_is_swept_from_its_start() {
    const auto document = begun_case();
    run(document->level_set(), 20);
    const auto sweep = swept(start_of(document->level_set()));
    const auto contents = document::snapshot_of(*document);
    QCOMPARE(failure(contents), QString());
    const auto opened = document::restore_case(*contents, document->volume(), solver::ExecutorKind::host, {});
    QCOMPARE(failure(opened), QString());
    document::LevelSet& level_set = (*opened)->level_set();
    const Seen before(level_set);
    const auto start = start_of(level_set);
    QVERIFY(Seen(level_set) == before);
    const auto again = swept(start);
    for (std::size_t i = 0; i < sweep.runs.size(); ++i) {
      QVERIFY(again.runs[i].inside == sweep.runs[i].inside);
    }
    QCOMPARE(failure(level_set.take_run(start, again.at(1, 1))), QString());
    QVERIFY(inside(level_set) == sweep.at(1, 1).inside);
  }
};

TIDEMARK_TEST(TakenRunTest)

}  // namespace tidemark::test::taken_run_test

#include "taken_run_test.moc"
