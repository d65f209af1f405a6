// The speed map and the colours of the surface with a speed function: the same pictures as where the source
// gives D, and nothing evaluated but what they show.
#include <QTest>

#include "tests/renderer/scenes.h"
#include "tests/solver/formula_speed.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

using namespace tidemark;
using namespace tidemark::test;

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
#include "speed_picture_test.moc"
