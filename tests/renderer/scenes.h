// Volumes and level sets whose pictures are known.
#pragma once

#include <functional>
#include <memory>

#include "gpu/device.h"
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
                 Index3 page_shape = solver::kDefaultPageShape);
// The same with a source of one's own.
Scene ball_scene(const Geometry& geometry, double radius, const std::function<double(glm::dvec3)>& source);

// A device whose messages of high severity end the test program.
std::shared_ptr<gpu::Device> reporting_device(bool as_gpu = false);

// Draws a scene; ends the test program when something fails.
class Painter {
 public:
  explicit Painter(const Scene& scene, std::shared_ptr<gpu::Device> device = reporting_device());

  renderer::Picture operator()(const renderer::VolumeView& view, std::int64_t width, std::int64_t height);
  // A view without a position goes through the middle. T is 100, epsilon 50.
  renderer::Picture operator()(renderer::SliceView view, std::int64_t width, std::int64_t height);
  renderer::Renderer& renderer() { return *renderer_; }
  gpu::Device& device() { return *device_; }

 private:
  glm::dvec3 middle_;
  std::shared_ptr<gpu::Device> device_;  // outlives what is drawn with it
  std::unique_ptr<renderer::Renderer> renderer_;
};

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
