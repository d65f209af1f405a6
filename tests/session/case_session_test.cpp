// A case on the engine without any widget: told what to do, it answers with states and pictures.
#include "session/case_session.h"

#include <QTest>
#include <QTimer>
#include <cmath>

#include "session/case_runner.h"
#include "session/picture_feed.h"
#include "tests/session/ball_study.h"
#include "tests/support/test_program.h"

namespace tidemark::test {
namespace {

constexpr int kPatience = 60000;  // ms
constexpr PictureSize kSmall{96, 80};

class Rig {
 public:
  explicit Rig(ExecutorKind executor = ExecutorKind::host, bool use_opengl = true)
      : engine(use_opengl), session(engine, ball_study(), executor) {
    QObject::connect(&session, &CaseSession::failed, [this](const QString& why) { failures += why; });
    settle();
  }

  [[nodiscard]] glm::dvec3 middle() const { return middle_of(session.volume().geometry); }
  void begin(double radius_mm = 4.0) {
    Start start;
    start.seeds.push_back({middle(), radius_mm});
    session.begin(start);
    settle();
  }
  void settle() {
    static_cast<void>(QTest::qWaitFor([this] { return engine.idle(); }, kPatience));
    QCoreApplication::processEvents();
  }
  [[nodiscard]] SliceView slice(SliceContent content) const {
    SliceView view;
    view.content = content;
    view.term = SpeedTerm::total;
    view.position_mm = middle();
    view.window = {50.0, 300.0};
    return view;
  }

  Engine engine;
  CaseSession session;
  QStringList failures;
};

ExecutorKind executor_of_row() {
  return *executor_named(QTest::currentDataTag());
}

void add_executors() {
  QTest::addColumn<int>("unused");
  for (const char* name : {"host", "compute", "stream"}) QTest::newRow(name) << 0;
}

}  // namespace

class CaseSessionTest : public QObject {
  Q_OBJECT

 private slots:
  void a_surface_that_plays_comes_to_rest_on_the_ball_data() { add_executors(); }
  void a_surface_that_plays_comes_to_rest_on_the_ball() {
    Rig rig(executor_of_row());
    QVERIFY(!rig.session.state().begun);
    rig.begin();
    QVERIFY(rig.session.state().begun);
    QCOMPARE(rig.session.state().executor, QString(QTest::currentDataTag()));
    rig.session.play();
    QTRY_VERIFY_WITH_TIMEOUT(rig.session.state().converged, kPatience);
    QVERIFY(!rig.session.state().playing);
    rig.settle();
    const double ball_ml = 4.0 / 3.0 * M_PI * std::pow(kBallRadius, 3) / 1000.0;
    const double found_ml = rig.session.state().surface.volume_ml;
    QVERIFY2(std::abs(found_ml - ball_ml) < 0.04 * ball_ml, qPrintable(QString::number(found_ml)));
    QCOMPARE(rig.failures, QStringList());
  }

  void pictures_follow_the_surface_and_end_with_its_last_step_data() { add_executors(); }
  void pictures_follow_the_surface_and_end_with_its_last_step() {
    Rig rig(executor_of_row());
    rig.begin();
    PictureFeed feed(rig.session);
    const AnyView view = rig.slice(SliceContent::source);
    feed.request(view, kSmall);
    QTRY_VERIFY_WITH_TIMEOUT(feed.shown().number > 0, kPatience);
    QVERIFY(feed.shown().view == view);
    QCOMPARE(feed.shown().step, 0);
    const std::int64_t copies = rig.session.runner()->painter().phi_copies();
    rig.session.set_pause_at_convergence(false);
    rig.session.set_steps_per_picture(1);
    rig.session.play();
    QTRY_VERIFY_WITH_TIMEOUT(feed.shown().number >= 10 && feed.shown().step >= 5, kPatience);
    rig.session.pause();
    rig.settle();
    QCOMPARE(feed.shown().step, rig.session.state().step);
    // An executor on the GPU has its pages drawn where they are.
    const bool copied = rig.session.runner()->painter().phi_copies() > copies;
    QCOMPARE(copied, executor_of_row() == ExecutorKind::host);
  }

  // Whoever drags asks for the next picture before the last one is there.
  void the_surface_moves_on_under_the_mouse_data() {
    QTest::addColumn<int>("unused");
    for (const char* what : {"camera", "paint", "parameters"}) QTest::newRow(what) << 0;
  }
  void the_surface_moves_on_under_the_mouse() {
    const QString what = QTest::currentDataTag();
    Rig rig;
    rig.begin();
    PictureFeed volume(rig.session);
    PictureFeed slice(rig.session);
    VolumeView view;
    Parameters parameters = rig.session.parameters();
    const std::uint64_t gesture = CaseSession::new_gesture();
    int moves = 0;
    const auto move = [&] {
      ++moves;
      if (what == "camera") {
        view.camera.azimuth += 1.0;
      } else if (what == "paint") {
        rig.session.paint({rig.middle() + glm::dvec3(0.1 * (moves % 50), 0.0, 0.0), 3.0}, Brush::add,
                          gesture);
      } else {
        parameters.target = 100.0 + 0.1 * (moves % 50);
        rig.session.set_parameters(parameters, gesture);
      }
      volume.request(view, {256, 256});
    };
    volume.request(view, {256, 256});
    slice.request(rig.slice(SliceContent::speed), kSmall);
    QTRY_VERIFY_WITH_TIMEOUT(volume.shown().number > 0 && slice.shown().number > 0, kPatience);
    rig.session.set_pause_at_convergence(false);
    rig.session.set_steps_per_picture(1);
    rig.session.play();
    QTRY_VERIFY_WITH_TIMEOUT(rig.session.state().playing, kPatience);
    QTimer mouse;
    connect(&mouse, &QTimer::timeout, move);
    mouse.start(1);
    const std::uint64_t drawn = volume.shown().number;
    const std::uint64_t sliced = slice.shown().number;
    const std::int64_t step = rig.session.state().step;
    QTRY_VERIFY_WITH_TIMEOUT(volume.shown().number >= drawn + 20, kPatience);
    mouse.stop();
    const std::int64_t steps = rig.session.state().step - step;
    const auto slices = static_cast<std::int64_t>(slice.shown().number - sliced);
    qInfo("%d moves of the mouse, 20 pictures of the volume, %lld of the slice, %lld steps", moves,
          static_cast<long long>(slices), static_cast<long long>(steps));
    QVERIFY(steps >= 15);
    QVERIFY(slices >= 15);
    rig.session.pause();
    rig.settle();
    QCOMPARE(volume.shown().view, AnyView(view));
    QCOMPARE(volume.shown().step, rig.session.state().step);
  }

  void without_opengl_there_are_steps_and_no_pictures() {
    Rig rig(ExecutorKind::host, false);
    rig.begin();
    PictureFeed feed(rig.session);
    feed.request(rig.slice(SliceContent::source), kSmall);
    rig.session.step(5);
    rig.settle();
    QCOMPARE(rig.session.state().step, 5);
    QCOMPARE(feed.shown().number, 0U);
    QCOMPARE(rig.failures, QStringList());
  }

  void what_is_done_can_be_taken_back_and_done_again() {
    Rig rig;
    rig.begin();
    rig.session.step(10);
    rig.settle();
    const double before = rig.session.state().surface.volume_ml;
    rig.session.paint({rig.middle() + glm::dvec3(6.0, 0.0, 0.0), 5.0}, Brush::add,
                      CaseSession::new_gesture());
    rig.settle();
    const double painted = rig.session.state().surface.volume_ml;
    QVERIFY(painted > 1.2 * before);
    rig.session.undo();
    rig.settle();
    QCOMPARE(rig.session.state().surface.volume_ml, before);
    QCOMPARE(rig.session.state().step, 10);
    QVERIFY(!rig.session.state().redo_text.isEmpty());
    rig.session.redo();
    rig.settle();
    QCOMPARE(rig.session.state().surface.volume_ml, painted);
  }

  void what_cannot_be_done_is_told_and_changes_nothing() {
    Rig rig;
    rig.begin();
    const CaseState before = rig.session.state();
    Start outside;
    outside.seeds.push_back({rig.middle() + glm::dvec3(1000.0, 0.0, 0.0), 3.0});
    rig.session.begin(outside);
    rig.settle();
    QCOMPARE(rig.failures.size(), 1);
    QVERIFY2(rig.failures.front().contains("is not in the volume"), qPrintable(rig.failures.front()));
    QVERIFY(rig.session.state().begun);
    QCOMPARE(rig.session.state().surface.volume_ml, before.surface.volume_ml);
  }

  void cases_in_lock_step_stand_at_the_same_step() {
    Rig rig;
    CaseSession other(rig.engine, ball_study(), ExecutorKind::host);
    Parameters smooth = other.parameters();
    smooth.alpha = 0.2;
    other.set_parameters(smooth);
    rig.begin();
    Start start;
    start.seeds.push_back({rig.middle(), 4.0});
    other.begin(start);
    rig.settle();
    CaseSession::play_in_lock_step({&rig.session, &other});
    rig.session.set_pause_at_convergence(false);
    other.set_pause_at_convergence(false);
    rig.session.play();
    QTRY_VERIFY_WITH_TIMEOUT(rig.session.state().step >= 20 && other.state().step >= 20, kPatience);
    rig.session.pause();
    rig.settle();
    QVERIFY(!other.state().playing);
    QCOMPARE(other.state().step, rig.session.state().step);
    CaseSession::play_in_lock_step({});
  }

  void a_session_that_goes_cancels_what_runs() {
    Engine engine(false);
    auto session = std::make_unique<CaseSession>(engine, ball_study(), ExecutorKind::host);
    session->begin({{}, {{middle_of(session->volume().geometry), 4.0}}, {}});
    session->set_pause_at_convergence(false);
    session->play();
    QTRY_VERIFY_WITH_TIMEOUT(session->state().playing && session->state().step > 0, kPatience);
    const std::weak_ptr<CaseRunner> runner = session->runner();
    session.reset();
    QTRY_VERIFY_WITH_TIMEOUT(engine.idle(), kPatience);
    QVERIFY(runner.expired());
  }
};

}  // namespace tidemark::test

TIDEMARK_TEST(tidemark::test::CaseSessionTest)
#include "case_session_test.moc"
