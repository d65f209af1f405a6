#include "document/comparison.h"

namespace tidemark::document {

double Comparison::dice() const {
  const std::int64_t sum = voxels + other_voxels;
  return sum == 0 ? 1.0 : 2.0 * static_cast<double>(common) / static_cast<double>(sum);
}

double Comparison::jaccard() const {
  const std::int64_t either = voxels + other_voxels - common;
  return either == 0 ? 1.0 : static_cast<double>(common) / static_cast<double>(either);
}

Result<Comparison> compare(const Region& region, const Region& other, const Geometry& grid,
                           const Progress& progress) {
  Comparison comparison;
  comparison.voxels = region.count();
  comparison.other_voxels = other.count();
  comparison.common = common_count(region, other);
  comparison.voxel_ml = grid.voxel_volume_ml();
  if (progress.cancelled()) return cancelled_error();
  auto distance = solver::MeasuredSurface::of(region, grid)
                      .distance_to(solver::MeasuredSurface::of(other, grid), progress);
  if (!distance) return pass_on(distance);
  comparison.distance = *distance;
  return comparison;
}

}  // namespace tidemark::document
