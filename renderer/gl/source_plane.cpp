#include "renderer/gl/source_plane.h"

#include <glm/common.hpp>
#include <variant>

#include "core/thread_pool.h"

namespace tidemark::renderer {
namespace {

// Trilinear; values at the border continue beyond the volume.
template <class Scalar>
double value_between(const std::vector<Scalar>& voxels, const Geometry& geometry, glm::dvec3 position) {
  const glm::dvec3 p = glm::clamp(position, glm::dvec3(0.0), glm::dvec3(geometry.size - Index3(1)));
  const Index3 low(p);
  const Index3 high = glm::min(low + Index3(1), geometry.size - Index3(1));
  const glm::dvec3 f = p - glm::dvec3(low);
  const auto along_x = [&](std::int64_t y, std::int64_t z) {
    return glm::mix(static_cast<double>(voxels[static_cast<std::size_t>(geometry.offset({low.x, y, z}))]),
                    static_cast<double>(voxels[static_cast<std::size_t>(geometry.offset({high.x, y, z}))]),
                    f.x);
  };
  const auto along_xy = [&](std::int64_t z) { return glm::mix(along_x(low.y, z), along_x(high.y, z), f.y); };
  return glm::mix(along_xy(low.z), along_xy(high.z), f.z);
}

}  // namespace

std::vector<float> source_on_plane(const Volume& source, const glm::dmat4& voxel_from_view, PictureSize size,
                                   bool nearest) {
  std::vector<float> values(static_cast<std::size_t>(size.width * size.height));
  const auto row = [&](std::int64_t y) {
    for (std::int64_t x = 0; x < size.width; ++x) {
      const glm::dvec2 pixel(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
      const glm::dvec2 view = 2.0 * pixel / glm::dvec2(size.width, size.height) - 1.0;
      glm::dvec3 p(voxel_from_view * glm::dvec4(view, 0.0, 1.0));
      if (nearest) p = glm::floor(p + 0.5);
      const double stored = std::visit(
          [&](const auto& voxels) { return value_between(voxels, source.geometry, p); }, source.voxels);
      values[static_cast<std::size_t>(x + size.width * y)] =
          static_cast<float>(source.slope * stored + source.intercept);
    }
  };
  ThreadPool().for_each(size.height, 16, [&](std::int64_t begin, std::int64_t end, int) {
    for (std::int64_t y = begin; y < end; ++y) row(y);
  });
  return values;
}

}  // namespace tidemark::renderer
