// The surface in 3D, the clip plane and picking, against what geometry says.
#include <QTest>
#include <cmath>
#include <numbers>

#include "tests/renderer/scenes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::volume_view_test {

namespace {

// A pixel's side in mm.
double pixel_mm(const renderer::VolumeView& view, const Geometry& geometry, std::int64_t height) {
  return 2.0 * view.camera.half_height_mm(geometry, 1.0) / static_cast<double>(height);
}

constexpr glm::dvec3 kOnFace(31.5, -0.5, 31.5);

// A ball of 20 mm that the front face of the volume cuts through its middle, kOnFace.
Scene half_ball_scene() {
  const Geometry geometry = grid({64, 32, 64});
  Scene scene = ball_scene(geometry, 5.0);
  const double band = scene.phi.band;
  scene.phi = solver::Field::from_dense(
      geometry,
      sample(geometry,
             [&](glm::dvec3 p) { return std::clamp(20.0 - glm::length(p - kOnFace), -band, band); }),
      band);
  return scene;
}

}  // namespace

class VolumeViewTest : public QObject {
  Q_OBJECT

 private slots:
  void a_balls_silhouette_is_right_within_half_a_pixel_from_every_side() {
    const Geometry geometry = grid({64, 64, 64});
    Painter draw(ball_scene(geometry, 20.0));
    renderer::VolumeView view;
    for (const auto& [azimuth, elevation] : {std::pair{0.0, 0.0}, {90.0, 0.0}, {0.0, 90.0}, {33.0, -20.0}}) {
      view.camera.azimuth = azimuth;
      view.camera.elevation = elevation;
      const renderer::Picture picture = draw(view, 256, 256);
      const double radius = 20.0 / pixel_mm(view, geometry, 256);
      for (std::int64_t y = 0; y < 256; ++y) {
        for (std::int64_t x = 0; x < 256; ++x) {
          const double r = std::hypot(static_cast<double>(x) - 127.5, static_cast<double>(y) - 127.5);
          if (std::abs(r - radius) < 0.5) continue;
          QVERIFY2(is_surface(pixel(picture, x, y)) == (r < radius),
                   qPrintable(QString("%1, %2: %3 of %4").arg(x).arg(y).arg(r).arg(radius)));
        }
      }
    }
  }

  void a_balls_normals_are_right_within_a_degree() {
    // With diffuse light alone the brightness is the cosine between normal and light.
    const Geometry geometry = grid({64, 64, 64});
    Painter draw(ball_scene(geometry, 20.0));
    renderer::VolumeView view;
    view.surface_colour = {1.0F, 1.0F, 1.0F, 1.0F};
    view.lighting.ambient = 0.0;
    view.lighting.diffuse = 1.0;
    view.lighting.specular = 0.0;
    view.lighting.from = glm::normalize(glm::dvec3(0.3, -1.0, 0.4));
    for (const double azimuth : {0.0, 40.0}) {
      view.camera.azimuth = azimuth;
      const renderer::Picture picture = draw(view, 256, 256);
      const double side = pixel_mm(view, geometry, 256);
      const glm::dvec3 into = glm::cross(view.camera.up(), view.camera.right());
      double worst = 0.0;
      for (std::int64_t y = 40; y < 216; y += 3) {
        for (std::int64_t x = 40; x < 216; x += 3) {
          const double u = (static_cast<double>(x) - 127.5) * side / 20.0;
          const double v = (127.5 - static_cast<double>(y)) * side / 20.0;
          if (u * u + v * v > 0.8) continue;
          const glm::dvec3 normal =
              view.camera.right() * u + view.camera.up() * v - into * std::sqrt(1.0 - u * u - v * v);
          // Along the meridian from the light a degree changes the cosine by sin(angle) * pi / 180; a grey
          // level is 1 / 255.
          const double cosine = glm::dot(normal, *view.lighting.from);
          if (cosine < 0.1 || cosine > 0.95) continue;
          const double seen = pixel(picture, x, y).r / 255.0;
          const double degrees =
              std::abs(seen - cosine) / std::sqrt(1.0 - cosine * cosine) * 180.0 / std::numbers::pi;
          worst = std::max(
              worst, degrees - 0.5 / 255.0 / std::sqrt(1.0 - cosine * cosine) * 180.0 / std::numbers::pi);
        }
      }
      QVERIFY2(worst < 1.0, qPrintable(QString::number(worst)));
      qInfo("normals within %.2f degrees", worst);
    }
  }

  void pages_of_any_shape_give_the_same_picture() {
    const Geometry geometry = grid({50, 41, 37});
    std::vector<std::uint8_t> expected;
    for (const Index3 shape : {Index3(8, 8, 8), Index3(16, 16, 1), Index3(4, 4, 4)}) {
      Painter draw(ball_scene(geometry, 14.0, glm::dvec3(1e6), shape));
      renderer::VolumeView view;
      view.camera.azimuth = 25.0;
      view.camera.elevation = 30.0;
      const renderer::Picture picture = draw(view, 128, 128);
      if (expected.empty()) expected = picture.pixels;
      std::int64_t different = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        different += std::abs(int(expected[i]) - int(picture.pixels[i])) > 12 ? 1 : 0;
      }
      // Rays are sampled from page to page, so that a few pixels of the outline may differ.
      QVERIFY2(different < 200, qPrintable(QString::number(different)));
    }
  }

  // Near and far, beside the middle, and of a size that no block of rays divides.
  void empty_pages_are_skipped_without_a_difference_data() {
    QTest::addColumn<double>("azimuth");
    QTest::addColumn<double>("elevation");
    QTest::addColumn<double>("zoom");
    QTest::addColumn<bool>("cut");
    QTest::newRow("from the front") << 0.0 << 0.0 << 1.0 << false;
    QTest::newRow("from aside") << 40.0 << -25.0 << 1.0 << false;
    QTest::newRow("near") << 200.0 << 50.0 << 5.0 << false;
    QTest::newRow("far") << -70.0 << 10.0 << 0.5 << false;
    QTest::newRow("cut") << 30.0 << 20.0 << 1.5 << true;
  }
  void empty_pages_are_skipped_without_a_difference() {
    QFETCH(double, azimuth);
    QFETCH(double, elevation);
    QFETCH(double, zoom);
    QFETCH(bool, cut);
    const Geometry geometry = grid({96, 70, 61}, {1.0, 1.0, 1.5});
    const Scene scene = ball_scene(geometry, 18.0);
    Painter draw(scene);
    renderer::VolumeView view;
    view.camera = {azimuth, elevation, zoom, scene.middle + glm::dvec3(9.0, 4.0, -12.0)};
    view.quality.step_voxels = 0.05;  // so that it does not matter where a page's samples begin
    if (cut) view.clip = renderer::ClipPlane{{0.0, -1.0, 0.0}, -scene.middle.y};
    const renderer::Picture skipped = draw(view, 131, 77);
    view.quality.skip_empty = false;
    const GreyDifference difference = grey_difference(skipped, draw(view, 131, 77));
    QVERIFY2(difference.most <= 1, words(difference).constData());
    QVERIFY(count(skipped, is_surface) > 100);
  }

  // In one page as large as the volume nothing is translated: an unpacked copy of phi.
  void a_picture_from_pages_is_that_from_a_dense_copy_data() {
    QTest::addColumn<QString>("what");
    for (const char* what : {"surface", "source", "region", "clip plane"}) QTest::newRow(what) << what;
  }
  void a_picture_from_pages_is_that_from_a_dense_copy() {
    QFETCH(QString, what);
    const Geometry geometry = grid({48, 40, 44}, {1.0, 1.1, 1.4});
    renderer::VolumeView view;
    view.camera.azimuth = 35.0;
    view.camera.elevation = 15.0;
    view.window = {50.0, 200.0};
    // The samples of a ray begin anew in each page; without that they would be at other places.
    view.quality.step_voxels = 0.05;
    if (what == "source" || what == "region") {
      view.source = transfer_function(
          R"({"source": [{"value": {"ramp": [20, 100]}, "opacity": 0.05, "colour": [1, 0.8, 0.6]}]})");
      view.surface = false;
    }
    if (what == "region") view.region = renderer::Region::inside;
    if (what == "clip plane") view.clip = renderer::ClipPlane{{0.0, -1.0, 0.0}, -20.0};
    const auto smooth = [&](glm::dvec3 p) {
      return 100.0 * std::exp(-glm::length(p - renderer::middle_of(geometry)) / 15.0);
    };
    Scene packed = ball_scene(geometry, 14.0, smooth);
    Scene dense = packed;
    // One page around everything; the processor's renderer wants sides that are powers of two.
    dense.phi = solver::Field::from_dense(geometry, packed.phi.dense(), packed.phi.band, Index3(64));
    const renderer::Picture expected = Painter(dense)(view, 160, 160);
    const renderer::Picture picture = Painter(packed)(view, 160, 160);
    int most = 0;
    double sum = 0.0;
    std::int64_t beyond = 0;
    for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
      const int difference = std::abs(int(expected.pixels[i]) - int(picture.pixels[i]));
      most = std::max(most, difference);
      sum += difference;
      beyond += difference > 1 ? 1 : 0;
    }
    qInfo("at most %d grey levels, %.4f in the mean, %lld values differ by more than 1", most,
          sum / static_cast<double>(expected.pixels.size()), static_cast<long long>(beyond));
    QVERIFY(most <= 1);
  }

  void the_clip_plane_hides_and_shows_the_source() {
    const Geometry geometry = grid({64, 64, 64});
    const Scene scene = ball_scene(geometry, 20.0);
    Painter draw(scene);
    renderer::VolumeView view;
    view.clip = renderer::ClipPlane{{0.0, -1.0, 0.0}, -scene.middle.y};  // hides the front half
    view.window = {50.0, 200.0};
    const renderer::Picture cut = draw(view, 200, 200);
    const glm::ivec3 centre = pixel(cut, 100, 100);  // the source's 100 in its window
    QVERIFY(std::abs(centre.r - centre.g) < 3 && std::abs(centre.r - 191) < 6);
    // From behind, the plane is hidden by what is left.
    view.camera.azimuth = 180.0;
    const renderer::Picture back = draw(view, 200, 200);
    QVERIFY(pixel(back, 100, 100).r > pixel(back, 100, 100).b + 20);
  }

  void the_cut_lies_on_the_circle_within_a_quarter_of_a_voxel() {
    const Geometry geometry = grid({64, 64, 64});
    const Scene scene = ball_scene(geometry, 20.0);
    Painter draw(scene);
    for (const double depth : {0.0, 8.0}) {
      renderer::VolumeView view;
      view.clip = renderer::ClipPlane{{0.0, -1.0, 0.0}, -scene.middle.y - depth};
      view.window = {50.0, 1000.0};
      const renderer::Picture picture = draw(view, 512, 512);
      const double side = pixel_mm(view, geometry, 512);
      const double radius = std::sqrt(400.0 - depth * depth);
      // The line's middle along rays from the middle of the picture.
      for (int degree = 0; degree < 360; degree += 3) {
        const double a = degree * std::numbers::pi / 180.0;
        double sum = 0.0;
        double yellow = 0.0;
        for (double r = 0.6 * radius; r < 1.3 * radius; r += 0.02) {
          const auto x = std::lround(255.5 + r / side * std::cos(a));
          const auto y = std::lround(255.5 - r / side * std::sin(a));
          if (!is_yellow(pixel(picture, x, y))) continue;
          sum += r;
          ++yellow;
        }
        QVERIFY(yellow > 0.0);
        QVERIFY2(std::abs(sum / yellow - radius) < 0.25, qPrintable(QString::number(sum / yellow - radius)));
      }
    }
  }

  void the_clip_plane_cuts_what_it_is_told_to() {
    const Geometry geometry = grid({64, 64, 64});
    const Scene scene = ball_scene(geometry, 20.0);
    Painter draw(scene);
    renderer::VolumeView view;
    view.clip = renderer::ClipPlane{{0.0, -1.0, 0.0}, -scene.middle.y};
    view.clip->picture = false;
    view.clip->clips_surface = false;  // the whole ball stands in front
    const renderer::VolumeView plain;
    QCOMPARE(draw(view, 100, 100).pixels, draw(plain, 100, 100).pixels);
    view.clip->clips_surface = true;  // its hollow half, seen from inside: lit otherwise
    QVERIFY(draw(view, 100, 100).pixels != draw(plain, 100, 100).pixels);
  }

  void picking_finds_the_surface_and_the_plane() {
    Geometry geometry = grid({64, 60, 50}, {1.0, 1.2, 1.5});
    geometry.origin_mm = {-10.0, 20.0, 300.0};
    const Scene scene = ball_scene(geometry, 20.0);
    Painter draw(scene);
    renderer::VolumeView view;
    const renderer::PictureSize size{200, 160};
    const double side = 2.0 * view.camera.half_height_mm(geometry, size.aspect()) / 160.0;
    const glm::dvec2 offset(30.0, -20.0);  // pixels from the middle, to the right and up
    const glm::dvec2 at(99.5 + offset.x, 79.5 + 20.0);
    auto hit = draw.renderer().pick(view, size, at);
    QCOMPARE(failure(hit), QString());
    QVERIFY(hit->has_value() && (*hit)->kind == renderer::Hit::Kind::surface);
    // From the front: x is left, z is up, and the ball's front is at the least y.
    const glm::dvec3 from_middle((offset.x) * side, 0.0, offset.y * side);
    const double depth = std::sqrt(400.0 - glm::dot(from_middle, from_middle));
    const glm::dvec3 expected = scene.middle + from_middle - glm::dvec3(0.0, depth, 0.0);
    QVERIFY2(glm::length((*hit)->patient_mm - expected) < 0.3,
             qPrintable(QString::number(glm::length((*hit)->patient_mm - expected))));
    QVERIFY(glm::length(geometry.to_patient((*hit)->voxel) - (*hit)->patient_mm) < 1e-6);

    view.clip = renderer::ClipPlane{{0.0, -1.0, 0.0}, -scene.middle.y};
    hit = draw.renderer().pick(view, size, at);
    QVERIFY(hit && hit->has_value() && (*hit)->kind == renderer::Hit::Kind::clip_plane);
    QVERIFY(glm::length((*hit)->patient_mm - (scene.middle + from_middle)) < 0.01);

    view.clip.reset();
    hit = draw.renderer().pick(view, size, {1.0, 1.0});
    QVERIFY(hit && !hit->has_value());
  }

  void colours_teach_the_terms_of_the_speed() {
    // On a ball of bright source the data term is positive, the curvature term negative, and both are told
    // apart.
    const Geometry geometry = grid({48, 48, 48});
    Painter draw(ball_scene(geometry, 12.0));
    renderer::VolumeView view;
    view.lighting = {1.0, 0.0, 0.0, 1.0, {}, 0.0};  // the colours as they are
    const auto middle = [&](renderer::SurfaceColouring colouring) {
      view.colouring = colouring;
      return pixel(draw(view, 64, 64), 32, 32);
    };
    const glm::ivec3 bending = middle(renderer::SurfaceColouring::curvature);
    QVERIFY(bending.b > bending.r + 20);  // kappa < 0 on a ball
    const glm::ivec3 term = middle(renderer::SurfaceColouring::curvature_term);
    QVERIFY(term.b > term.r);
    const glm::ivec3 rescaling = middle(renderer::SurfaceColouring::rescaling);
    QVERIFY(std::abs(rescaling.r - rescaling.b) < 30);  // a distance already
    const glm::ivec3 pages = middle(renderer::SurfaceColouring::pages);
    QVERIFY(pages.b > pages.r + 60);  // resident, not quiet
  }

  void a_surface_is_closed_where_it_meets_the_volumes_border() {
    Scene scene = half_ball_scene();
    const Geometry& geometry = scene.source->geometry;
    const double band = scene.phi.band;
    Painter draw(scene);
    renderer::VolumeView view;
    view.lighting.specular = 0.0;
    for (const renderer::Mode mode : {renderer::Mode::raycast, renderer::Mode::slices}) {
      view.mode = mode;
      const renderer::Picture picture = draw(view, 128, 128);
      const double side = pixel_mm(view, geometry, 128);
      // A disc, as bright everywhere as what faces the viewer is.
      const double area = static_cast<double>(count(picture, is_surface)) * side * side;
      QVERIFY2(std::abs(area / (std::numbers::pi * 400.0) - 1.0) < 0.02, qPrintable(QString::number(area)));
      for (const std::int64_t x : {40, 64, 88}) {
        const int expected = std::lround(255.0 * view.surface_colour.r);
        QVERIFY2(std::abs(pixel(picture, x, 64).r - expected) <= 1,
                 qPrintable(QString::number(pixel(picture, x, 64).r)));
      }
    }
    const auto hit = draw.renderer().pick(view, {128, 128}, {64.0, 64.0});
    QVERIFY(hit && hit->has_value() && (*hit)->kind == renderer::Hit::Kind::surface);
    QVERIFY(std::abs((*hit)->voxel.y + 0.5) < 0.01);
    // All inside: a box.
    std::vector<float> ones(static_cast<std::size_t>(geometry.voxel_count()), static_cast<float>(band));
    scene.phi = solver::Field::from_dense(geometry, ones, band);
    Painter box(scene);
    for (const renderer::Mode mode : {renderer::Mode::raycast, renderer::Mode::slices}) {
      view.mode = mode;
      QVERIFY(is_surface(pixel(box(view, 64, 64), 32, 32)));
    }
  }

  void the_clip_plane_hides_what_closes_a_surface_on_the_volumes_border() {
    Painter draw(half_ball_scene());
    renderer::VolumeView view;
    // Along the rays, and aslant; the face is where rays enter, then where they leave.
    for (const glm::dvec3 across : {glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(1.0, 0.2, 0.0)}) {
      const glm::dvec3 normal = glm::normalize(across);
      view.clip = renderer::ClipPlane{normal, glm::dot(normal, kOnFace)};
      view.clip->picture = false;
      for (const double azimuth : {0.0, 180.0}) {
        view.camera.azimuth = azimuth;
        for (const renderer::Mode mode : {renderer::Mode::raycast, renderer::Mode::slices}) {
          view.mode = mode;
          const renderer::Picture picture = draw(view, 128, 128);
          std::int64_t hidden = 0;
          std::int64_t left = 0;
          for (std::int64_t y = 0; y < 128; ++y) {
            for (std::int64_t x = 0; x < 128; ++x) {
              if (is_surface(pixel(picture, x, y))) ++((x >= 64) == (azimuth == 0.0) ? hidden : left);
            }
          }
          QVERIFY2(
              hidden == 0 && left > 500,
              qPrintable(
                  QString("%1, %2: %3 hidden, %4 left").arg(across.y).arg(azimuth).arg(hidden).arg(left)));
        }
      }
    }
  }

  void hollows_lose_light() {
    const Geometry geometry = grid({64, 64, 64});
    Scene scene = ball_scene(geometry, 20.0);
    // Two balls, and a crease between them.
    const auto values = sample(geometry, [&](glm::dvec3 p) {
      const glm::dvec3 offset(0.0, 0.0, 8.0);
      const double upper = 11.0 - glm::length(p - scene.middle - offset);
      const double lower = 11.0 - glm::length(p - scene.middle + offset);
      return std::clamp(std::max(upper, lower), -scene.phi.band, scene.phi.band);
    });
    scene.phi = solver::Field::from_dense(geometry, values, scene.phi.band);
    Painter draw(scene);
    renderer::VolumeView view;
    const renderer::Picture without = draw(view, 128, 128);
    view.lighting.occlusion = 1.0;
    const renderer::Picture with = draw(view, 128, 128);
    const auto darker = [&](std::int64_t y) { return pixel(without, 64, y).r - pixel(with, 64, y).r; };
    QVERIFY2(darker(64) > darker(49) + 15, qPrintable(QString("%1 %2").arg(darker(64)).arg(darker(49))));
  }
};

TIDEMARK_TEST(VolumeViewTest)

}  // namespace tidemark::test::volume_view_test

#include "volume_view_test.moc"
