#include "renderer/gl/slice_bounds.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "renderer/view_setup.h"

namespace tidemark::renderer {

void SliceBounds::Rect::include(const Rect& other) {
  if (other.empty()) return;
  if (empty()) {
    *this = other;
    return;
  }
  low_u = std::min(low_u, other.low_u);
  low_v = std::min(low_v, other.low_v);
  high_u = std::max(high_u, other.high_u);
  high_v = std::max(high_v, other.high_v);
}

SliceBounds::SliceBounds(const SliceAxis& axis, const PageLayout& pages)
    : axis_(axis),
      pages_(pages),
      layers_(static_cast<std::size_t>(pages.pages()[axis.along]),
              Rect{0, 0, pages.pages()[axis.u()] - 1, pages.pages()[axis.v()] - 1}) {}

SliceBounds::SliceBounds(const SliceAxis& axis, const PageLayout& pages, const VolumeView& view,
                         const Geometry& geometry, std::span<const solver::PhysicalPage> table,
                         const PageContents& contents)
    : axis_(axis), pages_(pages), layers_(static_cast<std::size_t>(pages.pages()[axis.along])) {
  const bool by_source = shows_source(view);
  const auto source_shows = [&](std::int64_t number) {
    constexpr float kLeastOpacity = 1e-6F;  // as in render/events.glsl
    const solver::PhysicalPage physical = table[static_cast<std::size_t>(number)];
    const glm::vec4 most = contents.opacity[static_cast<std::size_t>(number)];
    return (physical == solver::kOutsidePage  ? most.x
            : physical == solver::kInsidePage ? most.y
                                              : most.z) > kLeastOpacity;
  };
  const VoxelPlane plane = view.clip ? clip_plane_in_voxels(*view.clip, geometry) : VoxelPlane();
  const glm::dvec3 half = 0.5 * glm::dvec3(pages.page_shape());
  for (std::int64_t number = 0; number < pages.page_count(); ++number) {
    const Index3 page = pages.page_coordinates(number);
    const solver::PhysicalPage physical = table[static_cast<std::size_t>(number)];
    // Where the inside meets the volume's border the surface is closed.
    const bool at_border =
        glm::any(glm::equal(page, Index3(0))) || glm::any(glm::equal(page, pages.pages() - Index3(1)));
    bool surface =
        view.surface && (!solver::is_static_page(physical) || (physical == solver::kInsidePage && at_border));
    bool source = by_source && source_shows(number);
    bool labels = !contents.labels.empty() && contents.labels[static_cast<std::size_t>(number)] != 0;
    bool picture = false;
    if (view.clip) {
      const glm::dvec3 middle = glm::dvec3(pages.first_voxel(number)) + half - 0.5;
      const double beyond = glm::dot(plane.normal, middle) - plane.offset;
      const double reach = glm::dot(glm::abs(plane.normal), half);
      surface &= beyond <= reach || !view.clip->clips_surface;
      labels &= beyond <= reach || !view.clip->clips_surface;
      source &= beyond <= reach || !view.clip->clips_source;
      picture = view.clip->picture && std::abs(beyond) <= reach;
    }
    if (!surface && !source && !labels && !picture) continue;
    const std::int64_t u = page[axis.u()];
    const std::int64_t v = page[axis.v()];
    layers_[static_cast<std::size_t>(page[axis.along])].include({u, v, u, v});
  }
}

gpu::TexelRect SliceBounds::voxels(std::int64_t slice) const {
  Rect pages = layer_of(slice);
  pages.include(layer_of(std::max<std::int64_t>(slice - 1, 0)));
  pages.include(layer_of(std::min(slice + 1, axis_.count() - 1)));
  if (pages.empty()) return {};
  // Filtering reaches a voxel further.
  const Index3 shape = pages_.page_shape();
  const auto begin = [&](std::int64_t page, int axis) {
    return std::max<std::int64_t>(page * shape[axis] - 1, 0);
  };
  const auto end = [&](std::int64_t page, int axis) {
    return std::min((page + 1) * shape[axis] + 1, axis_.size[axis]);
  };
  gpu::TexelRect rect{begin(pages.low_u, axis_.u()), begin(pages.low_v, axis_.v())};
  rect.width = end(pages.high_u, axis_.u()) - rect.x;
  rect.height = end(pages.high_v, axis_.v()) - rect.y;
  return rect;
}

SliceBounds::Across SliceBounds::across(std::int64_t slice_a, std::int64_t slice_b) const {
  Rect pages = layer_of(slice_a);
  pages.include(layer_of(slice_b));
  if (pages.empty()) return {};
  // Voxels reach half a voxel beyond their centres.
  const glm::dvec2 shape(pages_.page_shape()[axis_.u()], pages_.page_shape()[axis_.v()]);
  return {glm::dvec2(pages.low_u, pages.low_v) * shape - 0.5,
          glm::dvec2(pages.high_u + 1, pages.high_v + 1) * shape - 0.5};
}

gpu::TexelRect SliceBounds::pixels(const Across& across, double plane_a, double plane_b,
                                   const glm::dmat4& view_from_voxel, PictureSize size) const {
  glm::dvec2 low(1e30);
  glm::dvec2 high(-1e30);
  for (int corner = 0; corner < 8; ++corner) {
    glm::dvec4 p(0.0, 0.0, 0.0, 1.0);
    p[axis_.u()] = (corner & 1) != 0 ? across.high.x : across.low.x;
    p[axis_.v()] = (corner & 2) != 0 ? across.high.y : across.low.y;
    p[axis_.along] = corner < 4 ? plane_a : plane_b;
    const glm::dvec2 pixel =
        (glm::dvec2(view_from_voxel * p) * 0.5 + 0.5) * glm::dvec2(size.width, size.height);
    low = glm::min(low, pixel);
    high = glm::max(high, pixel);
  }
  // A pixel more to each side: rays of later rounds are off the pixels' middles.
  constexpr double kMargin = 1.0;
  const glm::dvec2 all(size.width, size.height);
  low = glm::clamp(glm::floor(low - kMargin), glm::dvec2(0.0), all);
  high = glm::clamp(glm::ceil(high + kMargin), glm::dvec2(0.0), all);
  if (low.x >= high.x || low.y >= high.y) return {};
  return {static_cast<std::int64_t>(low.x), static_cast<std::int64_t>(low.y),
          static_cast<std::int64_t>(high.x - low.x), static_cast<std::int64_t>(high.y - low.y)};
}

}  // namespace tidemark::renderer
