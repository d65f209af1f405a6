// Steps back and restarts lead to what was seen there.
#include "cases.h"
#include "tests/support/test_program.h"

namespace tidemark::test::step_back_test {

class StepBackTest : public QObject {
  Q_OBJECT

 private slots:
  void steps_back_lead_to_what_was_seen_data() { add_executors(); }
  void steps_back_lead_to_what_was_seen() {
    const auto document = begun_case(this_executor());
    document::LevelSet& level_set = document->level_set();
    std::vector<Seen> seen;
    const auto note = [&] { seen.emplace_back(level_set); };
    note();
    for (int step = 1; step <= 45; ++step) {
      run(level_set, 1);
      if (step == 20) {
        QCOMPARE(failure(level_set.set_parameters(with_target(level_set.parameters(), 800.0))), QString());
      }
      if (step == 30) {
        QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 4.0), solver::Brush::erase)),
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
    document::LevelSet& level_set = document->level_set();
    run(level_set, 20);
    QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 4.0), solver::Brush::add)),
             QString());
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

  void what_a_wall_cut_and_paint_healed_before_the_first_step_stays_whole_data() { add_executors(); }
  void what_a_wall_cut_and_paint_healed_before_the_first_step_stays_whole() {
    const glm::dvec3 place{1.3, -0.7, 0.4};  // the middle of the seed
    for (const bool before_the_start : {false, true}) {
      const auto document = make_case(lumpy_volume(), this_executor());
      const Volume& volume = *document->volume();
      document::LevelSet& level_set = document->level_set();
      const document::Drive bare = level_set.drive();
      const document::Drive walled = with_wall(*document, place, 2.0);
      if (before_the_start) QCOMPARE(failure(level_set.set_drive(walled)), QString());
      QCOMPARE(failure(level_set.begin(seed_in(volume))), QString());
      if (!before_the_start) QCOMPARE(failure(level_set.set_drive(walled)), QString());
      QCOMPARE(failure(level_set.set_drive(bare)), QString());
      QCOMPARE(failure(level_set.paint(ball_at(volume, place, 4.0), solver::Brush::add)), QString());
      const std::vector<float> start = values_of(level_set);
      run(level_set, 2);
      const Seen at_2(level_set);
      run(level_set, 1);
      QCOMPARE(failure(level_set.step_back(1)), QString());
      QVERIFY(Seen(level_set) == at_2);
      QCOMPARE(failure(level_set.step_back(2)), QString());
      QVERIFY(values_of(level_set) == start);
    }
  }

  void a_cancelled_step_back_changes_nothing() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 30);
    QCOMPARE(failure(level_set.end_run()), QString());
    const Seen before(level_set);
    std::stop_source stop;
    stop.request_stop();
    QCOMPARE(level_set.step_back(3, {nullptr, stop.get_token()}).error().kind, ErrorKind::cancelled);
    QVERIFY(Seen(level_set) == before);
    QCOMPARE(undo_text(*document), std::string("evolution, 30 steps"));
  }

  void restart_keeps_the_parameters_and_what_was_painted_before_the_first_step() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 4.0), solver::Brush::add, 3)),
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
};

TIDEMARK_TEST(StepBackTest)

}  // namespace tidemark::test::step_back_test

#include "step_back_test.moc"
