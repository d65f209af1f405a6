// A case on the engine without any widget: told what to do, it answers with states and pictures.
#include "engine/case_proxy.h"

#include <QSignalSpy>
#include <QTest>
#include <cmath>
#include <future>
#include <new>

#include "engine/case_passes.h"
#include "engine/case_runner.h"
#include "engine/region_meter.h"
#include "tests/engine/ball_case.h"
#include "tests/support/test_program.h"

namespace tidemark::test::case_proxy_test {
namespace {

constexpr int kPatience = 60000;  // ms

struct Fixture : BallCase {
  explicit Fixture(solver::ExecutorKind executor = solver::ExecutorKind::host) : BallCase(executor, true) {}
};

// Two balls that play together.
void begin_in_lock_step(Fixture& fixture, engine::CaseProxy& other) {
  fixture.begin();
  document::Start start;
  start.seeds.push_back({fixture.middle(), 4.0});
  other.begin(start);
  fixture.wait_until_idle();
  engine::CaseProxy::play_in_lock_step({&fixture.proxy, &other});
}

// The engine does nothing else from its first job of that priority until the promise is kept.
void hold(engine::Engine& engine, engine::Priority priority, std::promise<void>& until) {
  engine.post(priority, nullptr,
              [done = until.get_future().share()](const std::stop_token&) { done.wait(); });
}

}  // namespace

class CaseProxyTest : public QObject {
  Q_OBJECT

 private slots:
  void a_surface_that_plays_comes_to_rest_on_the_ball_data() { add_executors(); }
  void a_surface_that_plays_comes_to_rest_on_the_ball() {
    Fixture fixture(this_executor());
    QVERIFY(!fixture.proxy.state().begun);
    fixture.begin();
    QVERIFY(fixture.proxy.state().begun);
    QCOMPARE(fixture.proxy.state().executor, QString(QTest::currentDataTag()));
    fixture.proxy.play();
    QTRY_VERIFY_WITH_TIMEOUT(fixture.proxy.state().converged, kPatience);
    QVERIFY(!fixture.proxy.state().playing);
    fixture.wait_until_idle();
    const double ball_ml = 4.0 / 3.0 * M_PI * std::pow(kBallRadius, 3) / 1000.0;
    const double found_ml = fixture.proxy.state().surface.volume_ml;
    QVERIFY2(std::abs(found_ml - ball_ml) < 0.04 * ball_ml, qPrintable(QString::number(found_ml)));
    QCOMPARE(fixture.failures, QStringList());
  }

  void a_case_goes_on_after_an_edit_that_was_cut_off() {
    Fixture fixture;
    fixture.begin();
    fixture.proxy.step(5);
    fixture.wait_until_idle();
    fixture.proxy.runner()->post([](engine::CaseRunner& runner, const Progress&) -> Status {
      static_cast<void>(runner.document().level_set().advance({.steps = 3}));
      throw std::bad_alloc();
    });
    fixture.wait_until_idle();
    QCOMPARE(fixture.failures, QStringList{"there is not enough memory"});
    fixture.proxy.play();
    QTRY_VERIFY_WITH_TIMEOUT(fixture.proxy.state().converged, kPatience);
    QCOMPARE(fixture.proxy.state().outcome, document::Outcome::converged);
    QCOMPARE(fixture.failures.size(), 1);
  }

  void a_surface_that_vanished_is_called_so() {
    Fixture fixture;
    solver::Parameters parameters = fixture.proxy.parameters();
    parameters.target = 900.0;
    fixture.proxy.set_parameters(parameters);
    fixture.begin();
    fixture.proxy.play();
    QTRY_VERIFY_WITH_TIMEOUT(fixture.proxy.state().converged, kPatience);
    QCOMPARE(fixture.proxy.state().outcome, document::Outcome::seeded_outside);
  }

  void a_sphere_beside_the_volume_begins_nothing() {
    BallCase fixture;
    fixture.proxy.paint({fixture.middle() + glm::dvec3(500.0, 0.0, 0.0), 4.0}, solver::Brush::add,
                        engine::CaseProxy::new_gesture());
    fixture.wait_until_idle();
    QCOMPARE(fixture.failures.size(), qsizetype{1});
    QVERIFY2(fixture.failures[0].contains("not in the volume"), qPrintable(fixture.failures[0]));
    QVERIFY(!fixture.proxy.state().begun);
    QVERIFY(fixture.proxy.state().undo_text.isEmpty());
    fixture.begin();
    // A stroke may leave the volume.
    fixture.proxy.paint({fixture.middle() + glm::dvec3(500.0, 0.0, 0.0), 4.0}, solver::Brush::add,
                        engine::CaseProxy::new_gesture());
    fixture.wait_until_idle();
    QCOMPARE(fixture.failures.size(), qsizetype{1});
  }

  void undo_takes_back_what_was_done_since_a_smoothing_was_asked_for() {
    BallCase fixture;
    fixture.begin();
    const std::vector<float> before = fixture.proxy.state().phi->dense();
    std::promise<void> go;
    hold(fixture.engine, engine::Priority::edit, go);
    fixture.proxy.smooth_source(1.5);
    fixture.proxy.paint({fixture.middle(), 9.0}, solver::Brush::add, engine::CaseProxy::new_gesture());
    fixture.proxy.undo();
    go.set_value();
    QTRY_COMPARE_WITH_TIMEOUT(fixture.proxy.state().smoothed_mm, 1.5, kPatience);
    fixture.wait_until_idle();
    QVERIFY(fixture.proxy.state().phi->dense() == before);
    QCOMPARE(fixture.failures, QStringList());
  }

  void what_is_done_can_be_taken_back_and_done_again() {
    Fixture fixture;
    fixture.begin();
    fixture.proxy.step(10);
    fixture.wait_until_idle();
    const double before = fixture.proxy.state().surface.volume_ml;
    fixture.proxy.paint({fixture.middle() + glm::dvec3(6.0, 0.0, 0.0), 5.0}, solver::Brush::add,
                        engine::CaseProxy::new_gesture());
    fixture.wait_until_idle();
    const double painted = fixture.proxy.state().surface.volume_ml;
    QVERIFY(painted > 1.2 * before);
    fixture.proxy.undo();
    fixture.wait_until_idle();
    QCOMPARE(fixture.proxy.state().surface.volume_ml, before);
    QCOMPARE(fixture.proxy.state().step, 10);
    QVERIFY(!fixture.proxy.state().redo_text.isEmpty());
    fixture.proxy.redo();
    fixture.wait_until_idle();
    QCOMPARE(fixture.proxy.state().surface.volume_ml, painted);
  }

  void what_cannot_be_done_is_told_and_changes_nothing() {
    Fixture fixture;
    fixture.begin();
    const engine::CaseState before = fixture.proxy.state();
    document::Start outside;
    outside.seeds.push_back({fixture.middle() + glm::dvec3(1000.0, 0.0, 0.0), 3.0});
    fixture.proxy.begin(outside);
    fixture.wait_until_idle();
    QCOMPARE(fixture.failures.size(), 1);
    QVERIFY2(fixture.failures.front().contains("is not in the volume"), qPrintable(fixture.failures.front()));
    QVERIFY(fixture.proxy.state().begun);
    QCOMPARE(fixture.proxy.state().surface.volume_ml, before.surface.volume_ml);
  }

  // A stroke that is under way when the preview is applied is not lost.
  void a_preview_of_other_labels_is_refused() {
    Fixture fixture;
    engine::CaseProxy& proxy = fixture.proxy;
    fixture.begin(8.0);
    proxy.accept_surface(0);
    fixture.wait_until_idle();
    QCOMPARE(proxy.state().labels.size(), std::size_t{1});
    const std::uint8_t id = proxy.state().labels.front().id;
    const auto now = [&] {
      return document::LabelVoxels{proxy.volume().geometry, proxy.state().labels, proxy.state().label_voxels,
                                   proxy.state().phi};
    };
    const auto one_voxel = [&](const Index3& voxel) {
      Region region(VoxelRange{voxel, voxel + Index3(1)});
      region.add(voxel);
      return document::LabelRegion{id, {}, region};
    };
    const auto finish = [&](const document::LabelVoxels& from) {
      proxy.finish_labels(std::make_shared<const std::vector<document::LabelRegion>>(1, one_voxel({3, 3, 3})),
                          document::Take::others_too, from);
    };
    const document::LabelVoxels before = now();
    proxy.brush_label(one_voxel({1, 1, 1}), document::Labels::Stroke::adds, document::Take::free_voxels);
    finish(before);
    fixture.wait_until_idle();
    QCOMPARE(fixture.failures.size(), 1);
    QVERIFY2(fixture.failures.front().contains("since the preview"), qPrintable(fixture.failures.front()));
    QVERIFY(now().region(id).contains({1, 1, 1}));
    finish(now());
    fixture.wait_until_idle();
    QCOMPARE(fixture.failures.size(), 1);
    QVERIFY(!now().region(id).contains({1, 1, 1}) && now().region(id).contains({3, 3, 3}));
  }

  void measures_are_gone_once_an_image_lies_elsewhere() {
    Fixture fixture;
    fixture.begin(8.0);
    auto image = std::make_shared<document::CaseImage>();
    image->name = "PET";
    image->volume = fixture.proxy.study().volume;
    engine::Display& display = fixture.proxy.display();
    display.change([&](engine::DisplaySettings& settings) {
      engine::ShownImage shown;
      shown.image = image;
      settings.images = {shown};
    });
    fixture.wait_until_idle();
    engine::RegionMeter& meter = fixture.proxy.region_meter();
    meter.begin(document::kTheSurface);
    QTRY_VERIFY_WITH_TIMEOUT(meter.measures(), kPatience);
    QCOMPARE(meter.measures()->images.size(), std::size_t{2});
    display.change([](engine::DisplaySettings& settings) { settings.images.front().opacity = 0.3; });
    QVERIFY(meter.measures());
    auto moved = std::make_shared<document::CaseImage>(*image);
    moved->to_case[3].x = 2.0;
    display.change([&](engine::DisplaySettings& settings) { settings.images.front().image = moved; });
    QVERIFY(!meter.measures());
  }

  // The state after an edit comes with phi before it: figures wait their turn.
  void measures_right_after_an_edit_are_of_the_surface_after_it() {
    BallCase fixture;
    fixture.begin(4.0);
    const engine::CaseState before = fixture.proxy.state();
    std::promise<void> edited;
    std::promise<void> measured;
    hold(fixture.engine, engine::Priority::edit, edited);
    fixture.proxy.paint({fixture.middle(), 9.0}, solver::Brush::add, engine::CaseProxy::new_gesture());
    hold(fixture.engine, engine::Priority::step, measured);
    edited.set_value();
    QTRY_VERIFY_WITH_TIMEOUT(fixture.proxy.state().edits > before.edits, kPatience);
    QCOMPARE(fixture.proxy.state().phi, before.phi);
    engine::RegionMeter& meter = fixture.proxy.region_meter();
    meter.begin(document::kTheSurface);
    measured.set_value();
    fixture.wait_until_idle();
    QTRY_VERIFY_WITH_TIMEOUT(!meter.busy(), kPatience);
    QVERIFY(meter.measures());
    QCOMPARE(meter.measures()->voxels, fixture.proxy.state().surface.voxels_inside);
    QVERIFY(meter.measures()->voxels > 2 * before.surface.voxels_inside);
  }

  void cases_in_lock_step_stand_at_the_same_step() {
    Fixture fixture;
    engine::CaseProxy other(fixture.engine, ball_study(), solver::ExecutorKind::host);
    solver::Parameters smooth = other.parameters();
    smooth.alpha = 0.2;
    other.set_parameters(smooth);
    begin_in_lock_step(fixture, other);
    fixture.proxy.set_pause_at_convergence(false);
    other.set_pause_at_convergence(false);
    fixture.proxy.play();
    QTRY_VERIFY_WITH_TIMEOUT(fixture.proxy.state().step >= 20 && other.state().step >= 20, kPatience);
    fixture.proxy.pause();
    fixture.wait_until_idle();
    QVERIFY(!other.state().playing);
    QCOMPARE(other.state().step, fixture.proxy.state().step);
    engine::CaseProxy::play_in_lock_step({});
  }

  // What was computed before it is published while it is carried out.
  void a_wish_stays_until_it_is_carried_out() {
    Fixture fixture;
    engine::CaseProxy other(fixture.engine, ball_study(), solver::ExecutorKind::host);
    begin_in_lock_step(fixture, other);
    fixture.proxy.set_pause_at_convergence(false);
    fixture.proxy.play();
    QTRY_VERIFY_WITH_TIMEOUT(fixture.proxy.state().playing, kPatience);
    solver::Parameters wanted = fixture.proxy.parameters();
    wanted.band = 4.0;
    fixture.proxy.set_parameters(wanted);
    int other_bands = 0;
    QObject::connect(&fixture.proxy, &engine::CaseProxy::state_changed, &fixture.proxy,
                     [&] { other_bands += fixture.proxy.parameters() == wanted ? 0 : 1; });
    QTRY_VERIFY_WITH_TIMEOUT(fixture.proxy.state().parameters == wanted, kPatience);
    fixture.wait_until_idle();
    QCOMPARE(other_bands, 0);
    QVERIFY(fixture.proxy.parameters() == wanted);
    engine::CaseProxy::play_in_lock_step({});
  }

  void one_without_a_surface_does_not_hold_the_others() {
    Fixture fixture;
    engine::CaseProxy other(fixture.engine, ball_study(), solver::ExecutorKind::host);
    fixture.begin();
    fixture.proxy.set_pause_at_convergence(false);
    fixture.proxy.step(5);
    fixture.wait_until_idle();
    engine::CaseProxy::play_in_lock_step({&fixture.proxy, &other});
    fixture.proxy.play();
    QTRY_VERIFY_WITH_TIMEOUT(fixture.proxy.state().step >= 100, kPatience);
    fixture.proxy.pause();
    fixture.wait_until_idle();
    QVERIFY(!fixture.proxy.state().playing);
    QVERIFY(!other.state().playing && !other.state().begun);
    engine::CaseProxy::play_in_lock_step({});
  }

  // A lesson plays one of them by itself.
  void a_case_that_leaves_the_others_does_not_hold_them() {
    Fixture fixture;
    engine::CaseProxy other(fixture.engine, ball_study(), solver::ExecutorKind::host);
    begin_in_lock_step(fixture, other);
    bool ended = false;
    other.play_for(3, false, [&](bool) { ended = true; });
    QTRY_VERIFY_WITH_TIMEOUT(ended, kPatience);
    QVERIFY(!other.in_lock_step());
    fixture.proxy.set_pause_at_convergence(false);
    fixture.proxy.play();
    QTRY_VERIFY_WITH_TIMEOUT(fixture.proxy.state().step >= 20, kPatience);
    fixture.proxy.pause();
    fixture.wait_until_idle();
    QCOMPARE(other.state().step, 3);
  }

  void a_case_that_cannot_be_opened_gives_up_and_says_so_to_all_who_wait() {
    engine::Engine engine(false);
    auto contents = std::make_shared<document::SessionContents>();
    contents->geometry.size = {5, 6, 7};  // not the study's
    engine::CaseProxy proxy(engine, ball_study(), solver::ExecutorKind::host, {contents, true});
    QStringList failures;
    connect(&proxy, &engine::CaseProxy::failed, this, [&](const QString& why) { failures << why; });
    const QSignalSpy given_up(&proxy, &engine::CaseProxy::given_up);
    QTRY_COMPARE_WITH_TIMEOUT(given_up.size(), 1, kPatience);
    QCOMPARE(failures.size(), 1);
    QVERIFY2(failures.front().contains("should be closed") && failures.front().contains("5 x 6 x 7"),
             qPrintable(failures.front()));
    bool answered = false;
    bool gave_up = false;
    bool over = false;
    proxy.take_snapshot(
        {}, [&](const auto&) { answered = true; }, [&] { gave_up = true; });
    proxy.after_commands([&] { over = true; });
    QTRY_VERIFY_WITH_TIMEOUT(over, kPatience);
    QVERIFY(gave_up && !answered);
    QTRY_VERIFY_WITH_TIMEOUT(!proxy.is_asked(), kPatience);
  }

  void a_case_is_asked_until_its_commands_are_over() {
    BallCase fixture;
    bool over = false;
    std::promise<void> go;
    hold(fixture.engine, engine::Priority::edit, go);
    QVERIFY(!fixture.proxy.is_asked());
    fixture.proxy.after_commands([&] { over = true; });
    QVERIFY(fixture.proxy.is_asked());
    go.set_value();
    QTRY_VERIFY_WITH_TIMEOUT(over, kPatience);
    QTRY_VERIFY_WITH_TIMEOUT(!fixture.proxy.is_asked(), kPatience);
  }

  void who_asks_a_case_that_cannot_go_on_is_answered() {
    engine::Engine engine(false);
    engine::CaseProxy proxy(engine, hopeless_study(), solver::ExecutorKind::host);
    std::optional<bool> reached;
    std::optional<ErrorKind> recorded;
    std::optional<ErrorKind> prepared;
    const auto kind_of = [](const auto& answer) {
      return answer ? ErrorKind::internal : answer.error().kind;
    };
    proxy.play_for(3, false, [&](bool all) { reached = all; });
    proxy.record_step(0, [&](const auto& answer) { recorded = kind_of(answer); });
    proxy.prepare_sweep([&](const auto& answer) { prepared = kind_of(answer); });
    QTRY_VERIFY_WITH_TIMEOUT(reached && recorded && prepared, kPatience);
    QVERIFY(!*reached);
    QCOMPARE(*recorded, ErrorKind::cancelled);
    QCOMPARE(*prepared, ErrorKind::cancelled);
  }

  void a_session_that_goes_cancels_what_runs() {
    engine::Engine engine(false);
    auto proxy = std::make_unique<engine::CaseProxy>(engine, ball_study(), solver::ExecutorKind::host);
    proxy->begin({{}, {{renderer::middle_of(proxy->volume().geometry), 4.0}}, {}});
    proxy->set_pause_at_convergence(false);
    proxy->play();
    QTRY_VERIFY_WITH_TIMEOUT(proxy->state().playing && proxy->state().step > 0, kPatience);
    const std::weak_ptr<engine::CaseRunner> runner = proxy->runner();
    proxy.reset();
    QTRY_VERIFY_WITH_TIMEOUT(engine.idle(), kPatience);
    QVERIFY(runner.expired());
  }
};

TIDEMARK_TEST(CaseProxyTest)

}  // namespace tidemark::test::case_proxy_test

#include "case_proxy_test.moc"
