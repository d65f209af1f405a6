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

  void a_replay_and_a_step_back_change_the_executor_where_it_was_changed() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 20);
    const std::vector<float> at_20 = values_of(level_set);
    run(level_set, 20);
    QCOMPARE(failure(level_set.change_executor(solver::ExecutorKind::stream, {})), QString());
    run(level_set, 40);
    const document::Recipe all = level_set.recipe();
    QCOMPARE(all.executor.name, std::string("host"));
    QCOMPARE(all.final_executor().name, std::string("stream"));
    QVERIFY(again(all).events == all.events);
    QVERIFY(replayed(again(all), document->volume()) == values_of(level_set));
    // The one that was chosen goes on from what the other one has made.
    QCOMPARE(failure(level_set.step_back(60)), QString());
    QCOMPARE(level_set.executor().name(), std::string_view("stream"));
    QVERIFY(values_of(level_set) == at_20);
    run(level_set, 10);
    const std::vector<float> at_30 = values_of(level_set);
    QVERIFY(replayed(again(level_set.recipe()), document->volume()) == at_30);
    run(level_set, 5);
    QCOMPARE(failure(level_set.step_back(5)), QString());
    QVERIFY(values_of(level_set) == at_30);
    // Before the first step there is nothing to tell apart.
    QCOMPARE(failure(level_set.restart()), QString());
    run(level_set, 10);
    QCOMPARE(level_set.recipe().executor.name, std::string("stream"));
    QVERIFY(level_set.recipe().events.empty());
  }

  void a_recipe_on_another_executor_is_computed_by_that_alone() {
    const auto document = begun_case();
    document::LevelSet& level_set = document->level_set();
    run(level_set, 5);
    QCOMPARE(failure(level_set.change_executor(solver::ExecutorKind::stream, {})), QString());
    run(level_set, 5);
    const document::Recipe mixed = level_set.recipe();
    document::Recipe alone = mixed;
    alone.set_executor(mixed.executor);
    QCOMPARE(alone.final_executor().name, std::string("host"));
    document::EvolutionOptions on_host;
    on_host.executor = solver::ExecutorKind::host;
    const document::Evolution wanted = evolved(mixed, document->volume(), on_host);
    QCOMPARE(wanted.executor.name, std::string("host"));
    QVERIFY(wanted.phi.dense() == replayed(again(alone), document->volume()));
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

  void a_recipe_has_no_step_that_was_lost_where_another_executor_goes_on() {
    solver::ExecutorOptions options;
    options.device = gpu::Device::create_headless({gpu::GlVersion::gl45, false}).value();
    const auto document = begun_case(solver::ExecutorKind::compute, options);
    document::LevelSet& level_set = document->level_set();
    run(level_set, 10);
    QVERIFY(level_set.checkpoint());
    const Seen known(level_set);
    run(level_set, 3);
    options.device->lose_at_check(1);
    QVERIFY(!level_set.advance({.steps = 5}));
    QCOMPARE(level_set.end_run().error().kind, ErrorKind::capability);
    QCOMPARE(failure(level_set.change_executor(solver::ExecutorKind::host, {})), QString());
    QCOMPARE(level_set.executor().name(), std::string_view("host"));
    QCOMPARE(level_set.step(), std::int64_t{10});
    QVERIFY(Seen(level_set) == known);
    run(level_set, 5);
    QCOMPARE(level_set.recipe().steps, std::int64_t{15});
    while (document->undo()) {
    }
    QVERIFY(!level_set.begun());
  }
};

TIDEMARK_TEST(OtherExecutorTest)

}  // namespace tidemark::test::other_executor_test

#include "other_executor_test.moc"
