// Meshes on disk: read again by small parsers of our own.
#include <sys/resource.h>

#include <clocale>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>

#include "fields.h"
#include "imaging/surface/surface.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::mesh_file_test {

namespace {

imaging::Mesh small_ball() {
  Geometry geometry = grid({20, 20, 20}, {0.5, 0.5, 0.75});
  geometry.origin_mm = {-100.25, 3.5, 1000.125};
  return imaging::extract_surface(field(geometry, ball({5, 5, 7}, 3.0))).value();
}

std::string contents(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

template <class T>
T take(const std::string& bytes, std::size_t& at) {
  T value;
  if (at + sizeof(T) > bytes.size()) qFatal("the file is too short");
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  at += sizeof(T);
  return value;
}

}  // namespace

class MeshFileTest : public QObject {
  Q_OBJECT

 private slots:
  void stl_holds_every_triangle_with_its_outward_normal() {
    const TemporaryFolder folder;
    const imaging::Mesh mesh = small_ball();
    QCOMPARE(failure(imaging::write_mesh(mesh, folder / "ball.STL")), QString());
    const std::string bytes = contents(folder / "ball.STL");
    QVERIFY(!bytes.starts_with("solid"));
    QCOMPARE(bytes.size(), 84 + 50 * mesh.triangles.size());
    std::size_t at = 80;
    QCOMPARE(std::size_t{take<std::uint32_t>(bytes, at)}, mesh.triangles.size());
    const glm::dvec3 centre(-95.25, 8.5, 1007.125);
    for (const auto& triangle : mesh.triangles) {
      const auto normal = take<glm::vec3>(bytes, at);
      for (const auto index : triangle) QVERIFY(take<glm::vec3>(bytes, at) == mesh.vertices[index]);
      QCOMPARE(take<std::uint16_t>(bytes, at), std::uint16_t{0});
      QVERIFY(std::abs(glm::length(normal) - 1.0F) < 1e-5F);
      QVERIFY(glm::dot(glm::dvec3(normal), glm::dvec3(mesh.vertices[triangle[0]]) - centre) > 0.0);
    }
  }

  void ply_holds_vertices_and_faces() {
    const TemporaryFolder folder;
    const imaging::Mesh mesh = small_ball();
    QCOMPARE(failure(imaging::write_mesh(mesh, folder / "ball.ply")), QString());
    const std::string bytes = contents(folder / "ball.ply");
    const auto end = bytes.find("end_header\n");
    QVERIFY(end != std::string::npos);
    const std::string header = bytes.substr(0, end);
    QVERIFY(header.starts_with("ply\nformat binary_little_endian 1.0\n"));
    QVERIFY(header.find("LPS") != std::string::npos);
    QVERIFY(header.find("element vertex " + std::to_string(mesh.vertices.size()) + "\n") !=
            std::string::npos);
    QVERIFY(header.find("element face " + std::to_string(mesh.triangles.size()) + "\n") != std::string::npos);
    std::size_t at = end + std::strlen("end_header\n");
    for (const auto& vertex : mesh.vertices) QVERIFY(take<glm::vec3>(bytes, at) == vertex);
    for (const auto& triangle : mesh.triangles) {
      QCOMPARE(int{take<std::uint8_t>(bytes, at)}, 3);
      for (const auto index : triangle) QCOMPARE(take<std::uint32_t>(bytes, at), index);
    }
    QCOMPARE(at, bytes.size());
  }

  void obj_reads_back_to_the_same_floats() {
    const TemporaryFolder folder;
    const imaging::Mesh mesh = small_ball();
    const char* german = std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
    const auto status = imaging::write_mesh(mesh, folder / "ball.obj");
    if (german != nullptr) std::setlocale(LC_NUMERIC, "C");
    QCOMPARE(failure(status), QString());
    std::istringstream stream(contents(folder / "ball.obj"));
    QVERIFY(stream.str().find(',') == std::string::npos);
    imaging::Mesh read;
    for (std::string line; std::getline(stream, line);) {
      std::istringstream words(line);
      std::string kind;
      words >> kind;
      if (kind == "v") {
        std::string x, y, z;
        words >> x >> y >> z;
        read.vertices.emplace_back(std::stof(x), std::stof(y), std::stof(z));
      } else if (kind == "f") {
        std::array<std::uint32_t, 3> f{};
        words >> f[0] >> f[1] >> f[2];
        read.triangles.push_back({f[0] - 1, f[1] - 1, f[2] - 1});
      }
    }
    QVERIFY(read.vertices == mesh.vertices);
    QVERIFY(read.triangles == mesh.triangles);
  }

  void an_empty_mesh_is_a_valid_file() {
    const TemporaryFolder folder;
    for (const char* name : {"none.stl", "none.ply", "none.obj"}) {
      QCOMPARE(failure(imaging::write_mesh(imaging::Mesh{}, folder / name)), QString());
    }
    QCOMPARE(contents(folder / "none.stl").size(), std::size_t{84});
  }

  void a_suffix_that_is_no_mesh_is_refused() {
    QVERIFY(imaging::is_writable_mesh_file("a/b.Ply"));
    QVERIFY(!imaging::is_writable_mesh_file("a.stl.gz"));
    const auto status = imaging::write_mesh(imaging::Mesh{}, "/tmp/mesh.vtk");
    QVERIFY(!status);
    QCOMPARE(status.error().kind, ErrorKind::usage);
  }

  void a_disk_that_is_full_leaves_nothing_behind() {
    const TemporaryFolder folder;
    const imaging::Mesh mesh = small_ball();
    std::signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    QCOMPARE(getrlimit(RLIMIT_FSIZE, &before), 0);
    rlimit small = before;
    small.rlim_cur = 2000;
    for (const char* name : {"ball.stl", "ball.ply", "ball.obj"}) {
      setrlimit(RLIMIT_FSIZE, &small);
      const auto status = imaging::write_mesh(mesh, folder / name);
      setrlimit(RLIMIT_FSIZE, &before);
      QVERIFY(!status);
      QCOMPARE(status.error().kind, ErrorKind::write);
    }
    QVERIFY(std::filesystem::is_empty(folder.path()));
  }
};

TIDEMARK_TEST(MeshFileTest)

}  // namespace tidemark::test::mesh_file_test

#include "mesh_file_test.moc"
