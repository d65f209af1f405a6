// How good the next picture is to be. Needs no OpenGL, apart from the last two tests.
#include <QTest>

#include "renderer/gl/canvas_mean.h"
#include "renderer/quality_control.h"
#include "tests/renderer/scenes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::quality_control_test {

class QualityControlTest : public QObject {
  Q_OBJECT

 private slots:
  void moving_pictures_keep_within_the_budget() {
    const renderer::PictureSize full{1000, 800};
    for (const double pixel_seconds : {1e-9, 5e-8, 1e-7, 3e-7}) {
      renderer::QualityControl control;
      for (int i = 0; i < 20; ++i) {
        control.moved();
        const renderer::Pass pass = *control.next(full);
        const double seconds = pixel_seconds * static_cast<double>(pass.size.width * pass.size.height);
        control.drawn(pass, seconds);
        if (i > 0)
          QVERIFY2(seconds <= renderer::QualityControl::kInteractive, qPrintable(QString::number(seconds)));
      }
      // As fine as the budget allows.
      control.moved();
      const renderer::PictureSize size = control.next(full)->size;
      const std::int64_t divisor = full.width / size.width;
      QVERIFY(divisor == 1 ||
              pixel_seconds * 1000.0 * 800.0 / static_cast<double>((divisor - 1) * (divisor - 1)) > 0.033);
    }
  }

  void however_slow_a_picture_is_it_is_not_smaller_than_a_fourth() {
    renderer::QualityControl control;
    for (int i = 0; i < 5; ++i) {
      control.moved();
      const renderer::Pass pass = *control.next({400, 400});
      QCOMPARE(pass.size.width, 100);
      control.drawn(pass, 1.0);
    }
  }

  void a_still_view_is_refined_until_it_is_finished() {
    renderer::QualityControl control;
    control.moved();
    control.drawn(*control.next({640, 480}), 0.01);
    std::vector<int> rounds;
    while (const auto pass = control.next({640, 480})) {
      QVERIFY(pass->size == (renderer::PictureSize{640, 480}));
      QVERIFY(!pass->quality.fast_gradient);
      rounds.push_back(pass->quality.round);
      control.drawn(*pass, 0.5);
      QVERIFY(rounds.size() < 100);
    }
    QCOMPARE(rounds.size(), std::size_t{renderer::QualityControl::kRounds});
    for (std::size_t i = 0; i < rounds.size(); ++i) QCOMPARE(rounds[i], static_cast<int>(i));
    control.moved();
    QVERIFY(control.next({640, 480})->quality.fast_gradient);
  }

  void a_view_that_moves_while_a_still_picture_is_drawn_gets_its_own() {
    renderer::QualityControl control;
    control.moved();
    control.drawn(*control.next({640, 480}), 1e-4);
    const renderer::Pass still = *control.next({640, 480});
    control.moved();
    control.drawn(still, 5.0);  // of the old view, and slow
    const renderer::Pass pass = *control.next({640, 480});
    QVERIFY(pass.moving);
    QCOMPARE(pass.size.width, 640);  // as fine as moving pictures were
  }

  void the_mean_of_rounds_has_smooth_edges_and_no_bands() {
    Painter draw(ball_scene(grid({48, 48, 48}), 12.0));
    renderer::VolumeView view;
    view.surface_colour = {1.0F, 1.0F, 1.0F, 1.0F};
    view.lighting.ambient = 1.0;
    view.lighting.diffuse = 0.0;
    view.lighting.specular = 0.0;
    view.background = glm::vec3(0.0F);
    renderer::PictureMean mean;
    for (int round = 0; round < renderer::QualityControl::kRounds; ++round) {
      view.quality.round = round;
      mean.add(draw(view, 96, 96));
    }
    QCOMPARE(mean.count(), renderer::QualityControl::kRounds);
    const auto between = [](glm::ivec3 c) { return c.r > 20 && c.r < 235; };
    view.quality.round = 0;
    QCOMPARE(count(draw(view, 96, 96), between), 0);
    QVERIFY(count(mean.mean(), between) > 60);
  }

  void the_mean_on_the_gpu_is_the_mean_of_the_pictures() {
    Painter draw(ball_scene(grid({48, 48, 48}), 12.0));
    auto canvas = renderer::Canvas::create(draw.device(), {96, 80}, gpu::TexelFormat::rgba8);
    auto on_gpu = renderer::CanvasMean::create(draw.device());
    QVERIFY(canvas && on_gpu);
    renderer::VolumeView view;
    renderer::PictureMean mean;
    // The second time it starts anew.
    for (int turn = 0; turn < 2; ++turn) {
      view.camera.azimuth += 40.0;
      mean.clear();
      on_gpu->clear();
      for (int round = 0; round < renderer::QualityControl::kRounds; ++round) {
        view.quality.round = round;
        QCOMPARE(failure(draw.gl().draw_on(*canvas, view)), QString());
        mean.add(*canvas->read());
        QCOMPARE(failure(on_gpu->replace_by_mean(draw.device(), *canvas)), QString());
        const renderer::Picture expected = mean.mean();
        const renderer::Picture got = *canvas->read();
        for (std::size_t i = 0; i < got.pixels.size(); ++i) {
          QVERIFY(std::abs(int{got.pixels[i]} - int{expected.pixels[i]}) <= 1);
        }
      }
    }
  }
};

TIDEMARK_TEST(QualityControlTest)

}  // namespace tidemark::test::quality_control_test

#include "quality_control_test.moc"
