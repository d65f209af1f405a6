#include "renderer/overview.h"

#include <algorithm>

namespace tidemark {
namespace {

void copy_into(Picture& whole, const Picture& part, std::int64_t left, std::int64_t top) {
  for (std::int64_t y = 0; y < part.height; ++y) {
    std::copy_n(part.pixels.begin() + 4 * y * part.width, 4 * part.width,
                whole.pixels.begin() + 4 * ((top + y) * whole.width + left));
  }
}

}  // namespace

Result<Picture> draw_overview(Renderer& renderer, const WindowLevel& window, glm::dvec3 position_mm,
                              std::int64_t side) {
  Picture whole;
  whole.width = whole.height = 2 * side;
  whole.pixels.resize(static_cast<std::size_t>(4 * whole.width * whole.height));
  struct Place {
    SlicePlane plane;
    std::int64_t column, row;
  };
  for (const Place& place : {Place{SlicePlane::axial, 0, 0}, Place{SlicePlane::coronal, 1, 0},
                             Place{SlicePlane::sagittal, 0, 1}}) {
    SliceView view;
    view.plane = place.plane;
    view.position_mm = position_mm;
    view.window = window;
    const auto picture = renderer.draw(view, Parameters(), side, side);
    if (!picture) return tl::unexpected<Error>(picture.error());
    copy_into(whole, *picture, place.column * side, place.row * side);
  }
  VolumeView view;
  view.camera = {30.0, 20.0, 1.0};
  const auto picture = renderer.draw(view, side, side);
  if (!picture) return tl::unexpected<Error>(picture.error());
  copy_into(whole, *picture, side, side);
  return whole;
}

glm::dvec3 middle_of(const Mask& mask) {
  glm::dvec3 sum(0.0);
  std::int64_t found = 0;
  const Index3 size = mask.geometry.size;
  for (std::int64_t z = 0; z < size.z; ++z) {
    for (std::int64_t y = 0; y < size.y; ++y) {
      for (std::int64_t x = 0; x < size.x; ++x) {
        if (mask.voxels[static_cast<std::size_t>(mask.geometry.offset({x, y, z}))] == 0) continue;
        sum += glm::dvec3(x, y, z);
        ++found;
      }
    }
  }
  return found == 0 ? middle_of(mask.geometry) : mask.geometry.to_patient(sum / static_cast<double>(found));
}

WindowLevel window_of(const Volume& source) {
  if (source.window) return *source.window;
  const auto [low, high] = source.range();
  return {0.5 * (static_cast<double>(low) + static_cast<double>(high)),
          std::max(1.0, static_cast<double>(high) - static_cast<double>(low))};
}

}  // namespace tidemark
