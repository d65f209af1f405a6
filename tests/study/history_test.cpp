// Undo and redo of everything that can be done to a level set, to the last bit.
#include <random>

#include "cases.h"
#include "gpu/device.h"

using namespace tidemark;
using namespace tidemark::test;

namespace {

// What a level set is, for comparisons.
struct Seen {
  std::vector<float> phi;
  Parameters parameters;
  std::int64_t step = 0;
  std::size_t events = 0;
  bool begun = false;
  double smoothed_mm = 0.0;

  explicit Seen(const LevelSet& level_set)
      : phi(values_of(level_set)),
        parameters(level_set.parameters()),
        step(level_set.step()),
        events(level_set.recipe().events.size()),
        begun(level_set.begun()),
        smoothed_mm(level_set.smoothed_mm()) {}
  bool operator==(const Seen&) const = default;
};

std::string undo_text(Case& document) {
  const auto description = document.history().undo_description();
  return description ? describe(*description) : std::string();
}

using Edit = std::function<Status(Case&)>;

Parameters with_target(Parameters parameters, double target) {
  parameters.target = target;
  return parameters;
}

}  // namespace

class HistoryTest : public QObject {
  Q_OBJECT

 private slots:
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
    LevelSet& level_set = document->level_set();
    run(level_set, 20);
    QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 4.0), Brush::add)), QString());
    run(level_set, 9);
    QCOMPARE(failure(level_set.end_run()), QString());
    Parameters changed = level_set.parameters();
    if (kind == 3 || kind == 6) changed.target += 40.0;
    if (kind == 4 || kind == 6) changed.range += 40.0;
    if (kind == 5) changed.alpha = 0.4;
    const Sphere sphere = ball_at(*document->volume(), {-5, 4, 0}, 5.0);
    const std::vector<Edit> edits{
        [](Case& c) {
          Start start;
          start.from = ThresholdStart{900.0, 1100.0};
          return c.level_set().begin(start);
        },
        [&](Case& c) { return c.level_set().paint(sphere, Brush::add); },
        [&](Case& c) { return c.level_set().paint(sphere, Brush::erase); },
        [&](Case& c) { return c.level_set().set_parameters(changed); },
        [&](Case& c) { return c.level_set().set_parameters(changed); },
        [&](Case& c) { return c.level_set().set_parameters(changed); },
        [&](Case& c) { return c.level_set().set_parameters(changed); },
        [](Case& c) {
          run(c.level_set(), 20);
          run(c.level_set(), 3);
          return Status();
        },
        [](Case& c) { return c.level_set().step_back(5); },
        [](Case& c) { return c.level_set().restart(); },
        [](Case& c) { return c.smooth_source(1.0); },
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

  void a_gesture_with_its_steps_is_one_entry() {
    const auto document = begun_case();
    LevelSet& level_set = document->level_set();
    run(level_set, 10);
    QCOMPARE(failure(level_set.end_run()), QString());
    const Seen before(level_set);
    for (int i = 0; i < 4; ++i) {
      const Sphere dab = ball_at(*document->volume(), {5.0 + i, 0, 0}, 3.0);
      QCOMPARE(failure(level_set.paint(dab, Brush::add, 17)), QString());
      run(level_set, 2);
    }
    QCOMPARE(undo_text(*document), std::string("paint"));
    const Seen after(level_set);
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(Seen(level_set) == before);
    QCOMPARE(undo_text(*document), std::string("evolution, 10 steps"));
    QCOMPARE(failure(document->redo()), QString());
    QVERIFY(Seen(level_set) == after);
  }

  void steps_after_a_gesture_become_a_run_of_their_own_with_the_next_checkpoint() {
    const auto document = begun_case();
    LevelSet& level_set = document->level_set();
    Parameters parameters = level_set.parameters();
    for (int i = 1; i <= 3; ++i) {
      QCOMPARE(failure(level_set.set_parameters(with_target(parameters, 850.0 + i), 5)), QString());
      run(level_set, 4);
      QVERIFY(level_set.checkpoint());  // in the middle of the gesture: no end to it
    }
    const Seen divided(level_set);
    run(level_set, 30);
    const Seen after(level_set);
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(Seen(level_set) == divided);
    QCOMPARE(undo_text(*document), std::string("T"));
    QCOMPARE(failure(document->undo()), QString());
    QCOMPARE(undo_text(*document), std::string("start"));
    QCOMPARE(level_set.step(), std::int64_t{0});
    QCOMPARE(failure(document->redo()), QString());
    QCOMPARE(failure(document->redo()), QString());
    QVERIFY(Seen(level_set) == after);
  }

  void another_gesture_is_another_entry() {
    const auto document = begun_case();
    LevelSet& level_set = document->level_set();
    const Parameters parameters = level_set.parameters();
    for (const std::uint64_t gesture : {1, 1, 2, 0, 0}) {
      const double target = level_set.parameters().target + 1.0;
      QCOMPARE(failure(level_set.set_parameters(with_target(parameters, target), gesture)), QString());
    }
    for (const double target : {854.0, 853.0, 852.0, 850.0}) {
      QCOMPARE(failure(document->undo()), QString());
      QCOMPARE(level_set.parameters().target, target);
    }
    QCOMPARE(undo_text(*document), std::string("start"));
  }

  void what_changes_nothing_is_no_entry() {
    const auto document = begun_case();
    LevelSet& level_set = document->level_set();
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
    LevelSet& level_set = document->level_set();
    run(level_set, 7);
    QCOMPARE(failure(level_set.end_run()), QString());
    const Seen before(level_set);
    Start nothing;
    nothing.from = ThresholdStart{5000.0, 6000.0};
    QCOMPARE(level_set.begin(nothing).error().kind, ErrorKind::usage);
    Start outside;
    outside.seeds = {ball_at(*document->volume(), {500, 0, 0}, 5.0)};
    QCOMPARE(level_set.begin(outside).error().kind, ErrorKind::usage);
    Start other_grid;
    Mask mask{lumpy_volume({10, 10, 10})->geometry, std::vector<std::uint8_t>(1000, 1)};
    other_grid.from = MaskStart{std::make_shared<const Mask>(mask), "small"};
    QCOMPARE(level_set.begin(other_grid).error().kind, ErrorKind::usage);
    QVERIFY(Seen(level_set) == before);
    QCOMPARE(undo_text(*document), std::string("evolution, 7 steps"));
  }

  void steps_back_lead_to_what_was_seen_data() { add_executors(); }
  void steps_back_lead_to_what_was_seen() {
    const auto document = begun_case(this_executor());
    LevelSet& level_set = document->level_set();
    std::vector<Seen> seen;
    const auto note = [&] { seen.emplace_back(level_set); };
    note();
    for (int step = 1; step <= 45; ++step) {
      run(level_set, 1);
      if (step == 20) {
        QCOMPARE(failure(level_set.set_parameters(with_target(level_set.parameters(), 800.0))), QString());
      }
      if (step == 30) {
        QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 4.0), Brush::erase)),
                 QString());
      }
      note();
    }
    for (const int target : {44, 40, 29, 21, 20, 3, 0}) {
      QCOMPARE(failure(level_set.step_back(level_set.step() - target)), QString());
      QCOMPARE(level_set.step(), std::int64_t{target});
      QVERIFY(Seen(level_set) == seen[static_cast<std::size_t>(target)]);
    }
    // And going on from there leads where it led.
    for (int i = 0; i < 4; ++i) QCOMPARE(failure(document->undo()), QString());
    QCOMPARE(level_set.step(), std::int64_t{29});
    QCOMPARE(failure(level_set.step_back(10)), QString());
    run(level_set, 1);
    QCOMPARE(failure(level_set.set_parameters(with_target(level_set.parameters(), 800.0))), QString());
    QVERIFY(Seen(level_set).phi == seen[20].phi);
    QCOMPARE(level_set.step(), std::int64_t{20});
  }

  void steps_back_cross_what_was_restored() {
    const auto document = begun_case();
    LevelSet& level_set = document->level_set();
    run(level_set, 20);
    QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 4.0), Brush::add)), QString());
    QCOMPARE(failure(document->undo()), QString());  // phi is put back at step 20
    run(level_set, 5);
    const Seen at_25(level_set);
    run(level_set, 6);
    QCOMPARE(failure(document->smooth_source(0.8)), QString());
    run(level_set, 6);
    QCOMPARE(failure(level_set.step_back(12)), QString());
    QVERIFY(Seen(level_set) == at_25);
    QCOMPARE(failure(level_set.step_back(10)), QString());
    const Seen at_15(level_set);
    QCOMPARE(failure(level_set.restart()), QString());
    QCOMPARE(level_set.smoothed_mm(), 0.0);
    run(level_set, 15);
    QVERIFY(Seen(level_set).phi == at_15.phi);
  }

  void a_cancelled_step_back_changes_nothing() {
    const auto document = begun_case();
    LevelSet& level_set = document->level_set();
    run(level_set, 30);
    QCOMPARE(failure(level_set.end_run()), QString());
    const Seen before(level_set);
    std::stop_source stop;
    stop.request_stop();
    QCOMPARE(level_set.step_back(3, {nullptr, stop.get_token()}).error().kind, ErrorKind::cancelled);
    QVERIFY(Seen(level_set) == before);
    QCOMPARE(undo_text(*document), std::string("evolution, 30 steps"));
  }

  void a_lost_gpu_gives_way_to_the_processor() {
    ExecutorOptions options;
    options.device = gpu::Device::create_headless({gpu::GlVersion::gl45, false}).value();
    const auto document = begun_case(ExecutorKind::compute, options);
    LevelSet& level_set = document->level_set();
    const Seen start(level_set);
    run(level_set, 6);
    options.device->lose_at_check(1);
    QVERIFY(!level_set.advance({.steps = 5}));
    QCOMPARE(failure(level_set.rebuild({}, ExecutorKind::host)), QString());
    QCOMPARE(level_set.executor().name(), std::string_view("host"));
    QVERIFY(Seen(level_set) == start);
  }

  void what_finds_no_room_leaves_everything_as_it_was() {
    const auto document = begun_case();
    LevelSet& level_set = document->level_set();
    run(level_set, 40);
    QCOMPARE(failure(level_set.restart()), QString());
    QCOMPARE(failure(document->smooth_source(0.5)), QString());
    QCOMPARE(failure(level_set.set_parameters(with_target(level_set.parameters(), 800.0))), QString());
    const Seen before(level_set);
    const std::string text = undo_text(*document);
    ExecutorOptions tight;
    tight.threads = 1;
    const MemoryReport memory = level_set.executor().memory();
    tight.memory_budget_bytes = (memory.state_bytes + memory.source_bytes) * 5 / 4;
    QCOMPARE(failure(level_set.change_executor(ExecutorKind::host, tight)), QString());
    // A point with other parameters, another source, and a surface everywhere.
    Recipe recipe = level_set.recipe();
    recipe.parameters.target = 900.0;
    recipe.events.clear();
    const Geometry& geometry = document->volume()->geometry;
    const std::vector<float> values(static_cast<std::size_t>(geometry.voxel_count()), 0.5F);
    const double band = level_set.executor().band();
    const auto everywhere = std::make_shared<const Field>(Field::from_dense(geometry, values, band));
    QCOMPARE(level_set.resume_from(recipe, everywhere).error().kind, ErrorKind::capability);
    QVERIFY(Seen(level_set) == before);
    QCOMPARE(undo_text(*document), text);
  }

  void restart_keeps_the_parameters_and_what_was_painted_before_the_first_step() {
    const auto document = begun_case();
    LevelSet& level_set = document->level_set();
    QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 4.0), Brush::add, 3)),
             QString());
    const std::vector<float> start = values_of(level_set);
    run(level_set, 12);
    QCOMPARE(failure(level_set.set_parameters(with_target(level_set.parameters(), 800.0))), QString());
    run(level_set, 12);
    QCOMPARE(failure(level_set.restart()), QString());
    QVERIFY(values_of(level_set) == start);
    QCOMPARE(level_set.step(), std::int64_t{0});
    QCOMPARE(level_set.parameters().target, 800.0);
    QCOMPARE(level_set.recipe().parameters.target, 800.0);
    QCOMPARE(level_set.recipe().events.size(), std::size_t{1});
  }

  void random_edits_undo_and_redo_follow_a_model_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<int>("seed");
    for (int seed = 1; seed <= 6; ++seed) {
      QTest::addRow("host, %d", seed) << int(ExecutorKind::host) << seed;
    }
    QTest::newRow("compute") << int(ExecutorKind::compute) << 7;
    QTest::newRow("stream") << int(ExecutorKind::stream) << 8;
  }
  void random_edits_undo_and_redo_follow_a_model() {
    QFETCH(int, seed);
    const auto document = begun_case(this_executor());
    LevelSet& level_set = document->level_set();
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto number = [&](int low, int high) {
      return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
    };
    std::vector<Seen> states{Seen(level_set)};  // the model: what was seen at each end of an entry
    std::size_t at = 0;
    const int rounds = this_executor() == ExecutorKind::host ? 60 : 16;
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
        const Brush brush = number(0, 2) == 0 ? Brush::erase : Brush::add;
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
    LevelSet& level_set = document->level_set();
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
    LevelSet& level_set = document->level_set();
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

  void entries_outlive_a_change_of_executor() {
    const auto document = begun_case();
    LevelSet& level_set = document->level_set();
    const Seen start(level_set);
    run(level_set, 10);
    QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 4.0), Brush::add)), QString());
    const Seen painted(level_set);
    QCOMPARE(failure(level_set.change_executor(ExecutorKind::stream, {})), QString());
    QCOMPARE(level_set.executor().name(), std::string_view("stream"));
    QVERIFY(Seen(level_set) == painted);
    QCOMPARE(failure(document->undo()), QString());
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(Seen(level_set) == start);
    QCOMPARE(failure(document->redo()), QString());
    QCOMPARE(failure(document->redo()), QString());
    QVERIFY(Seen(level_set) == painted);
  }

  void a_lost_context_costs_what_came_after_the_last_checkpoint_data() {
    QTest::addColumn<int>("kind");
    QTest::newRow("compute") << int(ExecutorKind::compute);
    QTest::newRow("stream") << int(ExecutorKind::stream);
  }
  void a_lost_context_costs_what_came_after_the_last_checkpoint() {
    ExecutorOptions options;
    options.device = gpu::Device::create_headless({gpu::GlVersion::gl45, false}).value();
    const auto document = begun_case(this_executor(), options);
    LevelSet& level_set = document->level_set();
    run(level_set, 6);
    QVERIFY(level_set.checkpoint());
    run(level_set, 4);
    QCOMPARE(failure(level_set.set_parameters(with_target(level_set.parameters(), 800.0), 9)), QString());
    const Seen last_known(level_set);
    run(level_set, 3);
    options.device->lose_at_check(1);
    QVERIFY(!level_set.advance({.steps = 5}));
    QVERIFY(options.device->lost());
    QCOMPARE(level_set.end_run().error().kind, ErrorKind::capability);
    options.device = gpu::Device::create_headless({gpu::GlVersion::gl45, false}).value();
    QCOMPARE(failure(level_set.rebuild(options)), QString());
    QVERIFY(Seen(level_set).phi == last_known.phi);
    QCOMPARE(level_set.parameters().target, 800.0);
    QCOMPARE(level_set.step(), std::int64_t{10});
    run(level_set, 5);
    QCOMPARE(failure(level_set.executor().validate()), QString());
    while (document->undo()) {
    }
    QVERIFY(!level_set.begun());
  }
};

QTEST_APPLESS_MAIN(HistoryTest)
#include "history_test.moc"
