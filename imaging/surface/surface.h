// The zero set of phi as polygons in patient coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <vector>

#include "core/geometry.h"
#include "core/progress.h"
#include "core/volume.h"

namespace tidemark::imaging {

struct Mesh {
  std::vector<glm::vec3> vertices;                      // patient LPS, mm
  std::vector<std::array<std::uint32_t, 3>> triangles;  // counter-clockwise seen from outside
};

// phi in pages of 8 x 8 x 8 voxels, i fastest: those that the surface is near. The last pages of an axis may
// go beyond the grid. What it refers to must outlive it.
struct PhiPages {
  static constexpr std::int64_t kSide = 8;
  struct Page {
    const float* values = nullptr;  // null: all of it is `constant`
    float constant = 0.0F;
  };

  const Geometry& geometry;
  std::vector<Page> pages;
};

// The surface phi = 0 (phi > 0 inside) at sub-voxel precision: closed, also where it meets the volume's
// border (there it is capped on the outer faces of the border voxels), watertight and oriented outward, for
// right- and left-handed direction matrices alike. `phi` is a float volume. An empty mesh when nothing is
// inside.
Result<Mesh> extract_surface(const Volume& phi);
// The same surface, by memory that follows it.
Result<Mesh> extract_surface(const PhiPages& phi);

[[nodiscard]] double mesh_volume_ml(const Mesh& mesh);  // signed: > 0 when oriented outward
[[nodiscard]] double mesh_area_mm2(const Mesh& mesh);
// The area of the ball of its volume by its area: 1 for a ball (Wadell 1935). 0 without a surface.
[[nodiscard]] double mesh_sphericity(const Mesh& mesh);

// Whether every edge is used as often in one direction as in the other.
[[nodiscard]] bool is_closed_and_oriented(const Mesh& mesh);

// By suffix, case ignored: .stl (binary), .ply (binary little endian), .obj. Coordinates are patient LPS mm,
// said in the file's comment or header where the format has one.
bool is_writable_mesh_file(const std::filesystem::path& file);
Status write_mesh(const Mesh& mesh, const std::filesystem::path& file);

}  // namespace tidemark::imaging
