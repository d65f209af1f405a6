// The source in 3D, through transfer functions.
#include <QTest>
#include <cmath>
#include <numbers>

#include "renderer/host/source_samples.h"
#include "tests/renderer/scenes.h"
#include "tests/support/test_program.h"

namespace tidemark::test::transfer_view_test {

namespace {

// White, unlit.
renderer::VolumeView plain_view(const char* json) {
  renderer::VolumeView view;
  view.surface = false;
  view.source = transfer_function(json);
  view.lighting.ambient = 1.0;
  view.lighting.diffuse = 0.0;
  view.lighting.specular = 0.0;
  view.background = glm::vec3(0.0F);
  return view;
}

}  // namespace

class TransferViewTest : public QObject {
  Q_OBJECT

 private slots:
  void a_slabs_opacity_is_the_analytic_one_for_any_step() {
    const Geometry geometry = grid({40, 20, 40}, {1.0, 1.5, 1.0});
    Painter draw(ball_scene(geometry, 5.0, [](glm::dvec3) { return 500.0; }));
    for (const double opacity : {0.01, 0.03, 0.1}) {
      renderer::VolumeView view = plain_view(
          R"({"source": [{"value": {"ramp": [100, 200]}, "opacity": 0.01, "colour": [1, 1, 1]}]})");
      view.source->source[0].opacity = opacity;
      const double expected = 255.0 * (1.0 - std::exp(-opacity * 30.0));
      for (const double step : {0.1, 0.5, 0.75, 1.0, 2.0, 7.0}) {
        view.quality.step_voxels = step;
        const double seen = pixel(draw(view, 64, 64), 32, 32).r;
        QVERIFY2(std::abs(seen - expected) <= 0.01 * expected + 0.5,
                 qPrintable(QString("step %1: %2, not %3").arg(step).arg(seen).arg(expected)));
      }
    }
  }

  void offsets_of_samples_taken_together_fit_32_bits() {
    QCOMPARE(renderer::longest_together({512, 512, 900}), 96.0F);
    QCOMPARE(renderer::longest_together({1, 1, 1}), 96.0F);
    constexpr double kMost = 2147483647.0;
    for (const int width : {4000, 5000, 7000, 10000, 13000}) {
      const double slice = static_cast<double>(width) * width;
      const double length = static_cast<double>(renderer::longest_together({width, width, 1000}));
      // What a kernel reads beside the samples: the voxels around the first and behind the last.
      const double slices = length + 10.0;
      QVERIFY2(slices * slice <= kMost, qPrintable(QString("%1: %2 voxels").arg(width).arg(length)));
      // Nor is it shorter than it has to be.
      QVERIFY2(length == 96.0 || (length + 14.0) * slice > kMost, qPrintable(QString::number(width)));
    }
  }

  void a_thin_gaussian_does_not_alias() {
    // The value rises by 10 a mm; a Gaussian of width 2 is 0.35 mm of it.
    const Geometry geometry = grid({40, 40, 40});
    Painter draw(ball_scene(geometry, 5.0, [](glm::dvec3 p) { return 10.0 * p.y; }));
    renderer::VolumeView view =
        plain_view(R"({"source": [{"value": {"gaussian": [197, 2]}, "opacity": 1, "colour": [1, 1, 1]}]})");
    const double expected = 255.0 * (1.0 - std::exp(-std::sqrt(std::numbers::pi) * 2.0 / 10.0));
    for (const double step : {0.2, 0.75, 1.5}) {
      view.quality.step_voxels = step;
      const renderer::Picture picture = draw(view, 64, 64);
      for (std::int64_t x = 16; x < 48; ++x) {
        const double seen = pixel(picture, x, 30).r;
        QVERIFY2(std::abs(seen - expected) < 0.02 * expected,
                 qPrintable(QString("%1, not %2").arg(seen).arg(expected)));
      }
    }
  }

  void the_gradient_is_an_axis() {
    // 5 a mm in the left half, 20 in the right one.
    const Geometry geometry = grid({40, 40, 40});
    Painter draw(ball_scene(geometry, 5.0, [](glm::dvec3 p) { return p.x < 20.0 ? 5.0 * p.z : 20.0 * p.z; }));
    const renderer::VolumeView view =
        plain_view(R"({"source": [{"gradient": {"ramp": [10, 15]}, "opacity": 1, "colour": [1, 1, 1]}]})");
    const renderer::Picture picture = draw(view, 64, 64);
    QCOMPARE(pixel(picture, 16, 32).r, 0);
    QVERIFY(pixel(picture, 48, 32).r > 250);
  }

  void phi_is_an_axis() {
    const Geometry geometry = grid({48, 48, 48});
    Painter draw(ball_scene(geometry, 12.0, [](glm::dvec3) { return 100.0; }));
    const renderer::VolumeView view =
        plain_view(R"({"source": [{"phi": {"ramp": [-0.5, 0.5]}, "opacity": 1, "colour": [1, 1, 1]}]})");
    const renderer::Picture picture = draw(view, 200, 200);
    const double side = 2.0 * view.camera.half_height_mm(geometry, 1.0) / 200.0;
    // Seen from where the ramp begins to where it is full.
    const double radius =
        side * std::sqrt(static_cast<double>(count(picture, is_surface)) / std::numbers::pi);
    QVERIFY2(radius > 12.0 && radius < 12.5, qPrintable(QString::number(radius)));
  }

  void the_surface_is_classified_by_intensity_and_distance_from_the_plane() {
    const Geometry geometry = grid({64, 64, 64});
    const Scene scene = ball_scene(geometry, 20.0, [](glm::dvec3 p) { return p.x < 31.5 ? 0.0 : 100.0; });
    Painter draw(scene);
    renderer::VolumeView view;
    view.source = transfer_function(
        R"({"surface": [{"intensity": {"ramp": [49, 51]}, "opacity": 1, "colour": [1, 0, 0]},
                        {"intensity": {"ramp": [51, 49]}, "opacity": 1, "colour": [0, 1, 0]}]})");
    renderer::Picture picture = draw(view, 100, 100);
    QVERIFY(pixel(picture, 30, 50).g > pixel(picture, 30, 50).r + 50);
    QVERIFY(pixel(picture, 70, 50).r > pixel(picture, 70, 50).g + 50);
    // Only what is within 5 mm of the plane, seen through what is not there.
    view.source = transfer_function(
        R"({"surface": [{"distance": {"ramp": [5.1, 5]}, "opacity": 1, "colour": [1, 1, 1]}]})");
    view.clip = renderer::ClipPlane{{0.0, 0.0, 1.0}, scene.middle.z};
    view.clip->picture = false;
    picture = draw(view, 100, 100);
    const double side = 2.0 * view.camera.half_height_mm(geometry, 1.0) / 100.0;
    const auto row = [&](double below_mm) { return std::lround(49.5 + below_mm / side); };
    QVERIFY(is_surface(pixel(picture, 50, row(2.5))));
    QVERIFY(!is_surface(pixel(picture, 50, row(8.0))));
    QVERIFY(!is_surface(pixel(picture, 50, row(-2.5))));
  }

  void a_region_of_interest_shows_one_side_only() {
    const Geometry geometry = grid({48, 48, 48});
    Painter draw(ball_scene(geometry, 12.0));
    renderer::VolumeView view =
        plain_view(R"({"source": [{"value": {"ramp": [-10, -5]}, "opacity": 1, "colour": [1, 1, 1]}]})");
    const double side = 2.0 * view.camera.half_height_mm(geometry, 1.0) / 200.0;
    const auto area = [&] {
      return static_cast<double>(count(draw(view, 200, 200), is_surface)) * side * side;
    };
    view.region = renderer::Region::inside;
    QVERIFY(std::abs(area() / (std::numbers::pi * 144.0) - 1.0) < 0.05);
    view.region = renderer::Region::everywhere;
    QVERIFY(std::abs(area() / (48.0 * 48.0) - 1.0) < 0.05);
    // Outside alone: little is left in front of and behind a ball that nearly fills the volume.
    Painter full(ball_scene(geometry, 40.0));
    view.region = renderer::Region::outside;
    QVERIFY(count(full(view, 200, 200), is_surface) < 200 * 200 / 10);
    // Tinted: everything shows, the inside in the surface's colour.
    view.region = renderer::Region::tinted;
    view.source->source[0].opacity = 0.02;
    view.surface_colour = {1.0F, 0.0F, 0.0F, 1.0F};
    const renderer::Picture tinted = draw(view, 200, 200);
    const glm::ivec3 middle = pixel(tinted, 100, 100);
    const glm::ivec3 corner = pixel(tinted, 20, 20);
    QVERIFY(middle.r > middle.g + 20 && std::abs(corner.r - corner.g) < 3);
  }

  void a_translucent_surface_shows_what_is_behind_it() {
    const Geometry geometry = grid({48, 48, 48});
    Painter draw(ball_scene(geometry, 12.0));
    renderer::VolumeView view;
    view.lighting.ambient = 1.0;
    view.lighting.diffuse = 0.0;
    view.lighting.specular = 0.0;
    view.background = glm::vec3(0.0F);
    view.surface_colour = {1.0F, 1.0F, 1.0F, 0.25F};
    // Front and back of the ball: 1 - 0.75^2.
    QVERIFY(std::abs(pixel(draw(view, 64, 64), 32, 32).r - 255.0 * 0.4375) <= 2.0);
  }
};

TIDEMARK_TEST(TransferViewTest)

}  // namespace tidemark::test::transfer_view_test

#include "transfer_view_test.moc"
