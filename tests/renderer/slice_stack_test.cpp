// Pictures from slices beside those from rays, which show the same.
#include <QTest>
#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>

#include "tests/renderer/scenes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::slice_stack_test {

namespace {

constexpr renderer::PictureSize kSize{144, 128};

// A function of the place as seen from the volume's middle.
std::vector<float> sample_around_middle(const Geometry& geometry,
                                        const std::function<double(glm::dvec3)>& function) {
  return sample(geometry, [&](glm::dvec3 p) { return function(p - renderer::middle_of(geometry)); });
}

template <class Scalar>
std::vector<Scalar> stored(const std::vector<float>& values) {
  return {values.begin(), values.end()};
}

enum class Stored { int16, uint16, real };

using Distance = std::function<double(glm::dvec3)>;  // mm, > 0 inside

// To no axis alike; the source has a bright and a dark place of its own.
double two_balls(glm::dvec3 p) {
  return std::max(11.0 - glm::length(p - glm::dvec3(3.0, -2.0, 1.0)),
                  5.0 - glm::length(p - glm::dvec3(-9.0, 6.0, 8.0)));
}

Scene scene(const Geometry& geometry, Index3 page_shape = kDefaultPageShape, Stored kind = Stored::int16,
            const Distance& distance = two_balls) {
  const auto values = sample_around_middle(geometry, [](glm::dvec3 p) {
    const auto hill = [&](glm::dvec3 middle, double width) {
      return std::exp(-glm::dot(p - middle, p - middle) / (width * width));
    };
    return 200.0 + 800.0 * hill({4.0, 3.0, -6.0}, 9.0) + 500.0 * hill({-8.0, -5.0, 6.0}, 6.0);
  });
  auto volume = std::make_shared<Volume>();
  volume->geometry = geometry;
  if (kind == Stored::int16) volume->voxels = stored<std::int16_t>(values);
  if (kind == Stored::uint16) volume->voxels = stored<std::uint16_t>(values);
  if (kind == Stored::real) volume->voxels = stored<float>(values);
  volume->slope = 0.5;
  volume->intercept = -50.0;
  const double unit = std::min({geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z});
  const double band = solver::default_band(geometry);
  const auto phi = sample_around_middle(
      geometry, [&](glm::dvec3 p) { return std::clamp(distance(p) / unit, -band, band); });
  return {volume, solver::Field::from_dense(geometry, phi, band, page_shape), renderer::middle_of(geometry)};
}

std::shared_ptr<gpu::Device> device() {
  static const auto made = reporting_device();
  return made;
}

// No source of a test fits in a 3D texture of its.
std::shared_ptr<gpu::Device> device_without_room() {
  static const auto made = reporting_device(false, 16);
  return made;
}

std::unique_ptr<renderer::Renderer> renderer_of(const Scene& scene,
                                                const std::shared_ptr<gpu::Device>& on = device()) {
  auto renderer = renderer::GlRenderer::create(on, scene.source, scene.phi.layout);
  if (!renderer) qFatal("%s", renderer.error().message.c_str());
  if (Status shown = (*renderer)->set_phi(scene.phi); !shown) qFatal("%s", shown.error().message.c_str());
  return std::move(*renderer);
}

template <class View>
renderer::Picture draw(renderer::Renderer& renderer, const View& view, renderer::PictureSize size = kSize) {
  auto picture = renderer.draw(view, size);
  if (!picture) qFatal("%s", picture.error().message.c_str());
  return std::move(*picture);
}

renderer::Picture draw_by(renderer::Mode mode, renderer::Renderer& renderer, renderer::VolumeView view) {
  view.mode = mode;
  return draw(renderer, view);
}

// How many pixels are not the background.
std::int64_t shown(const renderer::Picture& picture, glm::vec3 background) {
  std::int64_t count = 0;
  for (std::size_t i = 0; i < picture.pixels.size(); i += 4) {
    bool differs = false;
    for (int channel = 0; channel < 3; ++channel) {
      differs |= std::abs(picture.pixels[i + static_cast<std::size_t>(channel)] -
                          255.0F * background[channel]) > 2.0F;
    }
    count += differs ? 1 : 0;
  }
  return count;
}

const std::vector<std::pair<double, double>> kEverySide{{0.0, 0.0},   {180.0, 0.0},  {90.0, 0.0},
                                                        {270.0, 0.0}, {0.0, 90.0},   {0.0, -90.0},
                                                        {33.0, 20.0}, {145.0, -55.0}};

renderer::TransferFunction hills() {
  renderer::TransferFunction function;
  renderer::SourcePrimitive bright;
  bright.value = {renderer::TransferFactor::Kind::ramp, 100.0, 400.0};
  bright.opacity = 0.15;
  bright.colour = {0.9F, 0.5F, 0.3F};
  renderer::SourcePrimitive shell = bright;
  shell.value = {renderer::TransferFactor::Kind::gaussian, 150.0, 20.0};
  shell.opacity = 0.1;
  shell.colour = {0.3F, 0.6F, 0.9F};
  function.source = {bright, shell};
  return function;
}

renderer::VolumeView view_of(const QString& what) {
  renderer::VolumeView view;
  view.window = {200.0, 500.0};
  if (what.contains("translucent")) view.surface_colour.a = 0.4F;
  if (what.contains("source")) view.source = hills();
  if (what.contains("gradient"))
    view.source->source[0].gradient = {renderer::TransferFactor::Kind::ramp, 0.0, 30.0};
  if (what.contains("alone")) view.surface = false;
  if (what.contains("inside")) view.region = renderer::Region::inside;
  if (what.contains("clip")) view.clip = renderer::ClipPlane{glm::normalize(glm::dvec3(0.4, -0.8, 0.3)), 0.0};
  if (what.contains("without picture")) view.clip->picture = false;
  if (what.contains("primitives")) {
    view.source->surface = {
        {{renderer::TransferFactor::Kind::ramp, 50.0, 400.0}, {}, 0.9, {0.2F, 0.9F, 0.4F}}};
  }
  if (what.contains("occlusion")) view.lighting.occlusion = 0.8;
  if (what.contains("curvature")) view.colouring = renderer::SurfaceColouring::curvature;
  if (what.contains("speed")) view.colouring = renderer::SurfaceColouring::total_speed;
  return view;
}

}  // namespace

class SliceStackTest : public QObject {
  Q_OBJECT

 private slots:
  void slices_show_what_rays_show_data() {
    QTest::addColumn<QString>("what");
    // Each compiles its own programs, which takes most of this test's time.
    for (const char* what :
         {"surface", "translucent surface", "alone: source", "surface and source", "alone: source inside",
          "translucent surface and source, clip plane",
          "surface with occlusion and primitives, source by gradient", "surface coloured by speed"}) {
      QTest::newRow(what) << QString(what);
    }
  }
  void slices_show_what_rays_show() {
    QFETCH(QString, what);
    static const auto renderer = renderer_of(scene(grid({50, 41, 37})));
    for (const auto& [azimuth, elevation] : kEverySide) {
      renderer::VolumeView view = view_of(what);
      view.camera = {azimuth, elevation};
      compare(*renderer, view, what);
    }
  }

  // Each on a renderer that has not shown the source yet.
  void slices_need_no_source_for_the_surface_alone_data() {
    QTest::addColumn<QString>("what");
    for (const char* what :
         {"surface coloured by curvature", "surface with clip plane without picture, occlusion"}) {
      QTest::newRow(what) << QString(what);
    }
  }
  void slices_need_no_source_for_the_surface_alone() {
    QFETCH(QString, what);
    const auto renderer = renderer_of(scene(grid({50, 41, 37})));
    // A surface that is cut open has outlines twice.
    const double most = what.contains("clip") ? 0.3 : kMostMean;
    for (const auto& [azimuth, elevation] : kEverySide) {
      renderer::VolumeView view = view_of(what);
      view.camera = {azimuth, elevation};
      compare(*renderer, view, what, most);
    }
  }

  void pages_of_any_shape_and_thick_slices_do_as_well_data() {
    QTest::addColumn<Index3>("shape");
    QTest::addColumn<double>("thickness");
    QTest::newRow("small pages") << Index3(4, 4, 4) << 1.0;
    QTest::newRow("thick slices") << Index3(8, 8, 8) << 2.5;
    QTest::newRow("pages of one slice, thick slices") << Index3(16, 16, 1) << 2.5;
    QTest::newRow("pages of one slice") << Index3(16, 16, 1) << 1.0;
  }
  void pages_of_any_shape_and_thick_slices_do_as_well() {
    QFETCH(Index3, shape);
    QFETCH(double, thickness);
    const Geometry geometry =
        grid({50, 41, static_cast<std::int64_t>(std::lround(37.0 / thickness))}, {1.0, 1.0, thickness});
    const auto renderer = renderer_of(scene(geometry, shape));
    const QString what = "surface and source inside";
    for (const auto& [azimuth, elevation] : kEverySide) {
      renderer::VolumeView view = view_of(what);
      view.camera = {azimuth, elevation};
      compare(*renderer, view, what);
    }
  }

  void a_balls_silhouette_has_its_size_from_every_side() {
    const Geometry geometry = grid({48, 48, 48});
    const auto ball = [](glm::dvec3 p) { return 15.0 - glm::length(p); };
    const auto renderer = renderer_of(scene(geometry, kDefaultPageShape, Stored::int16, ball));
    for (const auto& [azimuth, elevation] : kEverySide) {
      renderer::VolumeView view;
      view.mode = renderer::Mode::slices;
      view.camera = {azimuth, elevation};
      const renderer::PictureSize size{256, 256};
      const double side = 2.0 * view.camera.half_height_mm(geometry, 1.0) / 256.0;
      const double area =
          static_cast<double>(shown(draw(*renderer, view, size), view.background)) * side * side;
      const double share = area / (std::numbers::pi * 225.0);
      QVERIFY2(std::abs(share - 1.0) < 0.02, qPrintable(QString::number(share)));
    }
  }

  void every_kind_of_stored_value_shows_the_same() {
    for (const Stored kind : {Stored::int16, Stored::uint16, Stored::real}) {
      const auto renderer = renderer_of(scene(grid({50, 41, 37}), kDefaultPageShape, kind));
      for (const auto& [azimuth, elevation] : {std::pair{0.0, 0.0}, {90.0, 0.0}, {0.0, 90.0}}) {
        renderer::VolumeView view = view_of("alone: source");
        view.camera = {azimuth, elevation};
        const GreyDifference d = grey_difference(draw_by(renderer::Mode::raycast, *renderer, view),
                                                 draw_by(renderer::Mode::slices, *renderer, view));
        QVERIFY2(d.mean < 0.15 && d.of_99_percent <= 2, words(d));
      }
    }
  }

  void a_volume_beyond_the_limit_of_3d_textures_is_drawn_from_slices() {
    const Scene both = scene(grid({50, 41, 37}));
    const auto whole = renderer_of(both);
    const auto beyond = renderer_of(both, device_without_room());
    renderer::VolumeView view = view_of("surface and source, clip plane");
    view.camera = {33.0, 20.0};
    const renderer::Picture picture = draw_by(renderer::Mode::raycast, *beyond, view);
    QVERIFY(shown(picture, view.background) > 2000);
    QCOMPARE(picture.pixels, draw_by(renderer::Mode::slices, *whole, view).pixels);
    // What is met first is the same, as long as it is not the source.
    view = view_of("surface");
    const glm::dvec2 middle = 0.5 * glm::dvec2(kSize.width, kSize.height);
    const auto expected = whole->pick(view, kSize, middle);
    const auto found = beyond->pick(view, kSize, middle);
    QVERIFY(expected && *expected && found && *found);
    QVERIFY(glm::length((*expected)->voxel - (*found)->voxel) < 1e-3);
  }

  void slice_views_of_a_volume_beyond_the_limit_are_the_same() {
    const Scene both = scene(grid({50, 41, 37}, {1.0, 1.0, 1.3}));
    const auto whole = renderer_of(both);
    const auto beyond = renderer_of(both, device_without_room());
    for (const renderer::SliceOrientation& orientation :
         {renderer::kAxial, renderer::kCoronal, renderer::kSagittal, renderer::oblique({0.5, 0.4, 0.7})}) {
      for (const renderer::SliceContent content :
           {renderer::SliceContent::source, renderer::SliceContent::speed, renderer::SliceContent::pages}) {
        for (const bool nearest : {false, true}) {
          renderer::SliceView view;
          view.orientation = orientation;
          view.content = content;
          view.nearest = nearest;
          view.position_mm = renderer::middle_of(both.source->geometry) + glm::dvec3(0.3, 0.2, 0.4);
          view.window = {200.0, 400.0};
          const GreyDifference d = grey_difference(draw(*whole, view), draw(*beyond, view));
          QVERIFY2(d.mean < 0.01 && d.most <= 2, words(d));
        }
      }
    }
  }

  void a_picture_that_is_stopped_does_no_harm_to_the_next() {
    const auto renderer = renderer_of(scene(grid({50, 41, 37})));
    renderer::VolumeView view = view_of("surface and source");
    view.mode = renderer::Mode::slices;
    const renderer::Picture expected = draw(*renderer, view);
    std::stop_source stop;
    Progress progress;
    progress.stop = stop.get_token();
    progress.report = [&](double fraction, std::string_view) {
      if (fraction > 0.4) stop.request_stop();
    };
    const auto stopped = renderer->draw(view, kSize, progress);
    QVERIFY(!stopped && stopped.error().kind == ErrorKind::cancelled);
    QCOMPARE(draw(*renderer, view).pixels, expected.pixels);
  }

 private:
  // Nearly every pixel is the same; on outlines, where one of the two just misses the surface, a few are not.
  static constexpr double kMostMean = 0.15;
  static void compare(renderer::Renderer& renderer, const renderer::VolumeView& view, const QString& what,
                      double most_mean = kMostMean) {
    const renderer::Picture rays = draw_by(renderer::Mode::raycast, renderer, view);
    const GreyDifference d = grey_difference(rays, draw_by(renderer::Mode::slices, renderer, view));
    const QByteArray from =
        QString("%1 from %2, %3: ").arg(what).arg(view.camera.azimuth).arg(view.camera.elevation).toUtf8();
    QVERIFY2(shown(rays, view.background) > 500, from);
    QVERIFY2(d.mean <= most_mean && d.of_99_percent <= 2, from + words(d));
  }
};

TIDEMARK_TEST(SliceStackTest)

}  // namespace tidemark::test::slice_stack_test

#include "slice_stack_test.moc"
