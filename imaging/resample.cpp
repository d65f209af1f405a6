#include "imaging/resample.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <new>

#include "core/large_pages.h"
#include "core/thread_pool.h"
#include "imaging/onto_grid.h"

namespace tidemark::imaging {
namespace {

constexpr std::int64_t kRowsPerPiece = 16;

// From voxels of the grid to voxels of the image: linear * voxel + shift.
struct VoxelMap {
  glm::dmat3 linear{1.0};
  glm::dvec3 shift{0.0};
};

Result<VoxelMap> make_map(const Geometry& image, const glm::dmat4& transform, const Geometry& grid,
                          const std::string& what) {
  const glm::dmat4 back = glm::inverse(transform);
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) {
      if (!std::isfinite(back[column][row])) {
        return fail(ErrorKind::usage, "{}: its transform cannot be inverted", what);
      }
    }
  }
  const auto place = [&](glm::dvec3 voxel) {
    return image.to_voxel(glm::dvec3(back * glm::dvec4(grid.to_patient(voxel), 1.0)));
  };
  VoxelMap map;
  map.shift = place(glm::dvec3(0.0));
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 unit(0.0);
    unit[axis] = 1.0;
    map.linear[axis] = place(unit) - map.shift;
  }
  return map;
}

// The two voxels between which a place lies along one axis; nothing outside of the image.
struct BetweenVoxels {
  std::int64_t low = 0;
  std::int64_t high = 0;
  double part = 0.0;  // of the higher one
};

bool find(double place, std::int64_t voxels, BetweenVoxels& between) {
  if (!(place >= -0.5 && place <= static_cast<double>(voxels) - 0.5)) return false;
  const double inside = std::clamp(place, 0.0, static_cast<double>(voxels - 1));
  between.low = static_cast<std::int64_t>(inside);
  between.high = std::min(between.low + 1, voxels - 1);
  between.part = inside - static_cast<double>(between.low);
  return true;
}

// The stored value at a place in voxels; false outside of the image.
template <class Voxel>
bool interpolate(const Geometry& image, const Voxel* voxels, glm::dvec3 place, double& value) {
  std::array<BetweenVoxels, 3> at;
  for (int axis = 0; axis < 3; ++axis) {
    if (!find(place[axis], image.size[axis], at[static_cast<std::size_t>(axis)])) return false;
  }
  const auto along = [&](std::int64_t j, std::int64_t k) {
    const Voxel* row = voxels + number_in(image.size, Index3(0, j, k));
    const auto low = static_cast<double>(row[at[0].low]);
    return low + at[0].part * (static_cast<double>(row[at[0].high]) - low);
  };
  const auto across = [&](std::int64_t k) {
    const double low = along(at[1].low, k);
    return low + at[1].part * (along(at[1].high, k) - low);
  };
  const double low = across(at[2].low);
  value = low + at[2].part * (across(at[2].high) - low);
  return true;
}

// Fills the rows of the result where the image covers them.
template <class Voxel>
Status fill(const Volume& image, const std::vector<Voxel>& voxels, const VoxelMap& map, const Geometry& grid,
            std::vector<float>& values, Region& covered, const Progress& progress) {
  ThreadPool pool;
  // One slice after another, so that progress and cancelling need no thread of the pool.
  for (std::int64_t k = 0; k < grid.size.z; ++k) {
    if (progress.cancelled()) return cancelled_error();
    progress(static_cast<double>(k) / static_cast<double>(grid.size.z), "resampling");
    pool.for_each(grid.size.y, kRowsPerPiece, [&](std::int64_t begin, std::int64_t end, int) {
      for (std::int64_t j = begin; j < end; ++j) {
        const glm::dvec3 row = map.linear * glm::dvec3(0.0, j, k) + map.shift;
        float* out = values.data() + grid.offset({0, j, k});
        for (std::int64_t i = 0; i < grid.size.x; ++i) {
          double stored = 0.0;
          const glm::dvec3 place = row + static_cast<double>(i) * map.linear[0];
          if (!interpolate(image.geometry, voxels.data(), place, stored)) continue;
          out[i] = static_cast<float>(image.slope * stored + image.intercept);
          covered.add({i, j, k});
        }
      }
    });
  }
  return {};
}

}  // namespace

Result<Resampled> resample(const Volume& image, const glm::dmat4& transform, const Geometry& grid,
                           const std::string& what, const Progress& progress, std::optional<float> outside) {
  const auto map = make_map(image.geometry, transform, grid, what);
  if (!map) return pass_on(map);
  Resampled result;
  result.volume.geometry = grid;
  result.volume.modality = image.modality;
  result.volume.unit = image.unit;
  result.volume.description = image.description;
  result.volume.window = image.window;
  result.volume.changes = image.changes;
  try {
    const float background = outside ? *outside : image.range().first;
    auto values = make_large_vector(static_cast<std::size_t>(grid.voxel_count()), background);
    result.covered = Region(VoxelRange{Index3(0), grid.size});
    const Status filled = std::visit(
        [&](const auto& voxels) { return fill(image, voxels, *map, grid, values, result.covered, progress); },
        image.voxels);
    if (!filled) return pass_on(filled);
    if (result.covered.empty()) {
      return fail(ErrorKind::usage, "{}: its {} lie elsewhere in the patient than the study's {}", what,
                  describe(image.geometry), describe(grid));
    }
    result.volume.voxels = std::move(values);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "{}: not enough memory for it on {}", what, describe(grid));
  }
  return result;
}

std::optional<double> value_at(const Volume& image, glm::dvec3 patient_mm) {
  const glm::dvec3 place = image.geometry.to_voxel(patient_mm);
  double stored = 0.0;
  const bool is_inside = std::visit(
      [&](const auto& voxels) { return interpolate(image.geometry, voxels.data(), place, stored); },
      image.voxels);
  if (!is_inside) return std::nullopt;
  return image.slope * stored + image.intercept;
}

}  // namespace tidemark::imaging
