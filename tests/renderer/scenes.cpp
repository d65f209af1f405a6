#include "tests/renderer/scenes.h"

#include <QString>
#include <QtGlobal>
#include <algorithm>

#include "renderer/host/host_renderer.h"

namespace tidemark::test {

Geometry grid(Index3 size, glm::dvec3 spacing) {
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

namespace {

Scene scene_of(const Geometry& geometry, double radius, const std::function<double(glm::dvec3)>& source,
               Index3 page_shape) {
  Scene scene;
  scene.middle = renderer::middle_of(geometry);
  const double unit = std::min({geometry.spacing_mm.x, geometry.spacing_mm.y, geometry.spacing_mm.z});
  const double band = solver::default_band(geometry);
  auto volume = std::make_shared<Volume>();
  volume->geometry = geometry;
  volume->voxels = sample(geometry, source);
  scene.source = volume;
  const auto values = sample(geometry, [&](glm::dvec3 p) {
    return std::clamp((radius - glm::length(p - scene.middle)) / unit, -band, band);
  });
  scene.phi = solver::Field::from_dense(geometry, values, band, page_shape);
  return scene;
}

}  // namespace

Scene ball_scene(const Geometry& geometry, double radius, glm::dvec3 marker, Index3 page_shape) {
  const glm::dvec3 middle = renderer::middle_of(geometry);
  const auto source = [&](glm::dvec3 p) {
    if (glm::length(p - middle - marker) < 4.0) return 1000.0;
    return glm::length(p - middle) < radius ? 100.0 : 0.0;
  };
  return scene_of(geometry, radius, source, page_shape);
}

Scene ball_scene(const Geometry& geometry, double radius, const std::function<double(glm::dvec3)>& source) {
  return scene_of(geometry, radius, source, kDefaultPageShape);
}

std::shared_ptr<gpu::Device> reporting_device(bool as_gpu, std::int64_t largest_volume) {
  auto device = gpu::Device::create_headless({.version = gpu::GlVersion::gl33,
                                              .debug = true,
                                              .as_gpu = as_gpu,
                                              .largest_volume_texture = largest_volume});
  if (!device) qFatal("%s", device.error().message.c_str());
  (*device)->on_message([](bool severe, const std::string& text) {
    if (severe) qFatal("OpenGL: %s", text.c_str());
  });
  return *device;
}

renderer::RendererKind renderer_under_test() {
  const QByteArray name = qgetenv("TIDEMARK_TEST_RENDERER");
  if (name.isEmpty()) return renderer::RendererKind::gl;
  const auto kind = renderer::renderer_named(name.toStdString());
  if (!kind || *kind == renderer::RendererKind::automatic) qFatal("TIDEMARK_TEST_RENDERER is host or gl");
  return *kind;
}

Painter::Painter(const Scene& scene) : Painter(scene, renderer_under_test()) {}

Painter::Painter(const Scene& scene, std::shared_ptr<gpu::Device> device)
    : middle_(scene.middle), device_(std::move(device)) {
  auto renderer = renderer::GlRenderer::create(device_, scene.source, scene.phi.layout);
  if (!renderer) qFatal("%s", renderer.error().message.c_str());
  renderer_ = std::move(*renderer);
  show(scene);
}

Painter::Painter(const Scene& scene, renderer::RendererKind kind, int threads) : middle_(scene.middle) {
  if (kind == renderer::RendererKind::gl) {
    *this = Painter(scene, reporting_device());
    return;
  }
  auto renderer = renderer::HostRenderer::create(scene.source, scene.phi.layout, threads);
  if (!renderer) qFatal("%s", renderer.error().message.c_str());
  renderer_ = std::move(*renderer);
  show(scene);
}

void Painter::show(const Scene& scene) {
  if (const Status shown = renderer_->set_phi(scene.phi); !shown) qFatal("%s", shown.error().message.c_str());
  solver::Parameters parameters;
  parameters.target = 100.0;
  parameters.range = 50.0;
  renderer_->set_parameters(parameters);
}

renderer::Picture Painter::operator()(const renderer::VolumeView& view, std::int64_t width,
                                      std::int64_t height) {
  auto picture = renderer_->draw(view, {width, height});
  if (!picture) qFatal("%s", picture.error().message.c_str());
  return *picture;
}

renderer::Picture Painter::operator()(renderer::SliceView view, std::int64_t width, std::int64_t height) {
  if (view.position_mm == glm::dvec3(0.0)) view.position_mm = middle_;
  auto picture = renderer_->draw(view, {width, height});
  if (!picture) qFatal("%s", picture.error().message.c_str());
  return *picture;
}

GreyDifference grey_difference(const renderer::Picture& a, const renderer::Picture& b) {
  GreyDifference result;
  std::vector<int> pixels;
  for (std::size_t i = 0; i < a.pixels.size(); i += 4) {
    int most = 0;
    for (std::size_t channel = 0; channel < 3; ++channel) {
      const int apart = std::abs(int(a.pixels[i + channel]) - int(b.pixels[i + channel]));
      result.mean += apart;
      most = std::max(most, apart);
    }
    pixels.push_back(most);
  }
  result.mean /= 3.0 * static_cast<double>(pixels.size());
  std::sort(pixels.begin(), pixels.end());
  result.of_99_percent = pixels[pixels.size() * 99 / 100];
  result.most = pixels.back();
  return result;
}

QByteArray words(const GreyDifference& d) {
  return QString("mean %1, 99 % within %2, most %3").arg(d.mean).arg(d.of_99_percent).arg(d.most).toUtf8();
}

glm::ivec3 pixel(const renderer::Picture& picture, std::int64_t x, std::int64_t y) {
  const std::uint8_t* p = picture.pixels.data() + 4 * (x + picture.width * y);
  return {p[0], p[1], p[2]};
}

bool is_yellow(glm::ivec3 colour) {
  return colour.r > 150 && colour.g > 120 && colour.b < 90;
}

bool is_surface(glm::ivec3 colour) {
  return colour.r > 40;
}

bool is_marker(glm::ivec3 colour) {
  return colour.r > 250 && colour.g > 250 && colour.b > 250;
}

std::int64_t count(const renderer::Picture& picture, const PixelTest& test) {
  std::int64_t found = 0;
  for (std::int64_t y = 0; y < picture.height; ++y) {
    for (std::int64_t x = 0; x < picture.width; ++x) found += test(pixel(picture, x, y)) ? 1 : 0;
  }
  return found;
}

glm::dvec2 middle_of_pixels(const renderer::Picture& picture, const PixelTest& test) {
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

renderer::TransferFunction transfer_function(const char* json) {
  auto function = renderer::TransferFunction::parse(json);
  if (!function) qFatal("%s", function.error().message.c_str());
  return *function;
}

}  // namespace tidemark::test
