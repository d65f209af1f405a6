#include "solver/surface_crossings.h"

namespace tidemark::solver {

Result<std::vector<glm::vec3>> surface_crossings(const Field& phi, const Progress& progress) {
  const Geometry& geometry = phi.geometry;
  const glm::vec3 spacing(geometry.spacing_mm);
  std::vector<glm::vec3> points;
  const bool whole = for_each_voxel(phi, progress, [&](Index3 voxel) {
    const float value = phi.at(voxel);
    if (value <= 0.0F) return;
    for (int side = 0; side < 6; ++side) {
      Index3 step(0);
      step[side / 2] = side % 2 == 0 ? 1 : -1;
      if (!geometry.contains(voxel + step)) continue;
      const float next = phi.at(voxel + step);
      if (next > 0.0F) continue;
      points.push_back((glm::vec3(voxel) + glm::vec3(step) * (value / (value - next))) * spacing);
    }
  });
  if (!whole) return cancelled_error();
  return points;
}

}  // namespace tidemark::solver
