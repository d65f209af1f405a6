// Volume rendering from slices, front to back (paper section 5): a slab between two slices at a time.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "renderer/gl/slice_bounds.h"
#include "renderer/gl/slice_stack.h"
#include "renderer/gl/source_stack.h"
#include "renderer/views.h"

namespace tidemark::renderer {

class SliceCaster {
 public:
  struct Scene {
    const Volume& source;
    const PhiPicture& phi;
    std::span<const solver::PhysicalPage> table;  // of phi's virtual pages
    std::span<const glm::vec4> page_opacity;      // SourcePicture::page_opacities()
    std::span<const std::int32_t> page_labels;    // LabelPicture::pages(); empty: none are shown
  };

  // Texture units: three of phi's, and those from `free` on.
  struct Units {
    int phi = 0;
    int free = 0;
  };

  // The axis that is most along the view's direction: slices are cut across it.
  static SliceAxis axis_for(const VolumeView& view, const Geometry& geometry);

  // With the program of render/slab.frag for that axis, whose uniforms of the view are set. The picture is
  // in layers(), premultiplied. Fails (ErrorKind::cancelled) on a request to stop.
  Status draw(gpu::Device& device, const gpu::Program& slab_program, const Scene& scene,
              const VolumeView& view, PictureSize size, const Units& units, const Progress& progress);

  [[nodiscard]] const gpu::Texture2D& layers() const { return layers_; }
  [[nodiscard]] const DrawReport& report() const { return report_; }

 private:
  // Between two neighbouring slices, or a slice and the volume's face; planes are where it begins and ends.
  struct Slab {
    std::int64_t front_slice, back_slice;
    double front_plane, back_plane;
  };
  static std::vector<Slab> slabs(std::int64_t slices, bool forward);
  Status prepare(gpu::Device& device, const Scene& scene, const SliceAxis& axis, PictureSize size);
  Status show_slices(const gpu::Program& slab_program, const Scene& scene, const VolumeView& view,
                     const SliceBounds& bounds, const Slab& slab, const Units& units, DrawThrottle& throttle);
  Status draw_slab(const gpu::Program& slab_program, const Slab& slab, int steps,
                   const gpu::TexelRect& pixels, DrawThrottle& throttle);

  gpu::Texture2D layers_;
  gpu::Framebuffer framebuffer_;
  gpu::VertexArray vertices_;
  std::array<std::optional<SliceStack>, 3> phi_;  // by axis, made when first needed
  std::array<std::optional<SourceStack>, 3> source_;
  DrawReport report_;
};

}  // namespace tidemark::renderer
