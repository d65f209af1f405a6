#include "renderer/renderer.h"

#include <algorithm>
#include <glm/common.hpp>

#include "gpu/framebuffer.h"
#include "solver/gl/step_uniforms.h"

namespace tidemark {
namespace {

glm::vec3 spacing_of(const Geometry& geometry) {
  return glm::vec3(geometry.spacing_mm);
}

// The plane in voxel coordinates: dot(xyz, voxel) > w is hidden.
glm::vec4 in_voxels(const ClipPlane& plane, const Geometry& geometry) {
  const glm::dvec3 zero = geometry.to_patient(glm::dvec3(0.0));
  glm::dvec4 result(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 one(0.0);
    one[axis] = 1.0;
    result[axis] = glm::dot(plane.normal, geometry.to_patient(one) - zero);
  }
  result.w = plane.offset_mm - glm::dot(plane.normal, zero);
  return glm::vec4(result / glm::length(glm::dvec3(result)));
}

void set_transfer_function(const gpu::Program& program, const TransferFunction& function) {
  program.set("primitive_count", static_cast<int>(function.source.size()));
  for (std::size_t i = 0; i < function.source.size(); ++i) {
    const TransferPrimitive& p = function.source[i];
    const float kind = p.kind == TransferPrimitive::Kind::ramp ? 1.0F : 0.0F;
    program.set(fmt::format("primitive_shape[{}]", i).c_str(), glm::vec4(kind, p.start, p.end, p.opacity));
    program.set(fmt::format("primitive_colour[{}]", i).c_str(), p.colour);
  }
}

}  // namespace

Renderer::Renderer(std::shared_ptr<gpu::Device> device, std::shared_ptr<const Volume> source)
    : device_(std::move(device)), source_(std::move(source)) {}

Result<std::unique_ptr<Renderer>> Renderer::create(std::shared_ptr<gpu::Device> device,
                                                   std::shared_ptr<const Volume> source, const Field& phi) {
  if (auto status = device->make_current(); !status) return pass_on(status);
  std::unique_ptr<Renderer> renderer(new Renderer(std::move(device), std::move(source)));
  gpu::Device& gl = *renderer->device_;
  renderer->vertices_ = gpu::VertexArray::create(gl);
  if (auto status = renderer->set_phi(phi); !status) return pass_on(status);
  ThreadPool pool;
  auto source_picture = SourcePicture::create(gl, *renderer->source_, phi.layout, pool);
  if (!source_picture) return pass_on(source_picture);
  renderer->source_picture_ = std::move(*source_picture);
  const gpu::Defines defines = renderer->phi_picture_.layout().defines();
  auto volume = gpu::Program::render(gl, "render/full_view.vert", "", "render/volume.frag", defines);
  if (!volume) return pass_on(volume);
  renderer->volume_ = std::move(*volume);
  auto slice = gpu::Program::render(gl, "render/full_view.vert", "", "render/slice.frag", defines);
  if (!slice) return pass_on(slice);
  renderer->slice_ = std::move(*slice);
  return renderer;
}

Status Renderer::set_phi(const Field& phi) {
  if (phi.geometry.size != source_->geometry.size) {
    return fail(ErrorKind::usage, "phi and the volume differ in size");
  }
  if (auto status = device_->make_current(); !status) return status;
  auto picture = PhiPicture::create(*device_, phi);
  if (!picture) return pass_on(picture);
  phi_picture_ = std::move(*picture);
  return {};
}

Result<Picture> Renderer::draw(const VolumeView& view, std::int64_t width, std::int64_t height) {
  if (auto status = device_->make_current(); !status) return pass_on(status);
  const Geometry& geometry = source_->geometry;
  volume_.use();
  phi_picture_.set_uniforms(volume_, 0);
  source_picture_.set_uniforms(volume_, 2);
  const double aspect = static_cast<double>(width) / static_cast<double>(height);
  volume_.set("voxel_from_view", glm::mat4(view.camera.voxel_from_view(geometry, aspect)));
  volume_.set("spacing", spacing_of(geometry));
  volume_.set("step_voxels", static_cast<float>(view.step_voxels));
  volume_.set("jitter", 0.5F);
  volume_.set("surface_colour", view.surface_colour);
  volume_.set("show_surface", view.surface ? 1 : 0);
  volume_.set("show_source", view.source ? 1 : 0);
  if (view.source) set_transfer_function(volume_, *view.source);
  volume_.set("region", static_cast<int>(view.region));
  volume_.set("clip", view.clip ? 1 : 0);
  if (view.clip) volume_.set("clip_plane", in_voxels(*view.clip, geometry));
  volume_.set("window", glm::vec2(view.window.centre, view.window.width));
  volume_.set("background", view.background);
  return finish(width, height);
}

Result<Picture> Renderer::draw(const SliceView& view, const Parameters& parameters, std::int64_t width,
                               std::int64_t height) {
  if (auto status = device_->make_current(); !status) return pass_on(status);
  const Geometry& geometry = source_->geometry;
  slice_.use();
  phi_picture_.set_uniforms(slice_, 0);
  source_picture_.set_uniforms(slice_, 2);
  const double aspect = static_cast<double>(width) / static_cast<double>(height);
  slice_.set("voxel_from_view",
             glm::mat4(slice_from_view(geometry, view.plane, view.position_mm, view.zoom, aspect)));
  slice_.set("spacing", spacing_of(geometry));
  slice_.set("window", glm::vec2(view.window.centre, view.window.width));
  slice_.set("content", static_cast<int>(view.content));
  slice_.set("nearest", view.nearest ? 1 : 0);
  slice_.set("show_surface", view.surface ? 1 : 0);
  slice_.set("line_pixels", static_cast<float>(view.line_pixels));
  slice_.set("background", view.background);
  // The speed map shows D; the other constants are not used.
  const StepConstants<float> constants = Model(*source_, parameters).constants<float>();
  slice_.set("target", constants.target);
  slice_.set("data_peak", constants.data_peak);
  slice_.set("data_slope", constants.data_slope);
  slice_.set("data_floor", constants.data_floor);
  return finish(width, height);
}

// Draws with the program in use, and reads the picture.
Result<Picture> Renderer::finish(std::int64_t width, std::int64_t height) {
  if (target_.width() != width || target_.height() != height) {
    auto target = gpu::Texture2D::create(*device_, gpu::TexelFormat::rgba8, width, height, "picture");
    if (!target) return pass_on(target);
    target_ = std::move(*target);
  }
  auto framebuffer = gpu::Framebuffer::create(*device_, {&target_}, "picture");
  if (!framebuffer) return pass_on(framebuffer);
  framebuffer->bind();
  vertices_.bind();
  gpu::begin_exact_drawing();
  gpu::draw(gpu::Primitive::triangles, 3);
  Picture picture;
  picture.width = width;
  picture.height = height;
  picture.pixels.resize(static_cast<std::size_t>(4 * width * height));
  if (auto status =
          target_.download({0, 0, width, height}, std::as_writable_bytes(std::span(picture.pixels)));
      !status) {
    return pass_on(status);
  }
  // OpenGL's rows begin at the bottom.
  const std::int64_t row = 4 * width;
  for (std::int64_t y = 0; y < height / 2; ++y) {
    std::swap_ranges(picture.pixels.begin() + y * row, picture.pixels.begin() + (y + 1) * row,
                     picture.pixels.begin() + (height - 1 - y) * row);
  }
  return picture;
}

}  // namespace tidemark
