#include "imaging/share_space.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec4.hpp>

namespace tidemark::imaging {
namespace {

// The part of their reach by which boxes overlap at least: touching ones differ by rounding.
constexpr double kOverlap = 1e-6;

glm::dvec3 centre_of(const Geometry& grid) {
  return grid.to_patient(0.5 * (glm::dvec3(grid.size) - 1.0));
}

// Half an edge of the grid's box.
glm::dvec3 half_edge(const Geometry& grid, int axis) {
  return grid.direction[axis] * (0.5 * static_cast<double>(grid.size[axis]) * grid.spacing_mm[axis]);
}

}  // namespace

// Boxes are apart where a plane along two of all their edges is between them (Gottschalk, Lin and Manocha,
// SIGGRAPH 1996).
bool share_space(const Geometry& image, const glm::dmat4& transform, const Geometry& grid) {
  const glm::dvec3 apart(transform * glm::dvec4(centre_of(image), 1.0) - glm::dvec4(centre_of(grid), 1.0));
  std::array<glm::dvec3, 6> edges;
  for (int axis = 0; axis < 3; ++axis) {
    edges[static_cast<std::size_t>(axis)] = glm::dmat3(transform) * half_edge(image, axis);
    edges[static_cast<std::size_t>(axis) + 3] = half_edge(grid, axis);
  }
  for (std::size_t i = 0; i < edges.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const glm::dvec3 normal = glm::cross(edges[i], edges[j]);
      if (normal == glm::dvec3(0.0)) continue;
      double reach = 0.0;
      for (const glm::dvec3& edge : edges) reach += std::abs(glm::dot(edge, normal));
      if (std::abs(glm::dot(apart, normal)) >= (1.0 - kOverlap) * reach) return false;
    }
  }
  return true;
}

}  // namespace tidemark::imaging
