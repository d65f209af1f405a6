// The history as a tree: who goes back and on otherwise loses nothing, and every state is there again to the
// last bit.
#include <algorithm>
#include <map>
#include <random>

#include "cases.h"
#include "document/evolution.h"
#include "tests/document/recipes.h"
#include "tests/support/test_program.h"

namespace tidemark::test::history_tree_test {

namespace {

// A case's level set and labels.
struct SeenCase {
  Seen level_set;
  std::vector<document::Label> labels;
  std::vector<std::uint8_t> label_voxels;

  explicit SeenCase(const document::Case& document)
      : level_set(document.level_set()),
        labels(document.labels().list()),
        label_voxels(document.labels().voxels().voxels()) {}
  bool operator==(const SeenCase&) const = default;
};

document::History& after_run(document::Case& document, std::int64_t steps) {
  run(document.level_set(), steps);
  if (const Status ended = document.level_set().end_run(); !ended)
    qFatal("%s", ended.error().message.c_str());
  return document.history();
}

document::HistoryState state_of(const document::History& history, std::uint64_t id) {
  for (const document::HistoryState& state : history.states()) {
    if (state.id == id) return state;
  }
  qFatal("no such state");
}

// Of a size alone; counts how often it is asked for.
class SizedChange : public document::Change {
 public:
  SizedChange(std::int64_t bytes, std::int64_t* asked) : bytes_(bytes), asked_(asked) {}
  Status undo() override { return {}; }
  Status redo() override { return {}; }
  [[nodiscard]] std::int64_t bytes() const override {
    ++*asked_;
    return bytes_;
  }

 private:
  std::int64_t bytes_;
  std::int64_t* asked_;
};

// States of 1 to 9 bytes each on random branches.
document::History random_history(std::mt19937& random, int states, std::int64_t* asked) {
  document::History history;
  for (int n = 0; n < states; ++n) {
    const std::uint64_t most = history.states().back().id;
    if (random() % 3 == 0 && !history.go_to(random() % (most + 1))) qFatal("no such state");
    history.add({}, std::make_unique<SizedChange>(1 + random() % 9, asked));
  }
  return history;
}

std::vector<std::uint64_t> ids_of(const document::History& history) {
  std::vector<std::uint64_t> ids;
  for (const document::HistoryState& state : history.states()) ids.push_back(state.id);
  return ids;
}

// The end of a branch that is dropped first.
std::optional<std::uint64_t> farthest_end(const document::History& history) {
  const std::vector<document::HistoryState> states = history.states();
  std::optional<std::uint64_t> found;
  std::size_t most = 0;
  for (const document::HistoryState& state : states) {
    const bool is_end = std::none_of(states.begin(), states.end(), [&](const document::HistoryState& other) {
      return other.parent == state.id;
    });
    const std::size_t away = history.distance(history.last_state(), state.id);
    if (!is_end || !state.parent || away <= most) continue;
    most = away;
    found = state.id;
  }
  return found;
}

}  // namespace

class HistoryTreeTest : public QObject {
  Q_OBJECT

 private slots:
  void who_goes_back_and_on_otherwise_keeps_both() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    document::History& history = after_run(*document, 10);
    const std::uint64_t fork = history.position();
    const std::uint64_t first = after_run(*document, 20).position();
    const Seen seen_first(level_set);
    QCOMPARE(failure(history.go_to(fork)), QString());
    QCOMPARE(level_set.step(), std::int64_t{10});
    solver::Parameters smoother = level_set.parameters();
    smoother.alpha = 0.3;
    QCOMPARE(failure(level_set.set_parameters(smoother)), QString());
    const std::uint64_t second = after_run(*document, 7).position();
    const Seen seen_second(level_set);

    QCOMPARE(history.distance(first, second), std::size_t{3});
    QCOMPARE(failure(history.go_to(first)), QString());
    QVERIFY(Seen(level_set) == seen_first);
    QCOMPARE(history.position(), first);
    QCOMPARE(failure(history.go_to(second)), QString());
    QVERIFY(Seen(level_set) == seen_second);

    const document::HistoryState listed = state_of(history, second);
    QCOMPARE(listed.steering.step, std::int64_t{17});
    QVERIFY(listed.steering.parameters == smoother);
    QCOMPARE(document::describe(listed.change), std::string("evolution, 7 steps"));
    QCOMPARE(state_of(history, first).parent, std::optional(fork));
    QCOMPARE(state_of(history, *listed.parent).parent, std::optional(fork));
    QCOMPARE(history.states().front().steering.begun, false);
  }

  void redo_goes_to_the_branch_that_was_left_last() {
    const auto document = begun_case();
    document::History& history = after_run(*document, 10);
    const std::uint64_t fork = history.position();
    const std::uint64_t first = after_run(*document, 5).position();
    QCOMPARE(failure(history.undo()), QString());
    const std::uint64_t second = after_run(*document, 6).position();
    for (const std::uint64_t branch : {first, second, first}) {
      QCOMPARE(failure(history.go_to(branch)), QString());
      QCOMPARE(failure(history.undo()), QString());
      QCOMPARE(history.position(), fork);
      QCOMPARE(failure(history.redo()), QString());
      QCOMPARE(history.position(), branch);
      QCOMPARE(history.redo().error().kind, ErrorKind::usage);
    }
  }

  void phi_of_another_state_is_known_without_going_there() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    document::History& history = after_run(*document, 10);
    const std::uint64_t fork = history.position();
    const std::uint64_t first = after_run(*document, 5).position();
    const std::vector<float> phi = values_of(level_set);
    QCOMPARE(failure(history.go_to(fork)), QString());
    run(level_set, 12);  // and still runs
    const Seen before(level_set);
    QVERIFY(level_set.phi_at(first).dense() == phi);
    QVERIFY(Seen(level_set) == before);
    const auto running = history.open_state();
    QVERIFY(running.has_value());
    QCOMPARE(running->parent, std::optional(fork));
    QCOMPARE(running->steering.step, std::int64_t{22});
    QCOMPARE(running->id, history.position());
  }

  void a_state_that_is_not_there_is_refused() {
    const auto document = begun_case();
    document::History& history = after_run(*document, 4);
    const Seen before(document->level_set());
    QCOMPARE(history.go_to(99).error().kind, ErrorKind::usage);
    QVERIFY(Seen(document->level_set()) == before);
  }

  void any_way_through_the_tree_leads_to_the_same_bits_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<int>("seed");
    for (int seed = 1; seed <= 4; ++seed)
      QTest::addRow("host, %d", seed) << int(solver::ExecutorKind::host) << seed;
    QTest::newRow("compute") << int(solver::ExecutorKind::compute) << 5;
    QTest::newRow("stream") << int(solver::ExecutorKind::stream) << 6;
  }
  void any_way_through_the_tree_leads_to_the_same_bits() {
    QFETCH(int, seed);
    const auto document = begun_case(this_executor());
    document::History& history = document->history();
    std::mt19937 random(static_cast<unsigned>(seed));
    const auto number = [&](int low, int high) {
      return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
    };
    std::map<std::uint64_t, SeenCase> seen{{history.position(), SeenCase(*document)}};
    const int rounds = this_executor() == solver::ExecutorKind::host ? 70 : 20;
    for (int round = 0; round < rounds; ++round) {
      if (number(0, 1) == 0) {
        auto to = seen.begin();
        std::advance(to, number(0, static_cast<int>(seen.size()) - 1));
        QCOMPARE(failure(history.go_to(to->first)), QString());
        QVERIFY(SeenCase(*document) == to->second);
        continue;
      }
      QCOMPARE(failure(edit(*document, number)), QString());
      QCOMPARE(failure(history.close()), QString());
      const auto [known, added] = seen.try_emplace(history.position(), *document);
      QVERIFY(added || known->second == SeenCase(*document));
    }
    // Every state, from every other kind of place, and what led to it still computes it again.
    for (const auto& [id, state] : seen) {
      QCOMPARE(failure(history.go_to(id)), QString());
      QVERIFY(SeenCase(*document) == state);
    }
    QCOMPARE(failure(document->level_set().executor().validate()), QString());
    QVERIFY(replayed(again(document->level_set().recipe()), document->volume()) ==
            values_of(document->level_set()));
  }

  void the_farthest_branches_are_forgotten_first_and_never_the_way_here() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    document::History& history = document->history();
    const std::uint64_t start = history.position();
    const std::uint64_t far = after_run(*document, 10).position();
    const std::uint64_t farther = after_run(*document, 10).position();
    QCOMPARE(failure(history.go_to(start)), QString());
    const std::uint64_t way = after_run(*document, 5).position();
    const std::uint64_t here = after_run(*document, 5).position();
    const Seen seen(level_set);
    history.set_limit(history.bytes() - 1);
    QVERIFY(!history.has(farther));
    QVERIFY(history.has(far));
    history.set_limit(history.bytes() - 1);
    QVERIFY(!history.has(far));
    for (const std::uint64_t id : {start, way, here}) QVERIFY(history.has(id));
    QCOMPARE(failure(history.go_to(start)), QString());
    QVERIFY(!history.has(farther));
    QCOMPARE(failure(history.redo()), QString());
    QCOMPARE(history.position(), way);
    QCOMPARE(failure(history.go_to(here)), QString());
    QVERIFY(Seen(level_set) == seen);
    // Where nothing but the way is left, its oldest part goes.
    history.set_limit(1);
    QVERIFY(!history.has(start));
    QVERIFY(history.has(way) && history.has(here));
    QCOMPARE(failure(history.undo()), QString());
    QCOMPARE(history.undo().error().kind, ErrorKind::usage);
    QCOMPARE(level_set.step(), std::int64_t{5});
  }

  void states_are_dropped_in_the_order_of_their_distance() {
    std::mt19937 random(3);
    for (int round = 0; round < 20; ++round) {
      std::int64_t asked = 0;
      document::History history = random_history(random, 40, &asked);
      if (round % 2 == 0) QCOMPARE(failure(history.go_to(random() % 41)), QString());
      // As they go one by one.
      std::vector<std::vector<std::uint64_t>> left;
      std::vector<std::int64_t> bytes;
      document::History one_by_one = history;
      while (const auto end = farthest_end(one_by_one)) {
        one_by_one.set_limit(one_by_one.bytes() - 1);
        QVERIFY(!one_by_one.has(*end));
        left.push_back(ids_of(one_by_one));
        bytes.push_back(one_by_one.bytes());
      }
      // Several at once.
      for (std::size_t n = 0; n < bytes.size(); n += 3) {
        document::History at_once = history;
        at_once.set_limit(bytes[n]);
        QVERIFY(ids_of(at_once) == left[n]);
        QCOMPARE(at_once.bytes(), bytes[n]);
      }
      const std::uint64_t present = history.last_state();
      history.set_limit(0);
      QVERIFY(history.has(present) && history.states().size() <= 2);
    }
  }

  void dropping_many_states_asks_each_for_its_size_a_few_times() {
    std::int64_t asked = 0;
    document::History history;
    constexpr std::int64_t kStates = 400;
    for (std::int64_t n = 0; n < kStates; ++n) history.add({}, std::make_unique<SizedChange>(1, &asked));
    asked = 0;
    history.set_limit(10);
    QCOMPARE(history.states().size(), std::size_t{11});
    QVERIFY2(asked <= 3 * kStates, qPrintable(QString::number(asked)));
  }

  // Its function comes between two entries, when branches begin there already.
  void a_function_that_comes_late_takes_nothing_from_other_branches() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    document::History& history = document->history();
    const auto drive_of = [&](const char* term) {
      document::Drive drive = level_set.drive();
      drive.setting.terms = {{term, {}}};
      return drive;
    };
    const auto hand_over = [&] {
      const auto speed = document::make_speed(level_set.drive(), level_set.source(), level_set.parameters());
      QCOMPARE(failure(speed), QString());
      QCOMPARE(failure(level_set.set_speed(*speed)), QString());
    };
    QCOMPARE(failure(level_set.set_drive(drive_of("edges"))), QString());
    hand_over();
    QCOMPARE(failure(level_set.set_drive(drive_of("regions"))), QString());
    const std::uint64_t fork = history.position();
    // With the edges still, since the other function is not there yet.
    const std::uint64_t first = after_run(*document, 8).position();
    const document::Recipe recipe = level_set.recipe();
    QCOMPARE(failure(history.go_to(fork)), QString());
    hand_over();
    after_run(*document, 8);
    QVERIFY(!(level_set.recipe().events == recipe.events));
    QCOMPARE(failure(history.go_to(first)), QString());
    QVERIFY(level_set.recipe().events == recipe.events);
    QVERIFY(replayed(again(level_set.recipe()), document->volume()) == values_of(level_set));
  }

 private:
  template <class Number>
  static Status edit(document::Case& document, const Number& number) {
    document::LevelSet& level_set = document.level_set();
    const auto place = [&] {
      return ball_at(*document.volume(), glm::dvec3(number(-9, 9), number(-9, 9), number(-7, 7)),
                     number(2, 5));
    };
    switch (number(0, 7)) {
      case 0:
        return level_set.set_parameters(with_target(level_set.parameters(), number(700, 990) + 0.5));
      case 1:
        return level_set.step_back(number(1, 5));
      case 2:
        return level_set.paint(place(), number(0, 2) == 0 ? solver::Brush::erase : solver::Brush::add);
      case 3: {
        document::Drive drive = level_set.drive();
        auto walls = drive.constraints
                         ? std::make_shared<solver::Constraints>(*drive.constraints)
                         : std::make_shared<solver::Constraints>(document.volume()->geometry.size);
        walls->set(document.volume()->geometry, place(), solver::Constraint::wall);
        drive.constraints = std::move(walls);
        return level_set.set_drive(drive);
      }
      case 4: {
        const auto label = document.labels().add("label");
        if (!label) return pass_on(label);
        auto accepted = document.accept_surface(*label, document::Take::others_too);
        if (!accepted) return pass_on(accepted);
        return {};
      }
      case 5:
        return level_set.restart();
      default:
        run(level_set, number(1, 6));
        return level_set.end_run();
    }
  }
};

TIDEMARK_TEST(HistoryTreeTest)

}  // namespace tidemark::test::history_tree_test

#include "history_tree_test.moc"
