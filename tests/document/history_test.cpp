// Undo and redo of everything that can be done to a level set, to the last bit.
#include <random>

#include "cases.h"
#include "tests/support/test_program.h"

namespace tidemark::test::history_test {

namespace {

using Edit = std::function<Status(document::Case&)>;

std::vector<std::int64_t> measured_steps(const document::LevelSet& level_set) {
  std::vector<std::int64_t> steps;
  for (const document::CurvePoint& point : *level_set.curve().points()) steps.push_back(point.step);
  return steps;
}

}  // namespace

class HistoryTest : public QObject {
  Q_OBJECT

 private slots:
  void no_way_through_the_history_leads_to_dice_of_a_former_answer() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 8);
    level_set.note({8, 1.0, 2.0, 3.0, 0.9});
    QCOMPARE(failure(level_set.end_run()), QString());
    run(level_set, 4);
    level_set.note({12, 1.5, 2.5, 3.5, 0.8});
    QCOMPARE(failure(level_set.end_run()), QString());
    level_set.forget_dice();
    run(level_set, 3);
    level_set.note({15, 2.0, 3.0, 4.0, 0.1});
    QCOMPARE(failure(level_set.end_run()), QString());
    const auto present_one_alone = [&] {
      for (const document::CurvePoint& point : *level_set.curve().points()) {
        if (point.dice.has_value() != (point.step == 15)) return false;
      }
      return true;
    };
    while (document->history().undo_description()) {
      QCOMPARE(failure(document->undo()), QString());
      QVERIFY(present_one_alone());
    }
    while (document->history().redo_description()) {
      QCOMPARE(failure(document->redo()), QString());
      QVERIFY(present_one_alone());
    }
    QCOMPARE(measured_steps(level_set), (std::vector<std::int64_t>{8, 12, 15}));
    QVERIFY(level_set.curve().points()->back().dice == 0.1);
  }

  void each_kind_of_change_can_be_taken_back_and_done_again_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<QString>("text");
    QTest::newRow("start") << 0 << "start";
    QTest::newRow("paint") << 1 << "paint";
    QTest::newRow("erase") << 2 << "erase";
    QTest::newRow("target") << 3 << "T";
    QTest::newRow("range") << 4 << "range";
    QTest::newRow("alpha") << 5 << "smoothing";
    QTest::newRow("two parameters") << 6 << "parameters";
    QTest::newRow("evolution") << 7 << "evolution, 23 steps";
    QTest::newRow("step back") << 8 << "5 steps back";
    QTest::newRow("restart") << 9 << "restart";
    QTest::newRow("smoothed source") << 10 << "smoothing of the volume";
  }
  void each_kind_of_change_can_be_taken_back_and_done_again() {
    QFETCH(int, kind);
    QFETCH(QString, text);
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 20);
    QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 4.0), solver::Brush::add)),
             QString());
    run(level_set, 9);
    QCOMPARE(failure(level_set.end_run()), QString());
    solver::Parameters changed = level_set.parameters();
    if (kind == 3 || kind == 6) changed.target += 40.0;
    if (kind == 4 || kind == 6) changed.range += 40.0;
    if (kind == 5) changed.alpha = 0.4;
    const solver::Sphere sphere = ball_at(*document->volume(), {-5, 4, 0}, 5.0);
    const std::vector<Edit> edits{
        [](document::Case& c) {
          document::Start start;
          start.from = document::ThresholdStart{900.0, 1100.0};
          return c.level_set().begin(start);
        },
        [&](document::Case& c) { return c.level_set().paint(sphere, solver::Brush::add); },
        [&](document::Case& c) { return c.level_set().paint(sphere, solver::Brush::erase); },
        [&](document::Case& c) { return c.level_set().set_parameters(changed); },
        [&](document::Case& c) { return c.level_set().set_parameters(changed); },
        [&](document::Case& c) { return c.level_set().set_parameters(changed); },
        [&](document::Case& c) { return c.level_set().set_parameters(changed); },
        [](document::Case& c) {
          run(c.level_set(), 20);
          run(c.level_set(), 3);
          return Status();
        },
        [](document::Case& c) { return c.level_set().step_back(5); },
        [](document::Case& c) { return c.level_set().restart(); },
        [](document::Case& c) { return c.smooth_source(1.0); },
    };
    const Seen before(level_set);
    QCOMPARE(failure(edits[static_cast<std::size_t>(kind)](*document)), QString());
    const Seen after(level_set);
    QVERIFY(!(before == after));
    QCOMPARE(undo_text(*document), text.toStdString());
    for (int round = 0; round < 2; ++round) {
      QCOMPARE(failure(document->undo()), QString());
      QVERIFY(Seen(level_set) == before);
      QCOMPARE(undo_text(*document), std::string("evolution, 9 steps"));
      QCOMPARE(failure(document->redo()), QString());
      QVERIFY(Seen(level_set) == after);
    }
    QCOMPARE(failure(level_set.executor().validate()), QString());
  }

  void the_curve_goes_back_and_forth_with_the_surface() {
    using Steps = std::vector<std::int64_t>;
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    const auto note = [&] { level_set.note({level_set.step(), 1.0, 2.0, 3.0}); };
    note();
    for (int i = 0; i < 2; ++i) {
      run(level_set, 10);
      note();
    }
    QCOMPARE(failure(document->undo()), QString());
    QCOMPARE(measured_steps(level_set), Steps{0});
    QCOMPARE(failure(document->redo()), QString());
    QCOMPARE(measured_steps(level_set), (Steps{0, 10, 20}));
    const auto taken_back = [&] {
      QCOMPARE(failure(document->undo()), QString());
      QCOMPARE(measured_steps(level_set), (Steps{0, 10, 20}));
    };
    QCOMPARE(failure(level_set.step_back(5)), QString());
    QCOMPARE(measured_steps(level_set), (Steps{0, 10}));
    taken_back();
    // What is measured anew at the same step.
    QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 4.0), solver::Brush::add)),
             QString());
    QCOMPARE(measured_steps(level_set), (Steps{0, 10}));
    taken_back();
    // Another run from the start does not mix with the first.
    QCOMPARE(failure(level_set.restart()), QString());
    QCOMPARE(measured_steps(level_set), Steps{});
    run(level_set, 7);
    note();
    QCOMPARE(failure(document->undo()), QString());
    QCOMPARE(measured_steps(level_set), Steps{});
    taken_back();
  }

  void what_changes_nothing_is_no_entry() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    QCOMPARE(failure(level_set.set_parameters(level_set.parameters())), QString());
    QCOMPARE(failure(level_set.step_back(3)), QString());
    QCOMPARE(failure(level_set.restart()), QString());
    QCOMPARE(failure(document->smooth_source(0.0)), QString());
    std::stop_source stop;
    stop.request_stop();
    QCOMPARE(level_set.advance({.steps = 5, .progress = {nullptr, stop.get_token()}})->steps,
             std::int64_t{0});
    QCOMPARE(undo_text(*document), std::string("start"));
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(!level_set.begun());
    QCOMPARE(document->undo().error().kind, ErrorKind::usage);
  }

  void a_start_that_fails_leaves_everything_as_it_was() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 7);
    QCOMPARE(failure(level_set.end_run()), QString());
    const Seen before(level_set);
    document::Start nothing;
    nothing.from = document::ThresholdStart{5000.0, 6000.0};
    QCOMPARE(level_set.begin(nothing).error().kind, ErrorKind::usage);
    document::Start outside;
    outside.seeds = {ball_at(*document->volume(), {500, 0, 0}, 5.0)};
    QCOMPARE(level_set.begin(outside).error().kind, ErrorKind::usage);
    document::Start other_grid;
    Mask mask{lumpy_volume({10, 10, 10})->geometry, std::vector<std::uint8_t>(1000, 1)};
    other_grid.from = document::MaskStart{std::make_shared<const BitMask>(mask), "small"};
    QCOMPARE(level_set.begin(other_grid).error().kind, ErrorKind::usage);
    QVERIFY(Seen(level_set) == before);
    QCOMPARE(undo_text(*document), std::string("evolution, 7 steps"));
  }

  void what_finds_no_room_leaves_everything_as_it_was() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 40);
    QCOMPARE(failure(level_set.restart()), QString());
    QCOMPARE(failure(document->smooth_source(0.5)), QString());
    QCOMPARE(failure(level_set.set_parameters(with_target(level_set.parameters(), 800.0))), QString());
    const Seen before(level_set);
    const std::string text = undo_text(*document);
    solver::ExecutorOptions tight;
    tight.threads = 1;
    const solver::MemoryReport memory = level_set.executor().memory();
    tight.memory_budget_bytes = (memory.state_bytes + memory.source_bytes) * 5 / 4;
    QCOMPARE(failure(level_set.change_executor(solver::ExecutorKind::host, tight)), QString());
    // A point with other parameters, another source, and a surface everywhere.
    document::Recipe recipe = level_set.recipe();
    recipe.parameters.target = 900.0;
    recipe.events.clear();
    const Geometry& geometry = document->volume()->geometry;
    const std::vector<float> values(static_cast<std::size_t>(geometry.voxel_count()), 0.5F);
    const double band = level_set.executor().band();
    const auto everywhere =
        std::make_shared<const solver::Field>(solver::Field::from_dense(geometry, values, band));
    QCOMPARE(level_set.resume_from(recipe, everywhere).error().kind, ErrorKind::capability);
    QVERIFY(Seen(level_set) == before);
    QCOMPARE(undo_text(*document), text);
  }

  void random_edits_undo_and_redo_follow_a_model_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<int>("seed");
    for (int seed = 1; seed <= 6; ++seed) {
      QTest::addRow("host, %d", seed) << int(solver::ExecutorKind::host) << seed;
    }
    QTest::newRow("compute") << int(solver::ExecutorKind::compute) << 7;
    QTest::newRow("stream") << int(solver::ExecutorKind::stream) << 8;
  }
  void random_edits_undo_and_redo_follow_a_model() {
    QFETCH(int, seed);
    const auto document = begun_case(this_executor());
    document::LevelSet& level_set = document->level_set();
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto number = [&](int low, int high) {
      return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
    };
    std::vector<Seen> states{Seen(level_set)};  // the model: what was seen at each end of an entry
    std::size_t at = 0;
    const int rounds = this_executor() == solver::ExecutorKind::host ? 60 : 16;
    for (int round = 0; round < rounds; ++round) {
      const int action = number(0, 9);
      if (action <= 2 && at > 0) {
        QCOMPARE(failure(document->undo()), QString());
        --at;
      } else if (action <= 4 && at + 1 < states.size()) {
        QCOMPARE(failure(document->redo()), QString());
        ++at;
      } else {
        const glm::dvec3 place(number(-9, 9), number(-9, 9), number(-7, 7));
        const solver::Brush brush = number(0, 2) == 0 ? solver::Brush::erase : solver::Brush::add;
        Status done;
        if (action == 5) {
          done = level_set.set_parameters(with_target(level_set.parameters(), number(700, 990) + 0.5));
        } else if (action == 6 && level_set.step() > 0) {
          done = level_set.step_back(number(1, 5));
        } else if (action == 7) {
          run(level_set, number(1, 6));
          done = level_set.end_run();
        } else {
          done = level_set.paint(ball_at(*document->volume(), place, number(2, 5)), brush);
        }
        QCOMPARE(failure(done), QString());
        states.erase(states.begin() + static_cast<std::ptrdiff_t>(at) + 1, states.end());
        states.emplace_back(level_set);
        ++at;
      }
      QVERIFY(Seen(level_set) == states[at]);
    }
    QCOMPARE(failure(level_set.executor().validate()), QString());
  }

  void memory_stays_below_the_limit_and_the_oldest_goes_first() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    constexpr std::int64_t kLimit = 900'000;
    document->history().set_limit(kLimit);
    std::vector<Seen> states{Seen(level_set)};
    for (int i = 0; i < 12; ++i) {
      run(level_set, 5);
      QCOMPARE(failure(level_set.end_run()), QString());
      states.emplace_back(level_set);
      QVERIFY(document->history().bytes() <= kLimit);
    }
    int undone = 0;
    while (document->undo()) {
      ++undone;
      QVERIFY(Seen(level_set) == states[states.size() - 1 - static_cast<std::size_t>(undone)]);
    }
    QVERIFY(undone >= 1);
    QVERIFY(undone < 12);
    QVERIFY(document->changed_since_save());
  }

  void whether_something_would_be_lost_is_known() {
    const auto document = make_case(lumpy_volume());
    document::LevelSet& level_set = document->level_set();
    QVERIFY(!document->changed_since_save());
    QCOMPARE(failure(level_set.begin(seed_in(*document->volume()))), QString());
    QVERIFY(document->changed_since_save());
    document->mark_saved();
    QVERIFY(!document->changed_since_save());
    run(level_set, 3);
    QVERIFY(document->changed_since_save());
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(!document->changed_since_save());
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(document->changed_since_save());
    QCOMPARE(failure(document->redo()), QString());
    QVERIFY(!document->changed_since_save());
  }
};

TIDEMARK_TEST(HistoryTest)

}  // namespace tidemark::test::history_test

#include "history_test.moc"
