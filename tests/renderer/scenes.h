// Volumes and level sets whose pictures are known.
#pragma once

#include <QByteArray>
#include <functional>
#include <memory>

#include "gpu/device.h"
#include "renderer/gl/gl_renderer.h"
#include "renderer/renderer.h"

namespace tidemark::test {

Geometry grid(Index3 size, glm::dvec3 spacing = glm::dvec3(1.0));

// A function of the place in the patient (LPS, mm), voxel by voxel.
std::vector<float> sample(const Geometry& geometry, const std::function<double(glm::dvec3)>& function);

struct Scene {
  std::shared_ptr<const Volume> source;
  solver::Field phi;
  glm::dvec3 middle{0.0};
};

// A ball of `radius` mm in the middle, phi its distance in smallest voxels. The source is 100 in it, and 1000
// in a small ball at `marker` from the middle (mm, LPS).
Scene ball_scene(const Geometry& geometry, double radius, glm::dvec3 marker = glm::dvec3(1e6),
                 Index3 page_shape = kDefaultPageShape);
// The same with a source of one's own.
Scene ball_scene(const Geometry& geometry, double radius, const std::function<double(glm::dvec3)>& source);

// A device whose messages of high severity end the test program. `largest_volume` as in gpu::DeviceOptions.
std::shared_ptr<gpu::Device> reporting_device(bool as_gpu = false, std::int64_t largest_volume = 0);

// What TIDEMARK_TEST_RENDERER names, "host" or "gl": test classes about pictures run with both. OpenGL
// without it.
renderer::RendererKind renderer_under_test();

// Draws a scene; ends the test program when something fails.
class Painter {
 public:
  // By the renderer under test.
  explicit Painter(const Scene& scene);
  // By OpenGL on that device, or by the processor with so many threads (0: all).
  Painter(const Scene& scene, std::shared_ptr<gpu::Device> device);
  Painter(const Scene& scene, renderer::RendererKind kind, int threads = 0);

  renderer::Picture operator()(const renderer::VolumeView& view, std::int64_t width, std::int64_t height);
  // A view without a position goes through the middle. T is 100, epsilon 50.
  renderer::Picture operator()(renderer::SliceView view, std::int64_t width, std::int64_t height);
  renderer::Renderer& renderer() { return *renderer_; }
  // Only where OpenGL draws.
  [[nodiscard]] bool is_gl() const { return device_ != nullptr; }
  renderer::GlRenderer& gl() { return dynamic_cast<renderer::GlRenderer&>(*renderer_); }
  gpu::Device& device() { return *device_; }

 private:
  void show(const Scene& scene);

  glm::dvec3 middle_;
  std::shared_ptr<gpu::Device> device_;  // outlives what is drawn with it
  std::unique_ptr<renderer::Renderer> renderer_;
};

// How two pictures differ, in grey levels: over all channels, and of the channel that differs most in a
// pixel.
struct GreyDifference {
  double mean = 0.0;
  int of_99_percent = 0;  // 99 % of the pixels do not exceed it
  int most = 0;
};
GreyDifference grey_difference(const renderer::Picture& a, const renderer::Picture& b);
QByteArray words(const GreyDifference& difference);

glm::ivec3 pixel(const renderer::Picture& picture, std::int64_t x, std::int64_t y);

using PixelTest = std::function<bool(glm::ivec3)>;
bool is_yellow(glm::ivec3 colour);
bool is_surface(glm::ivec3 colour);  // anything but the background of a volume view
bool is_marker(glm::ivec3 colour);   // white

std::int64_t count(const renderer::Picture& picture, const PixelTest& test);
// The middle of the pixels that pass, in -1..1 from left to right and from the bottom up.
glm::dvec2 middle_of_pixels(const renderer::Picture& picture, const PixelTest& test);

// A transfer function from JSON; ends the test program when it is wrong.
renderer::TransferFunction transfer_function(const char* json);

}  // namespace tidemark::test
