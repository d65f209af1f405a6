// A level set goes on elsewhere: on another executor, or after its GPU was lost.
#include "gpu/device.h"
#include "recipes.h"
#include "tests/support/test_program.h"

namespace tidemark::test::other_executor_test {

class OtherExecutorTest : public QObject {
  Q_OBJECT

 private slots:
  void entries_outlive_a_change_of_executor() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    const Seen start(level_set);
    run(level_set, 10);
    QCOMPARE(failure(level_set.paint(ball_at(*document->volume(), {6, 0, 0}, 4.0), solver::Brush::add)),
             QString());
    const Seen painted(level_set);
    QCOMPARE(failure(level_set.change_executor(solver::ExecutorKind::stream, {})), QString());
    QCOMPARE(level_set.executor().name(), std::string_view("stream"));
    QVERIFY(Seen(level_set) == painted);
    QCOMPARE(failure(document->undo()), QString());
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(Seen(level_set) == start);
    QCOMPARE(failure(document->redo()), QString());
    QCOMPARE(failure(document->redo()), QString());
    QVERIFY(Seen(level_set) == painted);
  }

  void a_lost_gpu_gives_way_to_the_processor() {
    solver::ExecutorOptions options;
    options.device = gpu::Device::create_headless({gpu::GlVersion::gl45, false}).value();
    const auto document = begun_case(solver::ExecutorKind::compute, options);
    document::LevelSet& level_set = document->level_set();
    const Seen start(level_set);
    run(level_set, 6);
    options.device->lose_at_check(1);
    QVERIFY(!level_set.advance({.steps = 5}));
    QCOMPARE(failure(level_set.rebuild({}, solver::ExecutorKind::host)), QString());
    QCOMPARE(level_set.executor().name(), std::string_view("host"));
    QVERIFY(Seen(level_set) == start);
  }

  void walls_of_a_gesture_hold_on_another_executor() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 10);
    QCOMPARE(failure(level_set.end_run()), QString());
    const Seen before(level_set);
    QCOMPARE(failure(level_set.set_drive(with_wall(*document, {1.3, -0.7, 0.4}, 3.0), 7)), QString());
    const std::vector<float> held = values_of(level_set);
    QVERIFY(held != before.phi);
    QCOMPARE(failure(level_set.rebuild({})), QString());
    QVERIFY(values_of(level_set) == held);
    const auto known = level_set.checkpoint();
    QCOMPARE(failure(known), QString());
    QVERIFY((*known)->dense() == held);
    QCOMPARE(failure(document->history().close()), QString());
    QCOMPARE(undo_text(*document), std::string("walls and anchors"));
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(values_of(level_set) == before.phi);
    QVERIFY(!level_set.drive().constraints);
    QCOMPARE(failure(document->redo()), QString());
    QVERIFY(values_of(level_set) == held);
  }

  void tents_have_the_parameters_of_a_gesture_on_another_executor() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    document::Drive joined;
    joined.setting.terms = {{"tent", {}}, {"edges", {}}};
    QCOMPARE(failure(level_set.set_drive(joined)), QString());
    const auto speed = document::make_speed(joined, level_set.source(), level_set.parameters());
    QCOMPARE(failure(speed), QString());
    QCOMPARE(failure(level_set.set_speed(*speed)), QString());
    run(level_set, 10);
    QCOMPARE(failure(level_set.end_run()), QString());
    QCOMPARE(failure(level_set.set_parameters(with_target(level_set.parameters(), 800.0), 7)), QString());
    QCOMPARE(failure(level_set.rebuild({})), QString());
    run(level_set, 10);
    QVERIFY(replayed(again(level_set.recipe()), document->volume()) == values_of(level_set));
  }

  void walls_whose_entry_was_lost_with_the_context_are_one_again() {
    solver::ExecutorOptions options;
    options.device = gpu::Device::create_headless({gpu::GlVersion::gl45, false}).value();
    const auto document = begun_case(solver::ExecutorKind::compute, options);
    document::LevelSet& level_set = document->level_set();
    run(level_set, 10);
    QCOMPARE(failure(level_set.end_run()), QString());
    const std::vector<float> before = values_of(level_set);
    QCOMPARE(failure(level_set.set_drive(with_wall(*document, {1.3, -0.7, 0.4}, 3.0), 7)), QString());
    const std::vector<float> held = values_of(level_set);
    options.device->lose_at_check(1);
    QVERIFY(!level_set.advance({.steps = 5}));
    QCOMPARE(level_set.end_run().error().kind, ErrorKind::capability);
    QCOMPARE(failure(level_set.rebuild({}, solver::ExecutorKind::host)), QString());
    QVERIFY(values_of(level_set) == held);
    QCOMPARE(undo_text(*document), std::string("walls and anchors"));
    QCOMPARE(failure(document->undo()), QString());
    QVERIFY(values_of(level_set) == before);
    QCOMPARE(failure(document->redo()), QString());
    QVERIFY(values_of(level_set) == held);
  }

  void a_lost_context_costs_what_came_after_the_last_checkpoint_data() {
    QTest::addColumn<int>("kind");
    QTest::newRow("compute") << int(solver::ExecutorKind::compute);
    QTest::newRow("stream") << int(solver::ExecutorKind::stream);
  }
  void a_lost_context_costs_what_came_after_the_last_checkpoint() {
    solver::ExecutorOptions options;
    options.device = gpu::Device::create_headless({gpu::GlVersion::gl45, false}).value();
    const auto document = begun_case(this_executor(), options);
    document::LevelSet& level_set = document->level_set();
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

TIDEMARK_TEST(OtherExecutorTest)

}  // namespace tidemark::test::other_executor_test

#include "other_executor_test.moc"
