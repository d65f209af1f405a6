#include "renderer/host/slice_tile.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace tidemark::renderer {

SlicePlane::SlicePlane(const glm::dmat4& voxel_from_view, PictureSize size)
    : right(glm::dvec3(voxel_from_view[0]) * (2.0 / static_cast<double>(size.width))),
      up(glm::dvec3(voxel_from_view[1]) * (2.0 / static_cast<double>(size.height))) {
  first = glm::dvec3(voxel_from_view[3]) - glm::dvec3(voxel_from_view[0]) + 0.5 * right -
          glm::dvec3(voxel_from_view[1]) + 0.5 * up;
}

void SliceTile::place(const SlicePlane& plane, int left_pixel, int bottom_pixel, glm::ivec3 volume) {
  left = left_pixel;
  bottom = bottom_pixel;
  const glm::dvec3 corner = plane.at(left, bottom);
  const glm::vec3 step(plane.right);
  for (int row = 0; row < kHeight; ++row) {
    const glm::vec3 begin(corner + plane.up * static_cast<double>(row));
    const auto from = static_cast<std::size_t>(kWidth * row);
    for (std::size_t column = 0; column < kWidth; ++column) {
      const auto pixels = static_cast<float>(column);
      x[from + column] = begin.x + step.x * pixels;
      y[from + column] = begin.y + step.y * pixels;
      z[from + column] = begin.z + step.z * pixels;
    }
  }
  const glm::dvec3 across = plane.right * static_cast<double>(kWidth - 1);
  const glm::dvec3 along = plane.up * static_cast<double>(kHeight - 1);
  const glm::dvec3 least = corner + glm::min(across, glm::dvec3(0.0)) + glm::min(along, glm::dvec3(0.0));
  const glm::dvec3 most = corner + glm::max(across, glm::dvec3(0.0)) + glm::max(along, glm::dvec3(0.0));
  // A little more, for what rounding moves.
  constexpr double kMargin = 1e-3;
  const glm::dvec3 end(volume - 1);
  low = glm::ivec3(glm::clamp(least - kMargin, glm::dvec3(0.0), end));
  low = glm::min(low, glm::max(volume - 2, glm::ivec3(0)));
  crosses_border = glm::any(glm::lessThan(least, glm::dvec3(kMargin - 0.5))) ||
                   glm::any(glm::greaterThan(most, end + (0.5 - kMargin)));
  high = glm::min(glm::ivec3(glm::clamp(most + kMargin, glm::dvec3(0.0), end)) + 1, volume - 1);
}

bool SliceTile::sample_phi(const PhiPages& pages) {
  const glm::ivec3 first = pages.page_of(low);
  const glm::ivec3 last = pages.page_of(high);
  const bool inside = pages.is_inside(pages.page_number(first));
  const bool differs = any_page(first, last, [&](glm::ivec3 at) {
    const int page = pages.page_number(at);
    return pages.is_resident(page) || pages.is_inside(page) != inside;
  });
  if (!differs) {
    phi.fill(inside ? pages.band() : -pages.band());
    return false;
  }
  for (std::size_t i = 0; i < kPixels; ++i) phi[i] = pages.between(position(i));
  return true;
}

}  // namespace tidemark::renderer
