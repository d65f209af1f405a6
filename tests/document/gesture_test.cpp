// A gesture, with the steps that are computed meanwhile, is one entry of the history.
#include "cases.h"
#include "tests/support/test_program.h"

namespace tidemark::test::gesture_test {

class GestureTest : public QObject {
  Q_OBJECT

 private slots:
  void a_gesture_with_its_steps_is_one_entry() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 10);
    QCOMPARE(failure(level_set.end_run()), QString());
    const Seen before(level_set);
    for (int i = 0; i < 4; ++i) {
      const solver::Sphere dab = ball_at(*document->volume(), {5.0 + i, 0, 0}, 3.0);
      QCOMPARE(failure(level_set.paint(dab, solver::Brush::add, 17)), QString());
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
    document::LevelSet& level_set = document->level_set();
    solver::Parameters parameters = level_set.parameters();
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
    document::LevelSet& level_set = document->level_set();
    const solver::Parameters parameters = level_set.parameters();
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
};

TIDEMARK_TEST(GestureTest)

}  // namespace tidemark::test::gesture_test

#include "gesture_test.moc"
