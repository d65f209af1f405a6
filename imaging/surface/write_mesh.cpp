#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>
#include <glm/geometric.hpp>
#include <limits>

#include "core/atomic_file.h"
#include "imaging/surface/surface.h"

namespace tidemark::imaging {
namespace {

static_assert(std::endian::native == std::endian::little, "STL and PLY are written in memory order");

constexpr std::size_t kMostTriangles = std::numeric_limits<std::uint32_t>::max();

template <class T>
void append(std::string& bytes, const T& value) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

// 80 bytes of text (not "solid", which would say ASCII), the number of triangles, then for each its normal,
// its corners and two bytes of 0.
std::string stl(const Mesh& mesh) {
  std::string bytes = "Binary STL by Tidemark; patient coordinates LPS in mm";
  bytes.resize(80, ' ');
  bytes.reserve(84 + 50 * mesh.triangles.size());
  append(bytes, static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const auto& [a, b, c] : mesh.triangles) {
    const glm::vec3 p = mesh.vertices[a];
    const glm::vec3 q = mesh.vertices[b];
    const glm::vec3 r = mesh.vertices[c];
    const glm::dvec3 normal = glm::cross(glm::dvec3(q) - glm::dvec3(p), glm::dvec3(r) - glm::dvec3(p));
    const double length = glm::length(normal);
    append(bytes, length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0F));
    append(bytes, p);
    append(bytes, q);
    append(bytes, r);
    append(bytes, std::uint16_t{0});
  }
  return bytes;
}

std::string ply(const Mesh& mesh) {
  std::string bytes = fmt::format(
      "ply\nformat binary_little_endian 1.0\ncomment written by Tidemark; patient coordinates LPS in mm\n"
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "element face {}\nproperty list uchar uint vertex_indices\nend_header\n",
      mesh.vertices.size(), mesh.triangles.size());
  bytes.reserve(bytes.size() + 12 * mesh.vertices.size() + 13 * mesh.triangles.size());
  for (const glm::vec3& vertex : mesh.vertices) append(bytes, vertex);
  for (const auto& triangle : mesh.triangles) {
    append(bytes, std::uint8_t{3});
    append(bytes, triangle);
  }
  return bytes;
}

std::string obj(const Mesh& mesh) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  fmt::format_to(out, "# written by Tidemark; patient coordinates LPS in mm\n");
  for (const glm::vec3& v : mesh.vertices) fmt::format_to(out, "v {} {} {}\n", v.x, v.y, v.z);
  for (const auto& [a, b, c] : mesh.triangles) {  // OBJ counts from 1
    fmt::format_to(out, "f {} {} {}\n", std::uint64_t{a} + 1, std::uint64_t{b} + 1, std::uint64_t{c} + 1);
  }
  return fmt::to_string(text);
}

std::string suffix_of(const std::filesystem::path& file) {
  std::string suffix = file.extension().string();
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return suffix;
}

}  // namespace

bool is_writable_mesh_file(const std::filesystem::path& file) {
  const std::string suffix = suffix_of(file);
  return suffix == ".stl" || suffix == ".ply" || suffix == ".obj";
}

Status write_mesh(const Mesh& mesh, const std::filesystem::path& file) {
  if (!is_writable_mesh_file(file)) {
    return fail(ErrorKind::usage, "{}: cannot write this format: use .stl, .ply or .obj", file.string());
  }
  if (mesh.triangles.size() > kMostTriangles) {
    return fail(ErrorKind::write, "{}: cannot write: {} triangles are too many", file.string(),
                mesh.triangles.size());
  }
  const std::string suffix = suffix_of(file);
  return write_file(file, suffix == ".stl" ? stl(mesh) : suffix == ".ply" ? ply(mesh) : obj(mesh));
}

}  // namespace tidemark::imaging
