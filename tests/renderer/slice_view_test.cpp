// Slices, the speed map, labels and the page view.
#include <QTest>
#include <cmath>
#include <numbers>

#include "core/label_colour.h"
#include "tests/renderer/scenes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::slice_view_test {

namespace {

// How far the middle of the yellow line is from a circle around the picture's middle, at worst; pixels.
double distance_from_circle(const renderer::Picture& picture, double radius_pixels) {
  const glm::dvec2 middle(0.5 * static_cast<double>(picture.width - 1),
                          0.5 * static_cast<double>(picture.height - 1));
  double worst = 0.0;
  for (int degree = 0; degree < 360; degree += 2) {
    const double a = degree * std::numbers::pi / 180.0;
    double sum = 0.0;
    double yellow = 0.0;
    for (double r = 0.7 * radius_pixels; r < 1.3 * radius_pixels; r += 0.1) {
      const auto x = std::lround(middle.x + r * std::cos(a));
      const auto y = std::lround(middle.y + r * std::sin(a));
      if (x < 0 || y < 0 || x >= picture.width || y >= picture.height || !is_yellow(pixel(picture, x, y)))
        continue;
      sum += r;
      ++yellow;
    }
    worst = std::max(worst, yellow > 0.0 ? std::abs(sum / yellow - radius_pixels) : 1e9);
  }
  return worst;
}

}  // namespace

class SliceViewTest : public QObject {
  Q_OBJECT

 private slots:
  void images_lie_over_the_source_and_under_the_outline() {
    const Scene scene = ball_scene(grid({64, 64, 64}), 20.0);
    Painter draw(scene);
    renderer::SliceView view;
    view.window = {50.0, 1000.0};
    const renderer::Picture alone = draw(view, 256, 256);
    const auto is_green = [](glm::ivec3 colour) { return colour.g > 150 && colour.r < 80 && colour.b < 80; };
    const std::int64_t outline = count(alone, is_yellow);
    QVERIFY(outline > 300);
    QCOMPARE(count(alone, is_green), std::int64_t{0});

    view.images = std::make_shared<const renderer::ImagesOver>(renderer::ImagesOver{1, 1, {0, 200, 0, 255}});
    const renderer::Picture fused = draw(view, 256, 256);
    QVERIFY(count(fused, is_green) > 60000);
    // Pixels at its edge, which it covers in part, take more from what is below.
    QVERIFY2(count(fused, is_yellow) > outline * 6 / 10,
             qPrintable(QString::number(count(fused, is_yellow))));

    // Half of it shines through, and left of a line there is none.
    view.images = std::make_shared<const renderer::ImagesOver>(renderer::ImagesOver{1, 1, {0, 100, 0, 128}});
    view.images_from = 0.25;
    const renderer::Picture swiped = draw(view, 256, 256);
    QCOMPARE(pixel(swiped, 62, 100), pixel(alone, 62, 100));
    const glm::ivec3 below = pixel(alone, 128, 128);
    const glm::ivec3 mixed = pixel(swiped, 128, 128);
    QVERIFY(std::abs(mixed.g - (100 + below.g * 127 / 255)) <= 2 &&
            std::abs(mixed.r - below.r * 127 / 255) <= 2);

    // The first row is the top one.
    view.images_from = 0.0;
    view.images = std::make_shared<const renderer::ImagesOver>(
        renderer::ImagesOver{1, 2, {0, 200, 0, 255, 0, 0, 0, 255}});
    const renderer::Picture upright = draw(view, 256, 256);
    QVERIFY(is_green(pixel(upright, 20, 20)) && !is_green(pixel(upright, 20, 235)));
  }

  void the_outline_lies_on_the_circle_within_a_quarter_of_a_voxel() {
    const Geometry geometry = grid({64, 64, 64});
    const Scene scene = ball_scene(geometry, 20.0);
    Painter draw(scene);
    for (const double depth : {0.0, 7.3}) {
      for (const renderer::SliceOrientation& orientation :
           {renderer::kAxial, renderer::kCoronal, renderer::kSagittal, renderer::oblique({1.0, 2.0, -1.5})}) {
        renderer::SliceView view;
        view.orientation = orientation;
        view.position_mm = scene.middle + depth * orientation.into();
        view.window = {50.0, 1000.0};
        const renderer::Picture picture = draw(view, 512, 512);
        const double side = 2.0 * renderer::slice_half_height_mm(geometry, orientation, 1.0, 1.0) / 512.0;
        const double worst = side * distance_from_circle(picture, std::sqrt(400.0 - depth * depth) / side);
        QVERIFY2(worst < 0.25, qPrintable(QString::number(worst)));
      }
    }
  }

  void contours_lie_one_and_two_voxels_from_the_surface() {
    constexpr double kRadius = 20.0;
    const Geometry geometry = grid({64, 64, 64});
    Painter draw(ball_scene(geometry, kRadius));
    renderer::SliceView view;
    view.window = {50.0, 1000.0};
    view.surface = false;
    const renderer::Picture plain = draw(view, 512, 512);
    view.contours = true;
    const renderer::Picture drawn = draw(view, 512, 512);
    const double side = 2.0 * renderer::slice_half_height_mm(geometry, view.orientation, 1.0, 1.0) / 512.0;
    for (int degree = 5; degree < 360; degree += 10) {
      const double a = degree * std::numbers::pi / 180.0;
      std::vector<double> at;  // the middles of the lines, in voxels from the ball's middle
      double begin = -1.0;
      for (double r = kRadius - 4.0; r < kRadius + 4.0; r += 0.02) {
        const auto x = std::lround(255.5 + r / side * std::cos(a));
        const auto y = std::lround(255.5 + r / side * std::sin(a));
        const glm::ivec3 change = pixel(drawn, x, y) - pixel(plain, x, y);
        const bool on_line = std::abs(change.r) + std::abs(change.g) + std::abs(change.b) > 90;
        if (on_line && begin < 0.0) begin = r;
        if (!on_line && begin >= 0.0) {
          at.push_back(0.5 * (begin + r));
          begin = -1.0;
        }
        if (on_line) QCOMPARE(pixel(drawn, x, y).r > pixel(drawn, x, y).b, r < kRadius);
      }
      QCOMPARE(at.size(), std::size_t{4});
      const double wanted[] = {18.0, 19.0, 21.0, 22.0};
      for (std::size_t i = 0; i < 4; ++i) {
        QVERIFY2(std::abs(at[i] - wanted[i]) < 0.15, qPrintable(QString("%1 at %2").arg(at[i]).arg(degree)));
      }
    }
  }

  void thick_slices_look_right() {
    const Geometry geometry = grid({60, 60, 16}, {0.5, 0.5, 2.0});
    Painter draw(ball_scene(geometry, 10.0));
    for (const renderer::SliceOrientation& orientation :
         {renderer::kAxial, renderer::kCoronal, renderer::kSagittal}) {
      renderer::SliceView view;
      view.orientation = orientation;
      view.window = {50.0, 400.0};
      const renderer::Picture picture = draw(view, 320, 320);
      const double side = 2.0 * renderer::slice_half_height_mm(geometry, orientation, 1.0, 1.0) / 320.0;
      const double worst = side * distance_from_circle(picture, 10.0 / side);
      QVERIFY2(worst < 0.25, qPrintable(QString::number(worst)));
    }
  }

  void the_outline_is_as_wide_on_any_zoom() {
    const Geometry geometry = grid({64, 64, 64});
    Painter draw(ball_scene(geometry, 20.0));
    for (const double zoom : {0.5, 1.0, 1.4}) {
      renderer::SliceView view;
      view.zoom = zoom;
      view.line_pixels = 3.0;
      view.window = {50.0, 1000.0};
      const renderer::Picture picture = draw(view, 400, 400);
      const double side = 2.0 * renderer::slice_half_height_mm(geometry, renderer::kAxial, zoom, 1.0) / 400.0;
      const double width =
          static_cast<double>(count(picture, is_yellow)) / (2.0 * std::numbers::pi * 20.0 / side);
      QVERIFY2(std::abs(width - 3.0) < 0.8, qPrintable(QString::number(width)));
    }
  }

  void an_outline_half_way_between_two_slices_of_a_mask_is_no_patch() {
    // Neighbouring slices differ: half-way between them phi of the mask is 0 over an area.
    const Geometry geometry = grid({32, 32, 2}, {1.0, 1.0, 4.0});
    Scene scene = ball_scene(geometry, 4.0);
    const double band = scene.phi.band;
    scene.phi = solver::Field::from_dense(
        geometry, sample(geometry, [&](glm::dvec3 p) { return p.z > 2.0 ? 0.5 : -0.5; }), band);
    Painter draw(scene);
    renderer::SliceView view;
    view.window = {50.0, 1000.0};
    QCOMPARE(count(draw(view, 128, 128), is_yellow), 0);
  }

  void voxels_are_shown_as_they_are_or_interpolated() {
    const Geometry geometry = grid({8, 8, 8});
    Painter draw(ball_scene(geometry, 1.0,
                            [](glm::dvec3 p) { return std::fmod(p.x + p.y, 2.0) < 0.5 ? 0.0 : 100.0; }));
    renderer::SliceView view;
    view.surface = false;
    view.window = {50.0, 100.0};
    view.nearest = true;
    const auto grey = [](glm::ivec3 c) { return c.r > 5 && c.r < 250; };
    QCOMPARE(count(draw(view, 160, 160), grey), 0);
    view.nearest = false;
    QVERIFY(count(draw(view, 160, 160), grey) > 160 * 160 / 2);
  }

  void a_slice_can_be_moved_and_enlarged() {
    const Geometry geometry = grid({64, 64, 64});
    Painter draw(ball_scene(geometry, 1.0, {10.0, -5.0, 0.0}));
    renderer::SliceView view;
    view.surface = false;
    view.window = {500.0, 800.0};
    view.zoom = 2.0;
    view.pan_mm = {10.0, 5.0};  // to the left of the patient and, as up is anterior, forward
    QVERIFY(glm::length(middle_of_pixels(draw(view, 160, 160), is_marker)) < 0.03);
  }

  void the_speed_map_tells_growing_from_shrinking() {
    Painter draw(ball_scene(grid({40, 40, 40}), 10.0));
    renderer::SliceView view;
    view.content = renderer::SliceContent::speed;
    view.surface = false;
    const renderer::Picture picture = draw(view, 120, 120);
    const glm::ivec3 grows = pixel(picture, 60, 60);
    QVERIFY(grows.r > grows.b + 80);
    // Shrinking is blue, and hatched: two shades of it.
    std::int64_t light = 0;
    std::int64_t dark = 0;
    for (std::int64_t x = 0; x < 40; ++x) {
      const glm::ivec3 c = pixel(picture, x, 10);
      QVERIFY(c.b > c.r + 50);
      (c.b > 150 ? light : dark) += 1;
    }
    QVERIFY(light > 20 && dark > 3);
  }

  void each_term_of_the_speed_has_its_map() {
    const Geometry geometry = grid({40, 40, 40});
    const Scene scene = ball_scene(geometry, 10.0);
    Painter draw(scene);
    renderer::SliceView view;
    view.content = renderer::SliceContent::speed;
    view.surface = false;
    view.window = {50.0, 100.0};
    const double side = 2.0 * renderer::slice_half_height_mm(geometry, renderer::kAxial, 1.0, 1.0) / 160.0;
    // Just inside the surface, along 17 degrees, where no axis is.
    const auto near = [&](renderer::SpeedTerm term) {
      view.term = term;
      const renderer::Picture picture = draw(view, 160, 160);
      return pixel(picture, std::lround(79.5 + 9.0 / side * std::cos(0.3)),
                   std::lround(79.5 + 9.0 / side * std::sin(0.3)));
    };
    QVERIFY(near(renderer::SpeedTerm::data).r > near(renderer::SpeedTerm::data).b + 80);
    QVERIFY(near(renderer::SpeedTerm::curvature).b > near(renderer::SpeedTerm::curvature).r + 10);
    const glm::ivec3 rescaling = near(renderer::SpeedTerm::rescaling);
    QVERIFY(std::abs(rescaling.r - rescaling.b) < 40);
    // alpha = 0.5: half the data term and half of kappa = -2 / 9.
    const glm::ivec3 total = near(renderer::SpeedTerm::total);
    QVERIFY(total.r > total.b + 20 && total.b > near(renderer::SpeedTerm::data).b);
    // Away from the surface the other terms have no value.
    view.term = renderer::SpeedTerm::total;
    const glm::ivec3 far = pixel(draw(view, 160, 160), 8, 8);
    QVERIFY(far.r == far.g && far.g == far.b);
  }

  void walls_and_anchors_are_hatched_where_they_are() {
    const Geometry geometry = grid({40, 40, 40});
    Painter draw(ball_scene(geometry, 10.0));
    solver::Constraints constraints(geometry.size);
    const glm::dvec3 middle = renderer::middle_of(geometry);
    constraints.set(geometry, {middle + glm::dvec3(9, 0, 0), 6.0}, solver::Constraint::wall);
    constraints.set(geometry, {middle - glm::dvec3(9, 0, 0), 6.0}, solver::Constraint::anchor);
    renderer::SliceView view;
    view.window = {0.0, 1e6};  // grey
    view.surface = false;
    const renderer::Picture before = draw(view, 200, 200);
    QCOMPARE(failure(draw.renderer().set_constraints(&constraints)), QString());
    const renderer::Picture picture = draw(view, 200, 200);
    const auto is_wall = [](glm::ivec3 c) { return c.r > c.g + 20 && c.r > c.b + 20; };
    const auto is_anchor = [](glm::ivec3 c) { return c.g > c.r + 20 && c.g > c.b + 20; };
    QCOMPARE(count(before, is_wall) + count(before, is_anchor), std::int64_t{0});
    // Discs of radius 6 voxels of 5 pixels.
    for (const PixelTest& test : {PixelTest(is_wall), PixelTest(is_anchor)}) {
      const auto pixels = static_cast<double>(count(picture, test));
      QVERIFY2(std::abs(pixels / (std::numbers::pi * 900.0) - 1.0) < 0.15,
               qPrintable(QString::number(pixels)));
    }
    // 9 of 20 voxels to each side; to the left of the patient, which is on the right, is the wall.
    QVERIFY(glm::length(middle_of_pixels(picture, is_wall) - glm::dvec2(0.45, 0.0)) < 0.04);
    QVERIFY(glm::length(middle_of_pixels(picture, is_anchor) - glm::dvec2(-0.45, 0.0)) < 0.04);
    // Walls are cross-hatched and anchors dotted: that many of their pixels are strong.
    const auto strong = [&](const PixelTest& test) {
      const auto saturated = [&](glm::ivec3 c) {
        return test(c) && std::max({c.r, c.g, c.b}) - std::min({c.r, c.g, c.b}) > 60;
      };
      return static_cast<double>(count(picture, saturated)) / static_cast<double>(count(picture, test));
    };
    QVERIFY(std::abs(strong(is_wall) - 5.0 / 9.0) < 0.08);
    QVERIFY(std::abs(strong(is_anchor) - 0.25) < 0.05);
    // As they change, and none at last.
    constraints.set(geometry, {middle + glm::dvec3(9, 0, 0), 6.0}, solver::Constraint::none);
    QCOMPARE(failure(draw.renderer().set_constraints(&constraints)), QString());
    QCOMPARE(count(draw(view, 200, 200), is_wall), std::int64_t{0});
    QVERIFY(count(draw(view, 200, 200), is_anchor) > 2000);
    QCOMPARE(failure(draw.renderer().set_constraints(nullptr)), QString());
    QVERIFY(draw(view, 200, 200).pixels == before.pixels);
    const solver::Constraints elsewhere(Index3(20, 20, 20));
    QCOMPARE(failure(draw.renderer().set_constraints(&elsewhere)), QString());  // there are none
  }

  void labels_lie_on_their_voxels() {
    const Geometry geometry = grid({32, 32, 32});
    const Scene scene = ball_scene(geometry, 5.0, [](glm::dvec3) { return 0.0; });
    Painter draw(scene);
    const auto values =
        sample(geometry, [](glm::dvec3 p) { return p.x >= 16.0 ? (p.y >= 16.0 ? 2.0 : 1.0) : 0.0; });
    const std::vector<std::uint8_t> labels(values.begin(), values.end());
    QCOMPARE(draw.renderer().set_labels(PagedBytes(Index3(20))).error().kind, ErrorKind::usage);
    QCOMPARE(failure(draw.renderer().set_labels(PagedBytes(geometry.size, labels))), QString());
    renderer::SliceView view;
    view.surface = false;
    view.window = {50.0, 100.0};
    view.label_opacity = 1.0;
    const renderer::Picture picture = draw(view, 128, 128);
    QCOMPARE(pixel(picture, 20, 64), glm::ivec3(0));
    const glm::ivec3 first = pixel(picture, 100, 20);
    const glm::ivec3 second = pixel(picture, 100, 100);
    for (const auto& [seen, label] : {std::pair(first, std::uint8_t{1}), {second, std::uint8_t{2}}}) {
      const auto [red, green, blue] = label_colour(label);
      QCOMPARE(seen, glm::ivec3(red, green, blue));
    }
    QCOMPARE(pixel(picture, 63, 20), glm::ivec3(0));
    QCOMPARE(pixel(picture, 64, 20), first);
  }

  void pages_are_seen_with_what_they_do() {
    const Geometry geometry = grid({64, 64, 64});
    const Scene scene = ball_scene(geometry, 20.0);
    Painter draw(scene);
    renderer::SliceView view;
    view.content = renderer::SliceContent::pages;
    view.surface = false;
    view.window = {5000.0, 100.0};  // the source is black
    const auto at = [&](double left_mm) {
      const renderer::Picture picture = draw(view, 256, 256);
      return pixel(picture, std::lround(127.5 + 4.0 * left_mm), 120);
    };
    const glm::ivec3 inside = at(0.0);
    QVERIFY(inside.r > inside.b + 10);
    const glm::ivec3 outside = at(-31.0);
    QVERIFY(outside.r == outside.b);
    const glm::ivec3 resident = at(20.0);
    QVERIFY(resident.b > resident.r + 30);
    // The page at the surface falls asleep, and then is one that has just come.
    const PageLayout& layout = scene.phi.layout;
    const std::int64_t page = layout.translate({51, 29, 32}).page;
    QCOMPARE(failure(draw.renderer().set_phi(scene.phi, std::vector{page})), QString());
    const glm::ivec3 quiet = at(20.0);
    QVERIFY(quiet.g > quiet.b + 10);
    solver::Field without = scene.phi;
    const double band = without.band;
    auto values = without.dense();
    for (std::int64_t z = 0; z < 64; ++z) {
      for (std::int64_t y = 0; y < 64; ++y) {
        for (std::int64_t x = 0; x < 64; ++x) {
          if (layout.translate({x, y, z}).page == page) {
            values[static_cast<std::size_t>(geometry.offset({x, y, z}))] = static_cast<float>(-band);
          }
        }
      }
    }
    without = solver::Field::from_dense(geometry, values, band);
    QCOMPARE(failure(draw.renderer().set_phi(without)), QString());
    QCOMPARE(failure(draw.renderer().set_phi(scene.phi)), QString());
    const glm::ivec3 fresh = at(20.0);
    QVERIFY(fresh.r > fresh.g + 20);
  }
};

TIDEMARK_TEST(SliceViewTest)

}  // namespace tidemark::test::slice_view_test

#include "slice_view_test.moc"
