#include "imaging/registration/pyramid.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "imaging/filters/separable_gaussian.h"
#include "imaging/resample.h"

namespace tidemark::imaging::registration {
namespace {

// The grid of the same place with voxels of about `level_mm`, where they are smaller.
Geometry coarser(const Geometry& grid, double level_mm) {
  Geometry result = grid;
  for (int axis = 0; axis < 3; ++axis) {
    const double length = static_cast<double>(grid.size[axis]) * grid.spacing_mm[axis];
    const auto voxels = static_cast<std::int64_t>(std::ceil(length / level_mm));
    result.size[axis] = std::clamp<std::int64_t>(voxels, 1, grid.size[axis]);
    result.spacing_mm[axis] = length / static_cast<double>(result.size[axis]);
  }
  // Both grids have the same outer faces.
  result.origin_mm = grid.to_patient((result.spacing_mm / grid.spacing_mm - 1.0) * 0.5);
  return result;
}

Result<Volume> reduce(Volume image, double level_mm) {
  const Geometry grid = coarser(image.geometry, level_mm);
  if (grid.size == image.geometry.size) return image;
  auto& values = std::get<std::vector<float>>(image.voxels);
  for (int axis = 0; axis < 3; ++axis) {
    const double factor = grid.spacing_mm[axis] / image.geometry.spacing_mm[axis];
    if (factor > 1.0) convolve_axis(values, image.geometry.size, axis, 0.5 * factor);
  }
  auto resampled = resample(image, glm::dmat4(1.0), grid, "the image");
  if (!resampled) return pass_on(resampled);
  return std::move(resampled->volume);
}

}  // namespace

Result<std::vector<Volume>> make_pyramid(const Volume& image, const Progress& progress) {
  const auto [low, high] = image.common_range();
  Volume level;
  level.geometry = image.geometry;
  std::vector<float> values = image.values();
  for (float& value : values) value = std::clamp(value, low, high);
  level.voxels = std::move(values);

  std::vector<Volume> levels;
  for (auto level_mm = std::rbegin(kLevelsMm); level_mm != std::rend(kLevelsMm); ++level_mm) {
    if (progress.cancelled()) return cancelled_error();
    auto reduced = reduce(std::move(level), *level_mm);
    if (!reduced) return pass_on(reduced);
    level = *reduced;
    levels.push_back(std::move(*reduced));
  }
  std::reverse(levels.begin(), levels.end());
  return levels;
}

glm::dvec3 centre_mm(const Geometry& grid) {
  return grid.to_patient(glm::dvec3(grid.size - Index3(1)) * 0.5);
}

}  // namespace tidemark::imaging::registration
