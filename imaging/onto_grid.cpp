#include "imaging/onto_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "core/index_walk.h"

namespace tidemark::imaging {
namespace {

constexpr double kTolerance = 0.1;  // of the smallest spacing: files round their numbers

double tolerance_mm(const Geometry& grid) {
  return kTolerance * std::min({grid.spacing_mm.x, grid.spacing_mm.y, grid.spacing_mm.z});
}

// The axis of one grid along each axis of another, and whether it runs the other way.
struct AxisMap {
  std::array<int, 3> axis{};
  std::array<bool, 3> reversed{};
};

AxisMap match_axes(const Geometry& from, const Geometry& to) {
  AxisMap map;
  for (int a = 0; a < 3; ++a) {
    double best = -1.0;
    for (int b = 0; b < 3; ++b) {
      const double along = glm::dot(to.direction[a], from.direction[b]);
      if (std::abs(along) <= best) continue;
      best = std::abs(along);
      map.axis[static_cast<std::size_t>(a)] = b;
      map.reversed[static_cast<std::size_t>(a)] = along < 0.0;
    }
  }
  return map;
}

// `from` with its axes renamed by the map.
Geometry renamed(const Geometry& from, const AxisMap& map) {
  Geometry result;
  Index3 first(0);
  for (int a = 0; a < 3; ++a) {
    const int b = map.axis[static_cast<std::size_t>(a)];
    const bool reversed = map.reversed[static_cast<std::size_t>(a)];
    result.size[a] = from.size[b];
    result.spacing_mm[a] = from.spacing_mm[b];
    result.direction[a] = reversed ? -from.direction[b] : from.direction[b];
    if (reversed) first[b] = from.size[b] - 1;
  }
  result.origin_mm = from.to_patient(glm::dvec3(first));
  return result;
}

// For each voxel of `to`, the offset of the voxel of `from` at the same place in the patient.
Result<std::vector<std::int64_t>> matching_voxels(const Geometry& from, const Geometry& to,
                                                  const std::string& what) {
  const AxisMap map = match_axes(from, to);
  const Geometry candidate = renamed(from, map);
  if (candidate.size != to.size) {
    return fail(ErrorKind::input, "{}: its grid of {} is not that of the study, {}", what, describe(from),
                describe(to));
  }
  if (!same_grid(candidate, to, tolerance_mm(to))) {
    return fail(ErrorKind::input, "{}: its grid of {} lies elsewhere in the patient than the study's, {}",
                what, describe(from), describe(to));
  }
  const std::array<std::int64_t, 3> from_stride{1, from.size.x, from.size.x * from.size.y};
  std::array<std::int64_t, 3> stride{};
  std::int64_t first = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    const auto b = static_cast<std::size_t>(map.axis[a]);
    stride[a] = map.reversed[a] ? -from_stride[b] : from_stride[b];
    if (map.reversed[a]) first += (from.size[map.axis[a]] - 1) * from_stride[b];
  }
  std::vector<std::int64_t> offsets;
  offsets.reserve(static_cast<std::size_t>(to.voxel_count()));
  for_each_index(Index3(0), to.size, [&](Index3 v) {
    offsets.push_back(first + v.x * stride[0] + v.y * stride[1] + v.z * stride[2]);
  });
  return offsets;
}

}  // namespace

std::string describe(const Geometry& grid) {
  return fmt::format("{} x {} x {} voxels of {:.4g} x {:.4g} x {:.4g} mm", grid.size.x, grid.size.y,
                     grid.size.z, grid.spacing_mm.x, grid.spacing_mm.y, grid.spacing_mm.z);
}

Result<Mask> onto_grid(Mask mask, const Geometry& grid, const std::string& what) {
  if (same_grid(mask.geometry, grid, tolerance_mm(grid))) {
    mask.geometry = grid;
    return mask;
  }
  const auto offsets = matching_voxels(mask.geometry, grid, what);
  if (!offsets) return pass_on(offsets);
  Mask result{grid, std::vector<std::uint8_t>(offsets->size())};
  std::transform(offsets->begin(), offsets->end(), result.voxels.begin(),
                 [&](std::int64_t offset) { return mask.voxels[static_cast<std::size_t>(offset)]; });
  return result;
}

Result<std::vector<float>> onto_grid(const Volume& volume, const Geometry& grid, const std::string& what) {
  if (same_grid(volume.geometry, grid, tolerance_mm(grid))) return volume.values();
  const auto offsets = matching_voxels(volume.geometry, grid, what);
  if (!offsets) return pass_on(offsets);
  std::vector<float> result(offsets->size());
  std::transform(offsets->begin(), offsets->end(), result.begin(),
                 [&](std::int64_t offset) { return volume.value(offset); });
  return result;
}

}  // namespace tidemark::imaging
