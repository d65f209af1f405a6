#include "renderer/host/page_kinds.h"

#include <glm/vector_relational.hpp>

#include "renderer/host/shade_pieces.h"

namespace tidemark::renderer {

namespace {

// The opacity of a piece up to which its light may come from one place: 1 of 255 levels over a hundred of
// them.
constexpr float kFaint = 0.004F;

// log2 of how many steps a piece may take.
std::uint8_t strides_of(float opacity, float step_mm) {
  std::uint8_t strides = 0;
  while (strides < 2 && opacity * step_mm * static_cast<float>(2 << strides) <= kFaint) ++strides;
  return strides;
}

}  // namespace

PageKinds::PageKinds(HostScene& scene, const VolumeView& view, float step_mm) {
  const PhiPages& phi = scene.phi;
  const bool source = shows_source(view);
  const bool by_phi = needs_phi(view);
  if (source) {
    scene.opacity.set_transfer_function(scene.source.volume(), *view.source, view.region,
                                        static_cast<double>(phi.band()));
  }
  const auto kind_of = [&](int page) {
    const bool resident = phi.is_resident(page);
    std::uint8_t kind = resident && by_phi ? kPhi : 0;
    if (source) {
      const glm::vec4 opacity = scene.opacity.pages()[static_cast<std::size_t>(page)];
      const float most = resident ? opacity.z : phi.is_inside(page) ? opacity.y : opacity.x;
      if (most > kLeastOpacity || !view.quality.skip_empty) kind |= kSource;
      if (most > kLeastOpacity && view.quality.skip_empty) {
        kind |= static_cast<std::uint8_t>(strides_of(most, step_mm) << kStrideShift);
      }
      if (most <= kLeastOpacity && !view.surface) kind &= static_cast<std::uint8_t>(~kPhi);
    }
    return kind;
  };
  const bool labels = scene.labels.pages().show_at(view.label_opacity);
  const glm::ivec3 grid = phi.page_grid();
  const auto is_seen = [&](int page, glm::ivec3 at) {
    if (kinds_[static_cast<std::size_t>(page)] != 0 || !view.quality.skip_empty) return true;
    if (labels && scene.labels.pages().pages()[static_cast<std::size_t>(page)] != 0) return true;
    // The surface is closed where its inside meets the volume's border.
    const bool on_border = glm::any(glm::equal(at, glm::ivec3(0))) || glm::any(glm::equal(at + 1, grid));
    return on_border && view.surface && phi.is_inside(page);
  };
  cube_grid_ = (grid + kSide - 1) / kSide;
  kinds_.resize(static_cast<std::size_t>(grid.x) * grid.y * grid.z);
  cubes_.assign(static_cast<std::size_t>(cube_grid_.x) * cube_grid_.y * cube_grid_.z, 0);
  int page = 0;
  for (int z = 0; z < grid.z; ++z) {
    for (int y = 0; y < grid.y; ++y) {
      std::uint8_t* cubes = cubes_.data() + cube_grid_.x * (y / kSide + cube_grid_.y * (z / kSide));
      for (int x = 0; x < grid.x; ++x, ++page) {
        kinds_[static_cast<std::size_t>(page)] = kind_of(page);
        cubes[x / kSide] |= kinds_[static_cast<std::size_t>(page)];
        if (is_seen(page, {x, y, z})) seen_.emplace_back(x, y, z);
      }
    }
  }
}

}  // namespace tidemark::renderer
