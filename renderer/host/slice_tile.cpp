#include "renderer/host/slice_tile.h"

#include <glm/common.hpp>

namespace tidemark::renderer {
namespace {

template <class T>
void sample_linear(const SourceSamples& samples, SliceTile& tile) {
  const auto* voxels = static_cast<const T*>(samples.voxels());
  const glm::ivec3 size = samples.size();
  const glm::vec3 last(size - 1);
  const glm::ivec3 last_low = glm::max(size - 2, glm::ivec3(0));
  const std::int64_t row = size.x;
  const std::int64_t slice = row * size.y;
  const std::int64_t x = size.x > 1 ? 1 : 0;
  const std::int64_t y = size.y > 1 ? row : 0;
  const std::int64_t z = size.z > 1 ? slice : 0;
  const float slope = samples.slope();
  const float intercept = samples.intercept();
  for (std::size_t i = 0; i < SliceTile::kPixels; ++i) {
    const glm::vec3 p = glm::clamp(tile.position[i], glm::vec3(0.0F), last);
    const glm::ivec3 low = glm::min(glm::ivec3(p), last_low);
    const glm::vec3 f = p - glm::vec3(low);
    const T* first = voxels + low.x + row * low.y + slice * low.z;
    const auto along_x = [&](const T* at) {
      const float a = static_cast<float>(at[0]);
      return a + f.x * (static_cast<float>(at[x]) - a);
    };
    const auto along_y = [&](const T* at) {
      const float a = along_x(at);
      return a + f.y * (along_x(at + y) - a);
    };
    float stored = along_y(first);
    if (f.z != 0.0F) stored += f.z * (along_y(first + z) - stored);
    tile.source[i] = slope * stored + intercept;
  }
}

template <class T>
void sample_nearest(const SourceSamples& samples, SliceTile& tile) {
  const auto* voxels = static_cast<const T*>(samples.voxels());
  const glm::ivec3 size = samples.size();
  for (std::size_t i = 0; i < SliceTile::kPixels; ++i) {
    const glm::ivec3 v = nearest_voxel(tile.position[i], size);
    const T stored = voxels[v.x + size.x * (v.y + std::int64_t{size.y} * v.z)];
    tile.source[i] = samples.slope() * static_cast<float>(stored) + samples.intercept();
  }
}

template <class T>
void sample(const SourceSamples& samples, bool nearest, SliceTile& tile) {
  if (nearest) {
    sample_nearest<T>(samples, tile);
  } else {
    sample_linear<T>(samples, tile);
  }
}

}  // namespace

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
  for (int y = 0; y < kHeight; ++y) {
    const glm::vec3 begin(corner + plane.up * static_cast<double>(y));
    const glm::vec3 step(plane.right);
    glm::vec3* row = position.data() + static_cast<std::ptrdiff_t>(kWidth) * y;
    for (int x = 0; x < kWidth; ++x) row[x] = begin + step * static_cast<float>(x);
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
  high = glm::min(glm::ivec3(glm::clamp(most + kMargin, glm::dvec3(0.0), end)) + 1, volume - 1);
}

void SliceTile::sample_source(const SourceSamples& samples, bool nearest) {
  switch (samples.stored()) {
    case SourceSamples::Stored::int16:
      return sample<std::int16_t>(samples, nearest, *this);
    case SourceSamples::Stored::uint16:
      return sample<std::uint16_t>(samples, nearest, *this);
    case SourceSamples::Stored::float32:
      return sample<float>(samples, nearest, *this);
  }
}

bool SliceTile::sample_phi(const PhiPages& pages) {
  const glm::ivec3 first = pages.page_of(low);
  const glm::ivec3 last = pages.page_of(high);
  const int one = pages.page_number(first);
  const bool inside = pages.is_inside(one);
  bool uniform = true;
  for (int z = first.z; uniform && z <= last.z; ++z) {
    for (int y = first.y; uniform && y <= last.y; ++y) {
      for (int x = first.x; uniform && x <= last.x; ++x) {
        const int page = pages.page_number({x, y, z});
        uniform = !pages.is_resident(page) && pages.is_inside(page) == inside;
      }
    }
  }
  if (uniform) {
    phi.fill(inside ? pages.band() : -pages.band());
    return false;
  }
  for (std::size_t i = 0; i < kPixels; ++i) phi[i] = pages.between(position[i]);
  return true;
}

}  // namespace tidemark::renderer
