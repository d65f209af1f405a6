// The speed map and the colours of the surface with a speed function: the same pictures as where the source
// gives D, and nothing evaluated but what they show.
#include <QTest>

#include "solver/speed/motion_limit.h"
#include "tests/renderer/scenes.h"
#include "tests/solver/formula_speed.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::speed_picture_test {

namespace {

// A D of its own along each axis, linear, so that a source with it at T = 100 and epsilon = 50 has the same
// between voxels.
double speed_along(glm::dvec3 p) {
  return 0.9 - 0.01 * p.x - 0.013 * p.y - 0.007 * p.z;
}

// Pictures of the tent on such a source, and of the function on another source.
struct Pair {
  Geometry geometry = test::grid({70, 61, 52});
  Scene by_source =
      ball_scene(geometry, 14.0, [](glm::dvec3 p) { return 100.0 - 50.0 * (1.0 - speed_along(p)); });
  Scene by_function = ball_scene(geometry, 14.0, [](glm::dvec3) { return 0.0; });
  std::shared_ptr<FormulaSpeed> speed = std::make_shared<FormulaSpeed>(speed_along);
};

// In doubt in one half alone.
class HalfInDoubt final : public solver::SpeedFunction {
 public:
  void evaluate(const solver::VoxelBox& box, double* speed) const override {
    std::fill_n(speed, box.voxels(), -1.0);
  }
  [[nodiscard]] bool has_doubt() const override { return true; }
  void evaluate_doubt(const solver::VoxelBox& box, double* doubt) const override {
    for (std::int64_t i = 0; i < box.voxels(); ++i) *doubt++ = box.first.x + i % box.size.x < 35 ? 1.0 : 0.0;
  }
};

// A ball around the middle of a grid.
Mask ball_mask(const Geometry& geometry, double radius) {
  Mask mask{geometry, {}};
  const glm::dvec3 middle = 0.5 * glm::dvec3(geometry.size - Index3(1));
  for (std::int64_t i = 0; i < geometry.voxel_count(); ++i) {
    const glm::dvec3 p(geometry.voxel_at(i));
    mask.voxels.push_back(glm::distance(p, middle) < radius ? 1 : 0);
  }
  return mask;
}

// Where orange (won) or blue (lost) leads in a picture.
std::int64_t coloured(const renderer::Picture& picture, bool orange) {
  std::int64_t count = 0;
  for (std::int64_t y = 0; y < picture.height; ++y) {
    for (std::int64_t x = 0; x < picture.width; ++x) {
      const glm::ivec3 c = pixel(picture, x, y);
      if (orange ? c.r > c.b + 12 : c.b > c.r + 12) ++count;
    }
  }
  return count;
}

// The share of pixels with a channel that differs by more than 3 of 255.
double difference(const renderer::Picture& a, const renderer::Picture& b) {
  std::int64_t different = 0;
  for (std::int64_t y = 0; y < a.height; ++y) {
    for (std::int64_t x = 0; x < a.width; ++x) {
      const glm::ivec3 d = glm::abs(pixel(a, x, y) - pixel(b, x, y));
      if (std::max({d.x, d.y, d.z}) > 3) ++different;
    }
  }
  return static_cast<double>(different) / static_cast<double>(a.width * a.height);
}

}  // namespace

class SpeedPictureTest : public QObject {
  Q_OBJECT

 private slots:
  void the_speed_map_is_the_functions() {
    const Pair pair;
    Painter expected(pair.by_source);
    Painter draw(pair.by_function);
    renderer::SliceView view;
    view.content = renderer::SliceContent::speed;
    view.surface = false;
    view.window = {1e6, 1.0};  // the source, which shows away from the surface, is black in both
    for (const renderer::SpeedTerm term :
         {renderer::SpeedTerm::data, renderer::SpeedTerm::total, renderer::SpeedTerm::rescaling}) {
      view.term = term;
      for (const renderer::SliceOrientation& orientation :
           {renderer::kAxial, renderer::kCoronal, renderer::kSagittal, renderer::oblique({1.0, 2.0, -1.5})}) {
        view.orientation = orientation;
        for (const double zoom : {1.0, 3.0}) {
          view.zoom = zoom;
          // Anew each time: what an earlier picture evaluated does not help a later one.
          draw.renderer().set_speed(nullptr);
          const renderer::Picture tent = draw(view, 150, 140);
          draw.renderer().set_speed(pair.speed);
          const renderer::Picture wanted = expected(view, 150, 140);
          const renderer::Picture picture = draw(view, 150, 140);
          QVERIFY2(difference(picture, wanted) < 0.002,
                   qPrintable(QString::number(difference(picture, wanted))));
          if (term == renderer::SpeedTerm::data) QVERIFY(difference(picture, tent) > 0.2);
        }
      }
    }
  }

  void the_surfaces_colours_are_the_functions() {
    const Pair pair;
    Painter expected(pair.by_source);
    Painter draw(pair.by_function);
    renderer::VolumeView view;
    view.lighting = {1.0, 0.0, 0.0, 1.0, {}, 0.0};
    for (const renderer::Mode mode : {renderer::Mode::raycast, renderer::Mode::slices}) {
      view.mode = mode;
      for (const renderer::SurfaceColouring colouring :
           {renderer::SurfaceColouring::data, renderer::SurfaceColouring::total_speed,
            renderer::SurfaceColouring::curvature}) {
        view.colouring = colouring;
        draw.renderer().set_speed(nullptr);
        const renderer::Picture tent = draw(view, 120, 120);
        draw.renderer().set_speed(pair.speed);
        const renderer::Picture picture = draw(view, 120, 120);
        QVERIFY2(difference(picture, expected(view, 120, 120)) < 0.002,
                 qPrintable(QString::number(difference(picture, expected(view, 120, 120)))));
        if (colouring == renderer::SurfaceColouring::data) QVERIFY(difference(picture, tent) > 0.1);
      }
    }
  }

  void doubt_is_bright_where_the_function_is_not_sure() {
    const Scene scene = ball_scene(test::grid({70, 61, 52}), 14.0, [](glm::dvec3) { return 100.0; });
    Painter draw(scene);
    renderer::SliceView view;
    view.content = renderer::SliceContent::speed;
    view.term = renderer::SpeedTerm::doubt;
    view.surface = false;
    view.window = {100.0, 10.0};
    const renderer::Picture without = draw(view, 140, 122);
    draw.renderer().set_speed(std::make_shared<HalfInDoubt>());
    const renderer::Picture picture = draw(view, 140, 122);
    // The patient's right, where x is small, is on the left.
    QVERIFY(pixel(picture, 35, 61).r > 200);
    QCOMPARE(pixel(picture, 105, 61), pixel(without, 105, 61));
    QVERIFY(pixel(without, 35, 61).r < 80);
    view.term = renderer::SpeedTerm::data;  // which is sure everywhere
    QVERIFY(difference(draw(view, 140, 122), picture) > 0.9);
  }

  void what_was_won_and_lost_is_coloured() {
    const Geometry geometry = test::grid({70, 61, 52});
    const Scene scene = ball_scene(geometry, 14.0, [](glm::dvec3) { return 100.0; });
    Painter draw(scene);
    renderer::SliceView slice;
    slice.surface = false;
    slice.window = {100.0, 10.0};
    slice.change = true;
    renderer::VolumeView surface;
    surface.lighting = {1.0, 0.0, 0.0, 1.0, {}, 0.0};
    surface.surface_colour = {0.5F, 0.5F, 0.5F, 1.0F};
    surface.change = true;
    for (const renderer::Mode mode : {renderer::Mode::raycast, renderer::Mode::slices}) {
      surface.mode = mode;
      for (const double began : {11.0, 17.0}) {
        draw.renderer().set_change(nullptr);
        QCOMPARE(coloured(draw(slice, 140, 122), true) + coloured(draw(slice, 140, 122), false),
                 std::int64_t{0});
        draw.renderer().set_change(
            solver::MotionLimit(std::make_shared<const BitMask>(ball_mask(geometry, began)), 4.0).change());
        const bool won = began < 14.0;
        const renderer::Picture in_slice = draw(slice, 140, 122);
        // A ring of 3 mm, 2 pixels a mm.
        const double ring = 3.1416 * std::abs(14.0 * 14.0 - began * began) * 4.0;
        QVERIFY(std::abs(static_cast<double>(coloured(in_slice, won)) - ring) < 0.35 * ring);
        QVERIFY(coloured(in_slice, !won) == 0);
        const renderer::Picture in_3d = draw(surface, 120, 120);
        QVERIFY(coloured(in_3d, won) > 800);
        QCOMPARE(coloured(in_3d, !won), std::int64_t{0});
      }
    }
  }

  void nothing_is_evaluated_but_what_a_picture_shows() {
    const Pair pair;
    Painter draw(pair.by_function);
    draw.renderer().set_speed(pair.speed);
    renderer::SliceView view;
    draw(view, 100, 100);
    QCOMPARE(pair.speed->evaluated(), std::int64_t{0});
    view.content = renderer::SliceContent::speed;
    draw(view, 100, 100);
    const std::int64_t of_slice = pair.speed->evaluated();
    QVERIFY(of_slice >= 70 * 61);
    QVERIFY(of_slice <= 2 * 8 * 72 * 64);
    draw(view, 100, 100);
    QCOMPARE(pair.speed->evaluated(), of_slice);
    draw.renderer().set_speed(pair.speed);  // the same again
    draw(view, 100, 100);
    QCOMPARE(pair.speed->evaluated(), of_slice);
    renderer::VolumeView surface;
    surface.colouring = renderer::SurfaceColouring::data;
    draw(surface, 100, 100);
    QVERIFY(pair.speed->evaluated() > of_slice);
    QVERIFY(pair.speed->evaluated() < pair.geometry.voxel_count());
  }
};

TIDEMARK_TEST(SpeedPictureTest)

}  // namespace tidemark::test::speed_picture_test

#include "speed_picture_test.moc"
