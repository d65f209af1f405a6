// The pictures of a case as its views get them.
#include "engine/picture_feed.h"

#include <QElapsedTimer>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <atomic>
#include <thread>

#include "engine/case_runner.h"
#include "tests/engine/ball_case.h"
#include "tests/support/test_program.h"

namespace tidemark::test::picture_feed_test {
namespace {

constexpr int kPatience = 60000;  // ms
constexpr renderer::PictureSize kSmall{96, 80};

struct Fixture : BallCase {
  explicit Fixture(solver::ExecutorKind executor = solver::ExecutorKind::host, bool use_opengl = true)
      : BallCase(executor, use_opengl) {}

  [[nodiscard]] renderer::SliceView slice(renderer::SliceContent content) const {
    renderer::SliceView view;
    view.content = content;
    view.term = renderer::SpeedTerm::total;
    view.position_mm = middle();
    view.window = {50.0, 300.0};
    return view;
  }
};

}  // namespace

class PictureFeedTest : public QObject {
  Q_OBJECT

 private slots:
  void pictures_follow_the_surface_and_end_with_its_last_step_data() {
    QTest::addColumn<QByteArray>("executor");
    QTest::addColumn<QByteArray>("renderer");
    for (const char* renderer : {"host", "gl"}) {
      for (const char* executor : {"host", "compute", "stream"}) {
        QTest::addRow("%s drawn by %s", executor, renderer) << QByteArray(executor) << QByteArray(renderer);
      }
    }
  }
  void pictures_follow_the_surface_and_end_with_its_last_step() {
    QFETCH(QByteArray, executor);
    QFETCH(QByteArray, renderer);
    const Variable asked("TIDEMARK_RENDERER", renderer);
    Fixture fixture(*solver::executor_named(executor.toStdString()));
    fixture.begin();
    engine::PictureFeed feed(fixture.proxy);
    const engine::AnyView view = fixture.slice(renderer::SliceContent::source);
    feed.request(view, kSmall);
    QTRY_VERIFY_WITH_TIMEOUT(feed.shown().number > 0, kPatience);
    QVERIFY(feed.shown().view == view);
    QCOMPARE(feed.shown().step, 0);
    const std::int64_t copies = fixture.proxy.runner()->painter().phi_copies();
    fixture.proxy.set_pause_at_convergence(false);
    fixture.proxy.set_steps_per_picture(1);
    fixture.proxy.play();
    QTRY_VERIFY_WITH_TIMEOUT(feed.shown().number >= 10 && feed.shown().step >= 5, kPatience);
    fixture.proxy.pause();
    fixture.wait_until_idle();
    QCOMPARE(feed.shown().step, fixture.proxy.state().step);
    // Pages are drawn where they are, unless one of the two works on the GPU and the other on the processor.
    const bool copied = fixture.proxy.runner()->painter().phi_copies() > copies;
    QCOMPARE(copied, (executor == "host") != (renderer == "host"));
    QCOMPARE(fixture.proxy.runner()->painter().pages_uploaded() > 0, executor == "host" && renderer == "gl");
  }

  // Smoothing and another executor put phi elsewhere, and leave it as it is.
  void pictures_find_phi_where_it_has_gone_data() {
    QTest::addColumn<QByteArray>("renderer");
    for (const char* renderer : {"host", "gl"}) QTest::newRow(renderer) << QByteArray(renderer);
  }
  void pictures_find_phi_where_it_has_gone() {
    QFETCH(QByteArray, renderer);
    const Variable asked("TIDEMARK_RENDERER", renderer);
    Fixture fixture;
    fixture.begin(8.0);
    engine::PictureFeed feed(fixture.proxy);
    renderer::VolumeView view;
    const auto picture = [&] {
      view.camera.azimuth += 90.0;  // a view that is not there yet
      feed.request(view, kSmall);
      fixture.wait_until_idle();
      view.camera.azimuth -= 90.0;
      feed.request(view, kSmall);
      fixture.wait_until_idle();
      return feed.shown().image.copy();
    };
    const QImage before = picture();
    fixture.proxy.smooth_source(1.5);
    QTRY_COMPARE_WITH_TIMEOUT(fixture.proxy.state().smoothed_mm, 1.5, kPatience);
    fixture.wait_until_idle();
    QCOMPARE(picture(), before);
    for (const auto executor : {solver::ExecutorKind::reference, solver::ExecutorKind::stream}) {
      fixture.proxy.change_executor(executor);
      fixture.wait_until_idle();
      QCOMPARE(picture(), before);
    }
    // States keep the pages of the executor that made them.
    fixture.proxy.step(1);
    fixture.wait_until_idle();
    const QImage after = picture();
    QVERIFY(after != before);
    fixture.proxy.change_executor(solver::ExecutorKind::host);
    fixture.wait_until_idle();
    QCOMPARE(picture(), after);
    fixture.proxy.undo();
    fixture.wait_until_idle();
    QCOMPARE(picture(), before);
    QCOMPARE(fixture.failures, QStringList());
  }

  void the_speed_map_is_the_functions_that_drives_data() { add_executors(); }
  void the_speed_map_is_the_functions_that_drives() {
    Fixture fixture(this_executor());
    engine::PictureFeed feed(fixture.proxy);
    renderer::SliceView view = fixture.slice(renderer::SliceContent::speed);
    view.term = renderer::SpeedTerm::data;
    feed.request(view, kSmall);
    QTRY_VERIFY_WITH_TIMEOUT(feed.shown().number > 0, kPatience);
    fixture.wait_until_idle();
    const QImage of_tent = feed.shown().image.copy();
    document::Drive drive = fixture.proxy.drive();
    drive.setting.terms = {{"edges", {}}};
    fixture.proxy.set_drive(drive);
    QTRY_VERIFY_WITH_TIMEOUT(fixture.proxy.state().speed && !fixture.proxy.state().speed_waits, kPatience);
    QTRY_VERIFY_WITH_TIMEOUT(feed.shown().image != of_tent, kPatience);
    fixture.wait_until_idle();
    // Where nothing varies edges let the surface grow: orange, as in the corner of the picture.
    const QColor corner = feed.shown().image.pixelColor(kSmall.width / 2, 4);
    QVERIFY2(corner.red() > corner.blue() + 60, qPrintable(corner.name()));
    fixture.proxy.undo();
    QTRY_VERIFY_WITH_TIMEOUT(feed.shown().image == of_tent, kPatience);
    QVERIFY(fixture.failures.isEmpty());
  }

  // A drag asks for the next picture before the last one is there.
  void the_surface_moves_on_under_the_mouse_data() {
    QTest::addColumn<int>("unused");
    for (const char* what : {"camera", "paint", "parameters"}) QTest::newRow(what) << 0;
  }
  void the_surface_moves_on_under_the_mouse() {
    const QString what = QTest::currentDataTag();
    Fixture fixture;
    fixture.begin();
    engine::PictureFeed volume(fixture.proxy);
    engine::PictureFeed slice(fixture.proxy);
    renderer::VolumeView view;
    solver::Parameters parameters = fixture.proxy.parameters();
    const std::uint64_t gesture = engine::CaseProxy::new_gesture();
    int moves = 0;
    const auto move = [&] {
      ++moves;
      if (what == "camera") {
        view.camera.azimuth += 1.0;
      } else if (what == "paint") {
        fixture.proxy.paint({fixture.middle() + glm::dvec3(0.1 * (moves % 50), 0.0, 0.0), 3.0},
                            solver::Brush::add, gesture);
      } else {
        parameters.target = 100.0 + 0.1 * (moves % 50);
        fixture.proxy.set_parameters(parameters, gesture);
      }
      volume.request(view, {256, 256});
    };
    volume.request(view, {256, 256});
    slice.request(fixture.slice(renderer::SliceContent::speed), kSmall);
    QTRY_VERIFY_WITH_TIMEOUT(volume.shown().number > 0 && slice.shown().number > 0, kPatience);
    fixture.proxy.set_pause_at_convergence(false);
    fixture.proxy.set_steps_per_picture(1);
    fixture.proxy.play();
    QTRY_VERIFY_WITH_TIMEOUT(fixture.proxy.state().playing, kPatience);
    QTimer mouse;
    connect(&mouse, &QTimer::timeout, move);
    mouse.start(1);
    const std::uint64_t drawn = volume.shown().number;
    const std::uint64_t sliced = slice.shown().number;
    const std::int64_t step = fixture.proxy.state().step;
    QTRY_VERIFY_WITH_TIMEOUT(volume.shown().number >= drawn + 20, kPatience);
    mouse.stop();
    const std::int64_t steps = fixture.proxy.state().step - step;
    const auto slices = static_cast<std::int64_t>(slice.shown().number - sliced);
    qInfo("%d moves of the mouse, 20 pictures of the volume, %lld of the slice, %lld steps", moves,
          static_cast<long long>(slices), static_cast<long long>(steps));
    QVERIFY(steps >= 15);
    QVERIFY(slices >= 15);
    fixture.proxy.pause();
    fixture.wait_until_idle();
    QCOMPARE(volume.shown().view, engine::AnyView(view));
    QCOMPARE(volume.shown().step, fixture.proxy.state().step);
  }

  void without_opengl_there_are_steps_and_pictures() {
    Fixture fixture(solver::ExecutorKind::host, false);
    fixture.begin();
    engine::PictureFeed slice(fixture.proxy);
    slice.request(fixture.slice(renderer::SliceContent::source), kSmall);
    engine::PictureFeed volume(fixture.proxy);
    volume.request(renderer::VolumeView(), kSmall);
    fixture.proxy.step(5);
    fixture.wait_until_idle();
    QCOMPARE(fixture.proxy.state().step, 5);
    for (const engine::PictureFeed* feed : {&slice, &volume}) {
      const engine::ShownPicture& shown = feed->shown();
      QVERIFY(shown.finished);
      QCOMPARE(shown.step, 5);
      QCOMPARE(shown.image.size(), QSize(static_cast<int>(kSmall.width), static_cast<int>(kSmall.height)));
      // The ball, and what is around it.
      QVERIFY(shown.image.pixel(kSmall.width / 2, kSmall.height / 2) != shown.image.pixel(0, 0));
    }
    std::optional<renderer::Hit> hit;
    fixture.proxy.pick(renderer::VolumeView(), kSmall, nullptr, {kSmall.width / 2, kSmall.height / 2},
                       [&](std::optional<renderer::Hit> found) { hit = found; });
    fixture.wait_until_idle();
    QVERIFY(hit && hit->kind == renderer::Hit::Kind::surface);
    QCOMPARE(fixture.failures, QStringList());
  }

  // The processor draws in tiles: a command waits for some of them, and for no whole picture.
  void a_picture_that_is_refined_makes_room_for_a_command() {
    const Variable renderer("TIDEMARK_RENDERER", "host");
    Fixture fixture;
    fixture.begin(10.0);
    engine::PictureFeed feed(fixture.proxy);
    constexpr renderer::PictureSize kLarge{900, 900};
    constexpr int kHostRounds = 3;  // HostRenderer::still_rounds()
    feed.request(renderer::VolumeView(), kLarge);
    QElapsedTimer since;
    since.start();
    QTRY_VERIFY_WITH_TIMEOUT(feed.shown().finished, kPatience);
    const double round_ms = static_cast<double>(since.elapsed()) / kHostRounds;
    double longest_ms = 0.0;
    for (int turn = 0; turn < 3; ++turn) {
      const std::uint64_t number = feed.shown().number;
      renderer::VolumeView view;
      view.camera.azimuth = 10.0 * (turn + 1);
      feed.request(view, kLarge);
      QTRY_VERIFY_WITH_TIMEOUT(feed.shown().number > number, kPatience);  // the moving one
      QTest::qWait(static_cast<int>(0.2 * round_ms));
      std::atomic<bool> done{false};
      since.restart();
      fixture.proxy.runner()->post([&](engine::CaseRunner&, const Progress&) -> Status {
        done = true;
        return {};
      });
      while (!done && since.elapsed() < kPatience) std::this_thread::yield();
      longest_ms = std::max(longest_ms, static_cast<double>(since.nsecsElapsed()) / 1e6);
      QVERIFY(!feed.shown().finished);
    }
    fixture.wait_until_idle();
    qInfo("a round takes %.0f ms, a command waited for %.1f ms at most", round_ms, longest_ms);
    QVERIFY(longest_ms < 0.5 * round_ms);
    QTRY_VERIFY_WITH_TIMEOUT(feed.shown().finished, kPatience);
    QCOMPARE(feed.shown().image.width(), static_cast<int>(kLarge.width));
  }
};

TIDEMARK_TEST(PictureFeedTest)

}  // namespace tidemark::test::picture_feed_test

#include "picture_feed_test.moc"
