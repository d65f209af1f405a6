// How good the next picture is to be. Needs no OpenGL, apart from those of means.
#include <QTest>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "renderer/gl/canvas_mean.h"
#include "renderer/quality_control.h"
#include "renderer/view_setup.h"
#include "tests/renderer/scenes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::quality_control_test {

// The width of the next moving picture of 512 x 512. One of half that a side takes `seconds`, and others by
// that power of their pixels.
std::int64_t draw_moving(renderer::QualityControl& control, double seconds, double power) {
  control.moved();
  const renderer::Pass pass = *control.next({512, 512});
  const double share = static_cast<double>(pass.size.width * pass.size.height) / (256.0 * 256.0);
  control.drawn(pass, seconds * std::pow(share, power));
  return pass.size.width;
}

// Seconds that a moving picture may take whose sides are divided by that.
double budget_of(std::int64_t divisor) {
  return divisor == 2 ? 0.0495 : renderer::QualityControl::kInteractive;
}

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
          QVERIFY2(seconds <= budget_of(full.width / pass.size.width), qPrintable(QString::number(seconds)));
      }
      // As fine as the budget allows.
      control.moved();
      const renderer::PictureSize size = control.next(full)->size;
      const std::int64_t divisor = full.width / size.width;
      const double finer =
          pixel_seconds * 1000.0 * 800.0 / static_cast<double>((divisor - 1) * (divisor - 1));
      QVERIFY(divisor == 1 || finer > budget_of(divisor - 1));
    }
  }

  void half_the_resolution_is_kept_down_to_twenty_pictures_a_second() {
    const auto width_for = [](double seconds) {
      renderer::QualityControl control;
      for (int i = 0; i < 3; ++i) draw_moving(control, seconds, 1.0);
      return draw_moving(control, seconds, 1.0);
    };
    QCOMPARE(width_for(0.040), 256);
    QCOMPARE(width_for(0.049), 256);
    QCOMPARE(width_for(0.055), 170);
  }

  // A pixel of a smaller picture takes longer than one of a larger, which is found out and kept.
  void the_size_settles_where_it_fits() {
    renderer::QualityControl control;
    const auto width_of_next = [&](double seconds) { return draw_moving(control, seconds, 0.75); };
    QCOMPARE(width_of_next(0.040), 128);
    QCOMPARE(width_of_next(0.040), 170);
    for (int i = 0; i < 20; ++i) QCOMPARE(width_of_next(0.040), 256);
    // Another view, of which pixels take twice as long.
    for (int i = 0; i < 5; ++i) width_of_next(0.080);
    for (int i = 0; i < 20; ++i) QCOMPARE(width_of_next(0.080), 128);
    for (int i = 0; i < 10; ++i) width_of_next(0.040);
    for (int i = 0; i < 20; ++i) QCOMPARE(width_of_next(0.040), 256);
  }

  void one_slow_picture_does_not_make_the_next_ones_coarse_for_good() {
    renderer::QualityControl control;
    const auto width_of_next = [&](double seconds) { return draw_moving(control, seconds, 1.0); };
    QCOMPARE(width_of_next(0.040), 128);
    QCOMPARE(width_of_next(0.040), 256);
    QCOMPARE(width_of_next(0.075), 256);  // something else was busy
    for (int i = 0; i < 4; ++i) width_of_next(0.040);
    for (int i = 0; i < 10; ++i) QCOMPARE(width_of_next(0.040), 256);
  }

  void a_pixel_is_uneven_beside_another_that_differs() {
    renderer::Picture picture{5, 4, std::vector<std::uint8_t>(4 * 5 * 4, 100)};
    QVERIFY(
        std::ranges::none_of(renderer::uneven_pixels(picture, 8), [](std::uint8_t one) { return one != 0; }));
    picture.pixels[4 * (5 * 2 + 4) + 1] = 109;  // green of the last pixel of the third row
    picture.pixels[4 * (5 * 0 + 0)] = 108;      // red of the first one: no more than it may
    picture.pixels[4 * (5 * 0 + 1) + 3] = 0;    // opacity is no colour
    const auto uneven = renderer::uneven_pixels(picture, 8);
    QCOMPARE(uneven, (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1}));
  }

  // Only uneven pixels get another ray, and nobody sees a difference.
  void the_processor_leaves_even_pixels_out_of_further_rounds() {
    Painter draw(ball_scene(grid({48, 48, 48}), 12.0), renderer::RendererKind::host);
    renderer::VolumeView view;
    constexpr renderer::PictureSize kSize{96, 96};
    renderer::PictureMean all;
    renderer::PictureMean some;
    for (int round = 0; round < 4; ++round) {
      view.quality.round = round;
      all.add(draw(view, kSize.width, kSize.height));
      QCOMPARE(failure(draw.renderer().add_round(view, kSize, some, {})), QString());
    }
    QCOMPARE(some.count(), 4);
    const renderer::Picture by_all = all.mean();
    const renderer::Picture by_some = some.mean();
    std::size_t differing = 0;
    for (std::size_t i = 0; i < by_all.pixels.size(); ++i) {
      const int difference = std::abs(int{by_all.pixels[i]} - int{by_some.pixels[i]});
      QVERIFY2(difference <= 6, qPrintable(QString::number(difference)));
      differing += difference > 0 ? 1 : 0;
    }
    QVERIFY(differing > 0);  // some were left out
  }

  // A surface that plays leaves a picture less time than a user does who turns it.
  void a_picture_keeps_to_the_seconds_that_it_is_given() {
    renderer::QualityControl control;
    constexpr double kPixel = 0.001 / (128.0 * 128.0);
    const auto width_within = [&](double seconds) {
      control.moved();
      const renderer::Pass pass = *control.next({512, 512}, 3, seconds);
      control.drawn(pass, kPixel * static_cast<double>(pass.size.width * pass.size.height));
      return static_cast<int>(pass.size.width);
    };
    for (int i = 0; i < 5; ++i) width_within(renderer::QualityControl::kInteractive);
    QCOMPARE(width_within(renderer::QualityControl::kInteractive), 512);
    QCOMPARE(width_within(renderer::QualityControl::kPlaying), 256);
    QCOMPARE(width_within(0.001), 128);
    QCOMPARE(width_within(renderer::QualityControl::kInteractive), 512);
  }

  // What was kept from the last picture takes time that is not its painted pixels'.
  void a_picture_that_was_kept_for_the_most_part_makes_none_coarser() {
    renderer::QualityControl control;
    constexpr double kPixel = 0.040 / (256.0 * 256.0);
    const auto width_after = [&](double pixel_seconds, double painted) {
      control.moved();
      const renderer::Pass pass = *control.next({512, 512});
      const auto pixels = static_cast<double>(pass.size.width * pass.size.height);
      control.drawn(pass, pixel_seconds * painted * pixels, painted);
      control.moved();
      return static_cast<int>(control.next({512, 512})->size.width);
    };
    for (int i = 0; i < 4; ++i) width_after(kPixel, 1.0);
    QCOMPARE(width_after(kPixel, 1.0), 256);
    for (int i = 0; i < 20; ++i) QCOMPARE(width_after(50.0 * kPixel, 0.02), 256);
    QCOMPARE(width_after(0.0, 0.0), 256);  // nothing changed
    int width = 0;
    for (int i = 0; i < 20; ++i) width = width_after(0.1 * kPixel, 0.02);
    QCOMPARE(width, 512);
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

  // So that their mean is the pixel's, wherever an edge crosses it.
  void rays_of_three_and_of_nine_rounds_are_spread_over_a_pixel_evenly() {
    QVERIFY(renderer::offset_of_round(0) == glm::dvec2(0.0));
    for (const int rounds : {3, 9}) {
      std::set<int> columns;
      std::set<int> rows;
      glm::dvec2 sum(0.0);
      for (int round = 0; round < rounds; ++round) {
        const glm::dvec2 offset = renderer::offset_of_round(round);
        columns.insert(static_cast<int>(rounds * (offset.x + 0.5)));
        rows.insert(static_cast<int>(rounds * (offset.y + 0.5)));
        sum += offset;
      }
      QCOMPARE(columns.size(), static_cast<std::size_t>(rounds));
      QCOMPARE(rows.size(), static_cast<std::size_t>(rounds));
      QVERIFY(*columns.begin() == 0 && *rows.begin() == 0);
      QVERIFY(glm::length(sum) < 1e-12);
    }
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
