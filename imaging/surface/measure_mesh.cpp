#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "imaging/surface/surface.h"

namespace tidemark::imaging {

double mesh_volume_ml(const Mesh& mesh) {
  if (mesh.vertices.empty()) return 0.0;
  // The sum of the signed tetrahedra that the triangles make with one point near them (divergence theorem).
  const glm::dvec3 apex(mesh.vertices.front());
  double six_volumes = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    six_volumes +=
        glm::dot(glm::dvec3(mesh.vertices[a]) - apex,
                 glm::cross(glm::dvec3(mesh.vertices[b]) - apex, glm::dvec3(mesh.vertices[c]) - apex));
  }
  return six_volumes / 6.0 / 1000.0;
}

double mesh_area_mm2(const Mesh& mesh) {
  double twice_area = 0.0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::dvec3 p(mesh.vertices[a]);
    twice_area += glm::length(glm::cross(glm::dvec3(mesh.vertices[b]) - p, glm::dvec3(mesh.vertices[c]) - p));
  }
  return twice_area / 2.0;
}

double mesh_sphericity(const Mesh& mesh) {
  const double volume_mm3 = mesh_volume_ml(mesh) * 1000.0;
  const double area_mm2 = mesh_area_mm2(mesh);
  return area_mm2 > 0.0 ? std::cbrt(std::numbers::pi * 36.0 * volume_mm3 * volume_mm3) / area_mm2 : 0.0;
}

bool is_closed_and_oriented(const Mesh& mesh) {
  // Each directed edge as one number; those of one direction and those of the other must be the same list.
  std::vector<std::uint64_t> forward;
  std::vector<std::uint64_t> backward;
  for (const auto& triangle : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint64_t from = triangle[i];
      const std::uint64_t to = triangle[(i + 1) % 3];
      if (from < to) forward.push_back(from << 32 | to);
      if (from > to) backward.push_back(to << 32 | from);
    }
  }
  if (forward.size() != backward.size()) return false;
  std::sort(forward.begin(), forward.end());
  std::sort(backward.begin(), backward.end());
  return forward == backward;
}

}  // namespace tidemark::imaging
