// Pictures of volumes whose pictures are known.
#include <QTest>
#include <cmath>
#include <functional>
#include <numbers>

#include "gpu/device.h"
#include "renderer/renderer.h"
#include "tests/support/support.h"

using namespace tidemark;
using namespace tidemark::test;

namespace {

Geometry grid(Index3 size, glm::dvec3 spacing = glm::dvec3(1.0)) {
  Geometry geometry;
  geometry.size = size;
  geometry.spacing_mm = spacing;
  return geometry;
}

std::vector<float> sample(const Geometry& geometry, const std::function<double(glm::dvec3)>& function) {
  std::vector<float> values;
  for (std::int64_t z = 0; z < geometry.size.z; ++z) {
    for (std::int64_t y = 0; y < geometry.size.y; ++y) {
      for (std::int64_t x = 0; x < geometry.size.x; ++x) {
        values.push_back(static_cast<float>(function(geometry.to_patient({x, y, z}))));
      }
    }
  }
  return values;
}

struct Scene {
  std::shared_ptr<const Volume> source;
  Field phi;
  glm::dvec3 middle{0.0};
};

// A ball of `radius` mm in the middle, phi its distance in smallest voxels. The source is 100 in it, and 1000
// in a small ball at `marker` from the middle (mm, LPS).
Scene ball_scene(const Geometry& geometry, double radius, glm::dvec3 marker = glm::dvec3(1e6),
                 Index3 page_shape = kDefaultPageShape) {
  Scene scene;
  scene.middle = middle_of(geometry);
  const double unit = std::min({geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z});
  const double band = default_band(geometry);
  auto volume = std::make_shared<Volume>();
  volume->geometry = geometry;
  volume->voxels = sample(geometry, [&](glm::dvec3 p) {
    if (glm::length(p - scene.middle - marker) < 4.0) return 1000.0;
    return glm::length(p - scene.middle) < radius ? 100.0 : 0.0;
  });
  scene.source = volume;
  const auto values = sample(geometry, [&](glm::dvec3 p) {
    return std::clamp((radius - glm::length(p - scene.middle)) / unit, -band, band);
  });
  scene.phi = Field::from_dense(geometry, values, band, page_shape);
  return scene;
}

class Painter {
 public:
  explicit Painter(const Scene& scene) : middle_(scene.middle) {
    auto device = gpu::Device::create_headless({gpu::GlVersion::gl33, true});
    if (!device) qFatal("%s", device.error().message.c_str());
    device_ = *device;
    device_->on_message([](bool severe, const std::string& text) {
      if (severe) qFatal("OpenGL: %s", text.c_str());
    });
    auto renderer = Renderer::create(device_, scene.source, scene.phi);
    if (!renderer) qFatal("%s", renderer.error().message.c_str());
    renderer_ = std::move(*renderer);
  }

  Picture operator()(const VolumeView& view, std::int64_t width, std::int64_t height) {
    auto picture = renderer_->draw(view, width, height);
    if (!picture) qFatal("%s", picture.error().message.c_str());
    return *picture;
  }
  Picture operator()(SliceView view, std::int64_t width, std::int64_t height) {
    if (view.position_mm == glm::dvec3(0.0)) view.position_mm = middle_;
    Parameters parameters;
    parameters.target = 100.0;
    parameters.range = 50.0;
    auto picture = renderer_->draw(view, parameters, width, height);
    if (!picture) qFatal("%s", picture.error().message.c_str());
    return *picture;
  }

 private:
  glm::dvec3 middle_;
  std::shared_ptr<gpu::Device> device_;  // outlives what is drawn with it
  std::unique_ptr<Renderer> renderer_;
};

glm::ivec3 pixel(const Picture& picture, std::int64_t x, std::int64_t y) {
  const std::uint8_t* p = picture.pixels.data() + 4 * (x + picture.width * y);
  return {p[0], p[1], p[2]};
}

bool is_yellow(glm::ivec3 colour) {
  return colour.r > 150 && colour.g > 120 && colour.b < 90;
}

using Test = std::function<bool(glm::ivec3)>;

std::int64_t count(const Picture& picture, const Test& test) {
  std::int64_t found = 0;
  for (std::int64_t y = 0; y < picture.height; ++y) {
    for (std::int64_t x = 0; x < picture.width; ++x) found += test(pixel(picture, x, y)) ? 1 : 0;
  }
  return found;
}

// The middle of the pixels that pass, in -1..1 from left to right and from the bottom up.
glm::dvec2 middle_of_pixels(const Picture& picture, const Test& test) {
  glm::dvec2 sum(0.0);
  double found = 0.0;
  for (std::int64_t y = 0; y < picture.height; ++y) {
    for (std::int64_t x = 0; x < picture.width; ++x) {
      if (!test(pixel(picture, x, y))) continue;
      sum += glm::dvec2(2.0 * (static_cast<double>(x) + 0.5) / static_cast<double>(picture.width) - 1.0,
                        1.0 - 2.0 * (static_cast<double>(y) + 0.5) / static_cast<double>(picture.height));
      ++found;
    }
  }
  return sum / found;
}

const Test kSurface = [](glm::ivec3 c) { return c.r > 40; };
const Test kMarker = [](glm::ivec3 c) { return c.r > 250 && c.g > 250 && c.b > 250; };

}  // namespace

class RendererTest : public QObject {
  Q_OBJECT

 private slots:
  void a_balls_silhouette_has_its_size_from_every_side() {
    const Geometry geometry = grid({64, 64, 64});
    Painter draw(ball_scene(geometry, 20.0));
    VolumeView view;
    for (const auto& [azimuth, elevation] : {std::pair{0.0, 0.0}, {90.0, 0.0}, {0.0, 90.0}, {33.0, -20.0}}) {
      view.camera = {azimuth, elevation, 1.0};
      const Picture picture = draw(view, 256, 256);
      // A pixel's side in mm, from the camera's own matrix.
      const glm::dmat4 matrix = view.camera.voxel_from_view(geometry, 1.0);
      const double side = 2.0 * glm::length(glm::dvec3(matrix[0])) / 256.0;
      const double area = static_cast<double>(count(picture, kSurface)) * side * side;
      QVERIFY2(std::abs(area / (std::numbers::pi * 400.0) - 1.0) < 0.02, qPrintable(QString::number(area)));
      QVERIFY(glm::length(middle_of_pixels(picture, kSurface)) < 0.02);
    }
  }

  void pages_of_any_shape_give_the_same_picture() {
    const Geometry geometry = grid({50, 41, 37});
    std::vector<std::uint8_t> expected;
    for (const Index3 shape : {Index3(8, 8, 8), Index3(16, 16, 1), Index3(4, 4, 4)}) {
      Painter draw(ball_scene(geometry, 14.0, glm::dvec3(1e6), shape));
      VolumeView view;
      view.camera = {25.0, 30.0, 1.0};
      const Picture picture = draw(view, 128, 128);
      if (expected.empty()) expected = picture.pixels;
      std::int64_t different = 0;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        different += std::abs(int(expected[i]) - int(picture.pixels[i])) > 12 ? 1 : 0;
      }
      // Rays are sampled from page to page, so that a few pixels of the outline may differ.
      QVERIFY2(different < 200, qPrintable(QString::number(different)));
    }
  }

  void slices_are_seen_as_radiologists_see_them_data() {
    QTest::addColumn<int>("plane");
    QTest::addColumn<double>("left");  // marker, mm in LPS
    QTest::addColumn<double>("back");
    QTest::addColumn<double>("head");
    QTest::addColumn<double>("x");  // where in the picture
    QTest::addColumn<double>("y");
    QTest::newRow("axial: left is on the right")
        << int(SlicePlane::axial) << 12.0 << 0.0 << 0.0 << 1.0 << 0.0;
    QTest::newRow("axial: back is below") << int(SlicePlane::axial) << 0.0 << 12.0 << 0.0 << 0.0 << -1.0;
    QTest::newRow("coronal: left is on the right")
        << int(SlicePlane::coronal) << 12.0 << 0.0 << 0.0 << 1.0 << 0.0;
    QTest::newRow("coronal: head is above") << int(SlicePlane::coronal) << 0.0 << 0.0 << 12.0 << 0.0 << 1.0;
    QTest::newRow("sagittal: back is on the right")
        << int(SlicePlane::sagittal) << 0.0 << 12.0 << 0.0 << 1.0 << 0.0;
    QTest::newRow("sagittal: head is above") << int(SlicePlane::sagittal) << 0.0 << 0.0 << 12.0 << 0.0 << 1.0;
  }
  void slices_are_seen_as_radiologists_see_them() {
    QFETCH(int, plane);
    QFETCH(double, left);
    QFETCH(double, back);
    QFETCH(double, head);
    QFETCH(double, x);
    QFETCH(double, y);
    // Also when the volume's axes run the other way.
    for (const bool turned : {false, true}) {
      Geometry geometry = grid({40, 40, 40});
      if (turned) geometry.direction = glm::dmat3(-1.0);
      Painter draw(ball_scene(geometry, 1.0, {left, back, head}));
      SliceView view;
      view.plane = static_cast<SlicePlane>(plane);
      view.window = {500.0, 800.0};
      view.surface = false;
      const glm::dvec2 at = middle_of_pixels(draw(view, 160, 160), kMarker);
      QVERIFY(glm::length(at - 0.6 * glm::dvec2(x, y)) < 0.05);
    }
  }

  void thick_slices_look_right_and_the_outline_lies_on_the_surface() {
    const Geometry geometry = grid({60, 60, 16}, {0.5, 0.5, 2.0});
    Painter draw(ball_scene(geometry, 10.0));
    for (const SlicePlane plane : {SlicePlane::axial, SlicePlane::coronal, SlicePlane::sagittal}) {
      SliceView view;
      view.plane = plane;
      view.window = {50.0, 400.0};
      const Picture picture = draw(view, 320, 320);
      const double side = 32.0 / 320.0;  // mm a pixel: the longest side of the volume fills the view
      double least = 1e9;
      double most = 0.0;
      for (std::int64_t y = 0; y < 320; ++y) {
        for (std::int64_t x = 0; x < 320; ++x) {
          if (!is_yellow(pixel(picture, x, y))) continue;
          const double scale = plane == SlicePlane::axial ? 30.0 / 320.0 : side;
          const double r = scale * std::hypot(static_cast<double>(x) - 159.5, static_cast<double>(y) - 159.5);
          least = std::min(least, r);
          most = std::max(most, r);
        }
      }
      QVERIFY2(least > 9.4 && most < 10.6, qPrintable(QString("%1 to %2").arg(least).arg(most)));
    }
  }

  void the_clip_plane_hides_and_shows_the_source() {
    const Geometry geometry = grid({64, 64, 64});
    const Scene scene = ball_scene(geometry, 20.0);
    Painter draw(scene);
    VolumeView view;
    view.clip = ClipPlane{{0.0, -1.0, 0.0}, -scene.middle.y};  // hides the front half
    view.window = {50.0, 200.0};
    const Picture cut = draw(view, 200, 200);
    const glm::ivec3 centre = pixel(cut, 100, 100);  // the source's 100 in its window
    QVERIFY(std::abs(centre.r - centre.g) < 3 && std::abs(centre.r - 191) < 6);
    const std::int64_t yellow = count(cut, is_yellow);
    QVERIFY2(yellow > 150 && yellow < 1500, qPrintable(QString::number(yellow)));
    // From behind, the plane is hidden by what is left.
    view.camera.azimuth = 180.0;
    const Picture back = draw(view, 200, 200);
    QVERIFY(pixel(back, 100, 100).r > pixel(back, 100, 100).b + 20);
  }

  void a_region_of_interest_shows_one_side_only() {
    const Geometry geometry = grid({48, 48, 48});
    Painter draw(ball_scene(geometry, 12.0));
    VolumeView view;
    view.surface = false;
    view.source =
        TransferFunction::parse(
            R"({"source": [{"kind": "ramp", "start": -10, "end": -5, "opacity": 1, "colour": [1, 1, 1]}]})")
            .value();
    view.region = Region::inside;
    const double inside = static_cast<double>(count(draw(view, 200, 200), kSurface));
    view.region = Region::everywhere;
    const double everywhere = static_cast<double>(count(draw(view, 200, 200), kSurface));
    const double pixel_mm = 1.04 * 48.0 / 200.0;
    QVERIFY(std::abs(inside * pixel_mm * pixel_mm / (std::numbers::pi * 144.0) - 1.0) < 0.05);
    QVERIFY(std::abs(everywhere * pixel_mm * pixel_mm / (48.0 * 48.0) - 1.0) < 0.05);
  }

  void the_speed_map_tells_growing_from_shrinking() {
    Painter draw(ball_scene(grid({40, 40, 40}), 10.0));
    SliceView view;
    view.content = SliceContent::speed;
    view.surface = false;
    const Picture picture = draw(view, 120, 120);
    const glm::ivec3 grows = pixel(picture, 60, 60);
    const glm::ivec3 shrinks = pixel(picture, 10, 14);
    QVERIFY(grows.r > grows.b + 80);
    QVERIFY(shrinks.b > shrinks.r + 50);
  }
};

QTEST_APPLESS_MAIN(RendererTest)
#include "renderer_test.moc"
