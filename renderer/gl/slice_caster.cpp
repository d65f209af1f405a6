#include "renderer/gl/slice_caster.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "core/stopwatch.h"
#include "renderer/view_setup.h"

namespace tidemark::renderer {
namespace {

// From the viewer into the volume, along its axes.
glm::dvec3 direction_in_voxels(const VolumeView& view, const Geometry& geometry) {
  return glm::normalize(glm::dvec3(view.camera.voxel_from_view(geometry, 1.0)[2]));
}

SliceBounds bounds_of(const SliceAxis& axis, const SliceCaster::Scene& scene, const VolumeView& view) {
  const PageLayout& pages = scene.phi.layout().layout();
  if (!view.quality.skip_empty) return {axis, pages};
  return {axis, pages, view, scene.source.geometry, scene.table, {scene.page_opacity, scene.page_labels}};
}

}  // namespace

SliceAxis SliceCaster::axis_for(const VolumeView& view, const Geometry& geometry) {
  // In mm: where slices are thick fewer of them are needed so.
  const glm::dvec3 mm = glm::abs(direction_in_voxels(view, geometry) * geometry.spacing_mm);
  return {mm.z >= mm.x && mm.z >= mm.y ? 2 : mm.y >= mm.x ? 1 : 0, geometry.size};
}

// From the front: half a voxel up to the first slice, from slice to slice, half a voxel behind the last one.
std::vector<SliceCaster::Slab> SliceCaster::slabs(std::int64_t slices, bool forward) {
  std::vector<Slab> all;
  const auto last = static_cast<double>(slices - 1);
  for (std::int64_t i = 0; i <= slices; ++i) {
    Slab slab{std::max<std::int64_t>(i - 1, 0), std::min(i, slices - 1),
              std::max(static_cast<double>(i - 1), -0.5), std::min(static_cast<double>(i), last + 0.5)};
    if (!forward) {
      slab = {slices - 1 - slab.front_slice, slices - 1 - slab.back_slice, last - slab.front_plane,
              last - slab.back_plane};
    }
    all.push_back(slab);
  }
  return all;
}

Status SliceCaster::prepare(gpu::Device& device, const Scene& scene, const SliceAxis& axis,
                            PictureSize size) {
  if (PictureSize{layers_.width(), layers_.height()} != size) {
    // Full precision: what many thin layers add would be lost in half of it.
    auto layers =
        gpu::Texture2D::create(device, gpu::TexelFormat::rgba32f, size.width, size.height, "layers");
    if (!layers) return pass_on(layers);
    layers_ = std::move(*layers);
    auto framebuffer = gpu::Framebuffer::create(device, {&layers_}, "layers");
    if (!framebuffer) return pass_on(framebuffer);
    framebuffer_ = std::move(*framebuffer);
    vertices_ = gpu::VertexArray::create(device);
  }
  // A camera that turns to and fro makes no slices anew, unless they are large.
  constexpr std::int64_t kLargeSlice = std::int64_t{1}
                                       << 20;  // texels; 16 bytes each, and four of them an axis
  for (std::size_t other = 0; other < 3; ++other) {
    if (other == static_cast<std::size_t>(axis.along) || axis.width() * axis.height() < kLargeSlice) continue;
    phi_[other].reset();
    source_[other].reset();
  }
  auto& phi = phi_[static_cast<std::size_t>(axis.along)];
  if (!phi) {
    auto stack = SliceStack::create(device, scene.phi.layout(), axis);
    if (!stack) return pass_on(stack);
    phi = std::move(*stack);
  }
  auto& source = source_[static_cast<std::size_t>(axis.along)];
  if (!source) {
    auto stack = SourceStack::create(device, scene.source, axis);
    if (!stack) return pass_on(stack);
    source = std::move(*stack);
  }
  phi->begin(scene.table);
  source->begin();
  return {};
}

Status SliceCaster::draw(gpu::Device& device, const gpu::Program& slab_program, const Scene& scene,
                         const VolumeView& view, PictureSize size, const Units& units,
                         const Progress& progress) {
  const Stopwatch whole;
  const Geometry& geometry = scene.source.geometry;
  const SliceAxis axis = axis_for(view, geometry);
  TIDEMARK_TRY(prepare(device, scene, axis, size));
  const SliceBounds bounds = bounds_of(axis, scene, view);
  const glm::dmat4 view_from_voxel = glm::inverse(view.camera.voxel_from_view(geometry, size.aspect()));
  const double along = direction_in_voxels(view, geometry)[axis.along];
  DrawThrottle throttle(device, progress);
  framebuffer_.bind();
  gpu::clear_colours(1);
  const std::vector<Slab> all = slabs(axis.count(), along > 0.0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Slab& slab = all[i];
    const SliceBounds::Across across = bounds.across(slab.front_slice, slab.back_slice);
    if (across.empty()) continue;
    const gpu::TexelRect pixels =
        bounds.pixels(across, slab.front_plane, slab.back_plane, view_from_voxel, size);
    if (pixels.width == 0) continue;
    TIDEMARK_TRY(show_slices(slab_program, scene, view, bounds, slab, units, throttle));
    const double length = std::abs((slab.back_plane - slab.front_plane) / along);  // of a ray, in voxels
    const int steps = std::max(1, static_cast<int>(std::ceil(length / view.quality.step_voxels - 0.01)));
    slab_program.set("low_across", glm::vec2(across.low));
    slab_program.set("high_across", glm::vec2(across.high));
    slab_program.set("steps", steps);
    TIDEMARK_TRY(draw_slab(slab_program, slab, steps, pixels, throttle));
    progress(static_cast<double>(i + 1) / static_cast<double>(all.size()), "drawing");
  }
  TIDEMARK_TRY(throttle.wait());
  report_ = throttle.report();
  const bool in_one = report_.pieces == 0;  // a GPU is not waited for
  report_.seconds = whole.seconds();
  if (in_one) {
    report_.pieces = 1;
    report_.longest_piece_seconds = report_.seconds;
  }
  return device.check("drawing a picture from slices");
}

// Makes sure that the slab's two slices are there, and binds them.
Status SliceCaster::show_slices(const gpu::Program& slab_program, const Scene& scene, const VolumeView& view,
                                const SliceBounds& bounds, const Slab& slab, const Units& units,
                                DrawThrottle& throttle) {
  const auto along = static_cast<std::size_t>(bounds.axis().along);
  SliceStack& phi = *phi_[along];
  SourceStack& source = *source_[along];
  const bool by_phi = needs_phi(view);
  const bool by_source = needs_source(view);
  for (const std::int64_t slice : {slab.front_slice, slab.back_slice}) {
    if (by_phi) {
      TIDEMARK_TRY(phi.reconstruct(scene.phi, slice, units.phi, units.free, throttle));
    }
    if (by_source) {
      auto status = source.prepare(scene.source, slice, bounds.voxels(slice), units.free, throttle);
      if (!status) return status;
    }
  }
  slab_program.use();
  // Also what this picture does not look at: samplers of two kinds must not be left on one unit.
  int next = units.free;
  const auto show = [&](const char* name, const gpu::Texture2D& texture) {
    slab_program.set(name, next);
    texture.bind(static_cast<unsigned>(next++));
  };
  show("phi_front", phi.texture(slab.front_slice));
  show("phi_back", phi.texture(slab.back_slice));
  show("source_front", source.texture(slab.front_slice));
  show("source_back", source.texture(slab.back_slice));
  return {};
}

Status SliceCaster::draw_slab(const gpu::Program& slab_program, const Slab& slab, int steps,
                              const gpu::TexelRect& pixels, DrawThrottle& throttle) {
  slab_program.set("front_slice", static_cast<float>(slab.front_slice));
  slab_program.set("back_slice", static_cast<float>(slab.back_slice));
  slab_program.set("front_plane", static_cast<float>(slab.front_plane));
  slab_program.set("back_plane", static_cast<float>(slab.back_plane));
  framebuffer_.bind();
  vertices_.bind();
  gpu::begin_exact_drawing();
  const gpu::BlendScope under(gpu::Blending::under);
  return throttle.rectangle(slab_program, pixels, steps, [](const gpu::TexelRect& part) {
    const gpu::ScissorScope scissor(part);
    gpu::draw(gpu::Primitive::triangles, 3);
  });
}

}  // namespace tidemark::renderer
