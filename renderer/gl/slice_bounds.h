// The bounds of what slices show; nothing is drawn elsewhere.
#pragma once

#include <glm/mat4x4.hpp>
#include <span>
#include <vector>

#include "core/paging/page_layout.h"
#include "renderer/gl/slice_axis.h"
#include "renderer/picture.h"
#include "renderer/views.h"
#include "solver/paging/page_table.h"

namespace tidemark::renderer {

// The parts of a volume's layers of pages in which a picture has something to show.
class SliceBounds {
 public:
  // All of the volume.
  SliceBounds(const SliceAxis& axis, const PageLayout& pages);
  // What else than phi shows in each page.
  struct PageContents {
    std::span<const glm::vec4> opacity;    // SourcePicture::page_opacities()
    std::span<const std::int32_t> labels;  // LabelPicture::pages(); empty: none are shown
  };
  // Resident pages when the view has a surface, pages where its source or labels show, and those that the
  // clip plane's picture passes, less what the plane hides. `table`: the physical page of each virtual one.
  SliceBounds(const SliceAxis& axis, const PageLayout& pages, const VolumeView& view,
              const Geometry& geometry, std::span<const solver::PhysicalPage> table,
              const PageContents& contents);

  [[nodiscard]] const SliceAxis& axis() const { return axis_; }
  // The part of a slice from which visible places beside it are interpolated.
  [[nodiscard]] gpu::TexelRect voxels(std::int64_t slice) const;
  // The visible part between two slices, along a slice's own axes, in voxel coordinates; perhaps empty.
  struct Across {
    glm::dvec2 low{0.0};
    glm::dvec2 high{0.0};
    [[nodiscard]] bool empty() const { return low.x >= high.x; }
  };
  [[nodiscard]] Across across(std::int64_t slice_a, std::int64_t slice_b) const;
  // The pixels of that between two planes across the axis; empty when it is out of the picture.
  [[nodiscard]] gpu::TexelRect pixels(const Across& across, double plane_a, double plane_b,
                                      const glm::dmat4& view_from_voxel, PictureSize size) const;

 private:
  struct Rect {  // pages of a layer
    std::int64_t low_u = 1, low_v = 1, high_u = 0, high_v = 0;
    [[nodiscard]] bool empty() const { return low_u > high_u; }
    void include(const Rect& other);
  };
  [[nodiscard]] const Rect& layer_of(std::int64_t slice) const {
    return layers_[static_cast<std::size_t>(slice / pages_.page_shape()[axis_.along])];
  }

  SliceAxis axis_;
  PageLayout pages_;
  std::vector<Rect> layers_;
};

}  // namespace tidemark::renderer
