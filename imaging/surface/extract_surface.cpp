#include <openvdb/tools/VolumeToMesh.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <new>

#include "imaging/surface/fit_vertices.h"
#include "imaging/surface/surface.h"
#include "imaging/surface/surface_grid.h"

namespace tidemark::imaging {
namespace {

using Quads = std::vector<openvdb::Vec4I>;
using Points = std::vector<openvdb::Vec3s>;

// Splits quads along their shorter diagonal. `flipped` turns the winding round.
void append_quads(Mesh& mesh, const Quads& quads, const std::vector<glm::dvec3>& vertices,
                  const Geometry& geometry, bool flipped) {
  mesh.triangles.reserve(mesh.triangles.size() + 2 * quads.size());
  for (const auto& quad : quads) {
    std::array<std::uint32_t, 4> q{quad[0], quad[1], quad[2], quad[3]};
    if (flipped) std::swap(q[1], q[3]);
    const auto diagonal = [&](std::size_t a, std::size_t b) {
      return glm::length((vertices[q[a]] - vertices[q[b]]) * geometry.spacing_mm);
    };
    if (diagonal(0, 2) <= diagonal(1, 3)) {
      mesh.triangles.push_back({q[0], q[1], q[2]});
      mesh.triangles.push_back({q[0], q[2], q[3]});
    } else {
      mesh.triangles.push_back({q[0], q[1], q[3]});
      mesh.triangles.push_back({q[1], q[2], q[3]});
    }
  }
}

Mesh polygonise(const PhiValues& phi) {
  const Geometry& geometry = phi.geometry();
  Points points;
  Quads quads;
  {
    const auto grid = surface_grid(phi);
    openvdb::tools::volumeToMesh(*grid, points, quads, 0.0);
  }
  std::vector<glm::dvec3> vertices;
  vertices.reserve(points.size());
  for (const auto& point : points) vertices.emplace_back(point[0], point[1], point[2]);
  Mesh mesh;
  // OpenVDB's quads are clockwise seen from outside; a left-handed grid is a mirror and turns them round.
  append_quads(mesh, quads, vertices, geometry, glm::determinant(geometry.direction) > 0.0);
  fit_vertices(phi, mesh.triangles, vertices);
  mesh.vertices.reserve(vertices.size());
  for (const auto& vertex : vertices) mesh.vertices.emplace_back(geometry.to_patient(vertex));
  return mesh;
}

Result<Mesh> surface_of(const PhiValues& phi) {
  const Geometry& geometry = phi.geometry();
  for (int axis = 0; axis < 3; ++axis) {
    if (geometry.size[axis] > std::numeric_limits<int>::max() - 2) {
      return fail(ErrorKind::capability, "surface: {} voxels along an axis are too many",
                  geometry.size[axis]);
    }
  }
  if (geometry.voxel_count() == 0) return Mesh{};
  try {
    return polygonise(phi);
  } catch (const std::bad_alloc&) {
    return fail(ErrorKind::capability, "surface: not enough memory for its polygons");
  } catch (const std::exception& exception) {
    return fail(ErrorKind::internal, "surface: {}", exception.what());
  }
}

}  // namespace

Result<Mesh> extract_surface(const Volume& phi) {
  const auto* values = std::get_if<std::vector<float>>(&phi.voxels);
  if (values == nullptr || static_cast<std::int64_t>(values->size()) != phi.geometry.voxel_count()) {
    return fail(ErrorKind::internal, "surface: phi must be a float volume with a value for every voxel");
  }
  TIDEMARK_TRY(require_finite(phi, "surface"));
  return surface_of(PhiValues(phi.geometry, values->data()));
}

Result<Mesh> extract_surface(const PhiPages& phi) {
  return surface_of(PhiValues(phi));
}

}  // namespace tidemark::imaging
