// Labels in 3D: where they show, in which colour, and what they leave alone.
#include <QTest>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/label_colour.h"
#include "tests/renderer/scenes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::label_view_test {

namespace {

constexpr std::int64_t kSide = 120;  // pixels
constexpr double kMiddle = 0.5 * (kSide - 1.0);
constexpr double kRadius = 20.0;                              // of label 1
constexpr double kInner = 8.0;                                // of label 2, inside it
const renderer::Lighting kFlat{1.0, 0.0, 0.0, 1.0, {}, 0.0};  // colours as they are

glm::dvec3 colour_of(std::uint8_t label) {
  const auto [red, green, blue] = label_colour(label);
  return {red, green, blue};
}

// A ball of label 1 around one of label 2.
PagedBytes balls(const Geometry& geometry, double inner = kInner) {
  const glm::dvec3 middle = renderer::middle_of(geometry);
  const auto values = sample(geometry, [&](glm::dvec3 p) {
    const double r = glm::length(p - middle);
    return r < inner ? 2.0 : r < kRadius ? 1.0 : 0.0;
  });
  return {geometry.size, std::vector<std::uint8_t>(values.begin(), values.end())};
}

// A scene without a surface.
Scene empty_scene(const Geometry& geometry) {
  Scene scene = ball_scene(geometry, 1.0);
  scene.phi = solver::Field::empty(geometry, scene.phi.band);
  return scene;
}

void label(Painter& painter, const PagedBytes& numbers, const std::vector<std::uint8_t>& hidden = {}) {
  std::vector<renderer::LabelColour> colours(renderer::kLabels);
  for (std::size_t i = 1; i < colours.size(); ++i) {
    const auto [red, green, blue] = label_colour(static_cast<std::uint8_t>(i));
    colours[i] = {red, green, blue, 255};
  }
  for (const std::uint8_t one : hidden) colours[one][3] = 0;
  for (const Status& status :
       {painter.renderer().set_labels(numbers), painter.renderer().set_label_colours(colours)}) {
    if (!status) qFatal("%s", status.error().message.c_str());
  }
}

renderer::VolumeView label_view(renderer::Mode mode, double opacity = 1.0) {
  renderer::VolumeView view;
  view.mode = mode;
  view.label_opacity = opacity;
  view.lighting = kFlat;
  return view;
}

double off(glm::ivec3 found, glm::dvec3 expected) {
  return glm::length(glm::dvec3(found) - expected);
}

// Of pixels that are not `expected` where the ball of that radius is, a voxel and a bit from its outline, or
// that are not background around it.
std::int64_t wrong_pixels(const renderer::Picture& picture, double radius_px, double voxel_px,
                          glm::dvec3 expected, const renderer::VolumeView& view) {
  const glm::dvec3 background = 255.0 * glm::dvec3(view.background);
  std::int64_t wrong = 0;
  for (std::int64_t y = 0; y < picture.height; ++y) {
    for (std::int64_t x = 0; x < picture.width; ++x) {
      const double r = std::hypot(static_cast<double>(x) - kMiddle, static_cast<double>(y) - kMiddle);
      if (std::abs(r - radius_px) < 1.2 * voxel_px) continue;
      wrong += off(pixel(picture, x, y), r < radius_px ? expected : background) > 3.0 ? 1 : 0;
    }
  }
  return wrong;
}

void add_modes() {
  QTest::addColumn<int>("mode");
  QTest::newRow("rays") << static_cast<int>(renderer::Mode::raycast);
  QTest::newRow("slices") << static_cast<int>(renderer::Mode::slices);
}

}  // namespace

class LabelViewTest : public QObject {
  Q_OBJECT

 private slots:
  void a_labels_silhouette_has_its_colour_data() { add_modes(); }
  void a_labels_silhouette_has_its_colour() {
    QFETCH(int, mode);
    const Geometry geometry = grid({64, 60, 31}, {1.0, 1.0, 2.0});
    Painter draw(empty_scene(geometry));
    label(draw, balls(geometry));
    renderer::VolumeView view = label_view(static_cast<renderer::Mode>(mode));
    for (const auto& [azimuth, elevation] : {std::pair{0.0, 0.0}, {90.0, 0.0}, {0.0, 90.0}, {33.0, -20.0}}) {
      view.camera.azimuth = azimuth;
      view.camera.elevation = elevation;
      const double mm_px = 0.5 * kSide / view.camera.half_height_mm(geometry, 1.0);
      const renderer::Picture picture = draw(view, kSide, kSide);
      // A voxel is 2 mm along the slices' normal.
      const std::int64_t wrong = wrong_pixels(picture, kRadius * mm_px, 2.0 * mm_px, colour_of(1), view);
      QVERIFY2(wrong == 0, qPrintable(QString("%1 at %2, %3").arg(wrong).arg(azimuth).arg(elevation)));
    }
  }

  void a_hidden_label_shows_what_is_in_it_data() { add_modes(); }
  void a_hidden_label_shows_what_is_in_it() {
    QFETCH(int, mode);
    const Geometry geometry = grid({64, 64, 64});
    Painter draw(empty_scene(geometry));
    const renderer::VolumeView view = label_view(static_cast<renderer::Mode>(mode));
    const double mm_px = 0.5 * kSide / view.camera.half_height_mm(geometry, 1.0);
    label(draw, balls(geometry), {1});
    QCOMPARE(wrong_pixels(draw(view, kSide, kSide), kInner * mm_px, mm_px, colour_of(2), view), 0);
    label(draw, balls(geometry), {2});
    QCOMPARE(wrong_pixels(draw(view, kSide, kSide), kRadius * mm_px, mm_px, colour_of(1), view), 0);
    label(draw, balls(geometry), {1, 2});
    QCOMPARE(draw(view, kSide, kSide).pixels, draw(label_view(view.mode, 0.0), kSide, kSide).pixels);
  }

  // Into 1, into 2, out of 2 into 1, out of 1: half of the light is lost at each.
  void borders_are_laid_one_behind_the_other_data() { add_modes(); }
  void borders_are_laid_one_behind_the_other() {
    QFETCH(int, mode);
    const Geometry geometry = grid({64, 64, 64});
    Painter draw(empty_scene(geometry));
    label(draw, balls(geometry));
    const renderer::VolumeView view = label_view(static_cast<renderer::Mode>(mode), 0.5);
    const renderer::Picture picture = draw(view, kSide, kSide);
    const glm::dvec3 background = 255.0 * glm::dvec3(view.background);
    const glm::dvec3 expected =
        colour_of(1) * (0.5 + 0.125 + 0.0625) + colour_of(2) * 0.25 + background * 0.0625;
    QVERIFY2(off(pixel(picture, kSide / 2, kSide / 2), expected) < 4.0,
             qPrintable(QString::number(off(pixel(picture, kSide / 2, kSide / 2), expected))));
  }

  void light_does_not_show_the_steps_of_voxels() {
    const Geometry geometry = grid({64, 64, 64});
    Painter draw(empty_scene(geometry));
    label(draw, balls(geometry, 0.0));
    renderer::VolumeView view = label_view(renderer::Mode::raycast);
    view.lighting = {0.0, 1.0, 0.0, 1.0, {}, 0.0};  // the cosine
    const renderer::Picture picture = draw(view, kSide, kSide);
    const double side = 2.0 * view.camera.half_height_mm(geometry, 1.0) / kSide;
    double sum = 0.0;
    double found = 0.0;
    for (std::int64_t y = 0; y < kSide; ++y) {
      for (std::int64_t x = 0; x < kSide; ++x) {
        const glm::dvec2 at = side * (glm::dvec2(x, y) - kMiddle) / kRadius;
        if (glm::length(at) > 0.85) continue;
        const double cosine = std::sqrt(1.0 - glm::dot(at, at));
        sum += std::abs(glm::length(glm::dvec3(pixel(picture, x, y))) / glm::length(colour_of(1)) - cosine);
        ++found;
      }
    }
    qInfo("light is off by %.3f in the mean", sum / found);
    QVERIFY(sum / found < 0.03);
  }

  // Where a label is what the surface has been accepted into, neither shines through the other in patches.
  void a_surface_has_the_colour_of_the_label_that_ends_there_data() { add_modes(); }
  void a_surface_has_the_colour_of_the_label_that_ends_there() {
    QFETCH(int, mode);
    const Geometry geometry = grid({64, 64, 40}, {1.0, 1.0, 1.6});
    const Scene scene = ball_scene(geometry, kRadius);
    Painter draw(scene);
    label(draw, {geometry.size, scene.phi.mask().voxels});
    renderer::VolumeView view = label_view(static_cast<renderer::Mode>(mode), 0.5);
    view.camera.azimuth = 25.0;
    view.camera.elevation = 15.0;
    const double mm_px = 0.5 * kSide / view.camera.half_height_mm(geometry, 1.0);
    const glm::dvec3 surface = 255.0 * glm::dvec3(view.surface_colour);
    const renderer::Picture picture = draw(view, kSide, kSide);
    std::int64_t wrong = 0;
    std::int64_t all = 0;
    for (std::int64_t y = 0; y < kSide; ++y) {
      for (std::int64_t x = 0; x < kSide; ++x) {
        const double r =
            std::hypot(static_cast<double>(x) - kMiddle, static_cast<double>(y) - kMiddle) / mm_px;
        if (r > 0.95 * kRadius) continue;
        ++all;
        wrong += off(pixel(picture, x, y), 0.5 * (surface + colour_of(1))) > 4.0 ? 1 : 0;
      }
    }
    qInfo("%lld of %lld pixels have another colour", static_cast<long long>(wrong),
          static_cast<long long>(all));
    QVERIFY(wrong * 50 < all);
    // A label far inside of the surface leaves it as it is.
    label(draw, balls(geometry), {1});
    QVERIFY(off(pixel(draw(view, kSide, kSide), kSide / 2, kSide / 2), surface) < 4.0);
  }

  void the_clip_plane_cuts_labels_and_shows_them() {
    const Geometry geometry = grid({64, 64, 64});
    const Scene scene = empty_scene(geometry);
    Painter draw(scene);
    label(draw, balls(geometry));
    renderer::VolumeView view = label_view(renderer::Mode::raycast);
    view.window = {0.0, 100.0};
    view.clip = renderer::ClipPlane{{0.0, -1.0, 0.0}, -scene.middle.y};  // hides the front half
    // On the plane the ball in the middle is a disc.
    for (const renderer::Mode mode : {renderer::Mode::raycast, renderer::Mode::slices}) {
      view.mode = mode;
      const renderer::Picture cut = draw(view, kSide, kSide);
      const double mm_px = 0.5 * kSide / view.camera.half_height_mm(geometry, 1.0);
      QVERIFY(off(pixel(cut, kSide / 2, kSide / 2), colour_of(2)) < 3.0);
      QVERIFY(off(pixel(cut, kSide / 2 + std::lround(14.0 * mm_px), kSide / 2), colour_of(1)) < 3.0);
    }
    view.clip->picture = false;  // into the hollow half: the inner ball's border is behind
    view.mode = renderer::Mode::raycast;
    view.label_opacity = 0.5;
    const glm::dvec3 expected = colour_of(1) * (0.5 + 0.25) + 255.0 * 0.25 * glm::dvec3(view.background);
    QVERIFY(off(pixel(draw(view, kSide, kSide), kSide / 2, kSide / 2), expected) < 4.0);
  }

  void the_clip_plane_hides_what_closes_a_label_on_the_volumes_border() {
    // A ball that the front face of the volume cuts through its middle.
    const Geometry geometry = grid({64, 32, 64});
    const glm::dvec3 front(31.5, -0.5, 31.5);
    const auto inside =
        sample(geometry, [&](glm::dvec3 p) { return glm::length(p - front) < kRadius ? 1.0 : 0.0; });
    Painter draw(empty_scene(geometry));
    label(draw, {geometry.size, std::vector<std::uint8_t>(inside.begin(), inside.end())});
    // Along the rays, and aslant.
    for (const glm::dvec3 across : {glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(1.0, 0.2, 0.0)}) {
      const glm::dvec3 normal = glm::normalize(across);
      for (const renderer::Mode mode : {renderer::Mode::raycast, renderer::Mode::slices}) {
        renderer::VolumeView view = label_view(mode);
        view.clip = renderer::ClipPlane{normal, glm::dot(normal, front)};
        view.clip->picture = false;
        const renderer::Picture picture = draw(view, kSide, kSide);
        std::int64_t hidden = 0;
        for (std::int64_t y = 0; y < kSide; ++y) {
          for (std::int64_t x = kSide / 2; x < kSide; ++x) {
            hidden += off(pixel(picture, x, y), 255.0 * glm::dvec3(view.background)) > 3.0 ? 1 : 0;
          }
        }
        QCOMPARE(hidden, 0);
        QVERIFY(off(pixel(picture, kSide * 2 / 5, kSide / 2), colour_of(1)) < 3.0);
      }
    }
  }

  void nothing_is_drawn_otherwise_without_labels() {
    const Geometry geometry = grid({48, 48, 48});
    Painter draw(ball_scene(geometry, 14.0));
    renderer::VolumeView view = label_view(renderer::Mode::raycast);
    view.source = transfer_function(
        R"({"source": [{"value": {"ramp": [20, 100]}, "opacity": 0.05, "colour": [1, 0.8, 0.6]}]})");
    const renderer::Picture with = draw(view, kSide, kSide);
    view.label_opacity = 0.0;
    QCOMPARE(with.pixels, draw(view, kSide, kSide).pixels);
  }

  void empty_pages_are_skipped_without_a_difference() {
    const Geometry geometry = grid({64, 64, 64});
    Painter draw(ball_scene(geometry, 12.0, {14.0, 0.0, 0.0}));
    label(draw, balls(geometry));
    renderer::VolumeView view = label_view(renderer::Mode::raycast, 0.5);
    view.camera.azimuth = 35.0;
    view.source = transfer_function(
        R"({"source": [{"value": {"ramp": [20, 1000]}, "opacity": 0.05, "colour": [1, 0.8, 0.6]}]})");
    view.quality.step_voxels = 0.05;  // so that it does not matter where a page's samples begin
    const renderer::Picture skipped = draw(view, kSide, kSide);
    view.quality.skip_empty = false;
    const renderer::Picture whole = draw(view, kSide, kSide);
    std::int64_t different = 0;
    for (std::size_t i = 0; i < whole.pixels.size(); ++i) {
      different += std::abs(int{whole.pixels[i]} - int{skipped.pixels[i]}) > 8 ? 1 : 0;
    }
    QVERIFY2(different < 15, qPrintable(QString::number(different)));
  }

  // What is worked out anew for a change is all that the change has a part in.
  void labels_that_change_look_as_if_they_had_always_been_so() {
    const Geometry geometry = grid({48, 44, 40});
    const Scene scene = empty_scene(geometry);
    Painter changing(scene);
    PagedBytes labels(geometry.size);
    renderer::SliceView slice;
    slice.surface = false;
    slice.label_opacity = 1.0;
    slice.orientation = renderer::kCoronal;
    slice.position_mm = scene.middle;
    const std::vector<std::int64_t> middles{8, 20, 9, 31, 20};
    for (std::size_t n = 0; n < middles.size(); ++n) {
      const auto id = static_cast<std::uint8_t>(n == 4 ? 0 : n + 1);  // the last takes away
      labels.fill({8 + static_cast<std::int64_t>(3 * n), 12, middles[n] - 6}, {20, 18, 13}, id);
      label(changing, labels);
      Painter fresh(scene);
      label(fresh, labels);
      for (const renderer::Mode mode : {renderer::Mode::raycast, renderer::Mode::slices}) {
        const renderer::VolumeView view = label_view(mode);
        QVERIFY(changing(view, kSide, kSide).pixels == fresh(view, kSide, kSide).pixels);
      }
      QVERIFY(changing(slice, kSide, kSide).pixels == fresh(slice, kSide, kSide).pixels);
    }
  }

  void picking_finds_a_label() {
    const Geometry geometry = grid({64, 64, 64});
    const Scene scene = empty_scene(geometry);
    Painter draw(scene);
    label(draw, balls(geometry));
    const auto hit =
        draw.renderer().pick(label_view(renderer::Mode::raycast), {kSide, kSide}, {kMiddle, kMiddle});
    QVERIFY(hit && hit->has_value());
    QVERIFY(glm::length((*hit)->patient_mm - (scene.middle - glm::dvec3(0.0, kRadius, 0.0))) < 1.0);
  }

  void labels_are_seen_through_a_surface_that_is_hidden() {
    const Geometry geometry = grid({64, 64, 64});
    Painter draw(ball_scene(geometry, kRadius));
    label(draw, balls(geometry), {1});
    renderer::VolumeView view = label_view(renderer::Mode::raycast);
    view.surface = false;
    QVERIFY(off(pixel(draw(view, kSide, kSide), kSide / 2, kSide / 2), colour_of(2)) < 3.0);
  }
};

TIDEMARK_TEST(LabelViewTest)

}  // namespace tidemark::test::label_view_test

#include "label_view_test.moc"
