// Segments as polygons: a file each, named after it, all or none.
#include "document/segment_meshes.h"

#include <QFile>
#include <cstring>
#include <glm/geometric.hpp>

#include "cases.h"
#include "document/label_segments.h"
#include "solver/distance_transform.h"
#include "tests/support/test_program.h"

namespace tidemark::test::segment_meshes_test {

namespace {

namespace fs = std::filesystem;

// A grid that is neither even nor along the patient's axes.
Geometry oblique_grid() {
  Geometry geometry;
  geometry.size = {40, 30, 20};
  geometry.spacing_mm = {0.8, 0.8, 2.0};
  geometry.origin_mm = {-40.0, 12.0, 300.0};
  geometry.direction = glm::dmat3({0.6, 0.8, 0.0}, {-0.8, 0.6, 0.0}, {0.0, 0.0, 1.0});
  return geometry;
}

Mask ball_at(const Geometry& geometry, glm::dvec3 voxel, double radius_mm) {
  Mask mask{geometry, {}};
  const glm::dvec3 middle = geometry.to_patient(voxel);
  for (std::int64_t k = 0; k < geometry.size.z; ++k) {
    for (std::int64_t j = 0; j < geometry.size.y; ++j) {
      for (std::int64_t i = 0; i < geometry.size.x; ++i) {
        mask.voxels.push_back(glm::distance(geometry.to_patient({i, j, k}), middle) < radius_mm ? 1 : 0);
      }
    }
  }
  return mask;
}

double volume_ml(const Mask& mask) {
  return static_cast<double>(mask.count()) * mask.geometry.voxel_volume_ml();
}

// Of a binary STL file: six times the volumes of the tetrahedra to the origin.
double stl_volume_ml(const fs::path& file) {
  QFile stl(QString::fromStdString(file.string()));
  if (!stl.open(QIODevice::ReadOnly)) return 0.0;
  const QByteArray bytes = stl.readAll();
  double sum = 0.0;
  for (qsizetype at = 84; at + 50 <= bytes.size(); at += 50) {
    float numbers[12];
    std::memcpy(numbers, bytes.constData() + at, sizeof(numbers));
    const glm::dvec3 a(numbers[3], numbers[4], numbers[5]);
    const glm::dvec3 b(numbers[6], numbers[7], numbers[8]);
    const glm::dvec3 c(numbers[9], numbers[10], numbers[11]);
    sum += glm::dot(a, glm::cross(b, c)) / 6000.0;
  }
  return sum;
}

}  // namespace

class SegmentMeshesTest : public QObject {
  Q_OBJECT

 private slots:
  // Only the part around the mask is computed.
  void a_part_of_the_grid_has_the_surface_of_the_whole_data() {
    QTest::addColumn<glm::dvec3>("voxel");
    QTest::newRow("inside") << glm::dvec3(20.0, 15.0, 10.0);
    QTest::newRow("at the border") << glm::dvec3(1.0, 28.0, 10.0);
  }
  void a_part_of_the_grid_has_the_surface_of_the_whole() {
    QFETCH(glm::dvec3, voxel);
    const Mask mask = ball_at(oblique_grid(), voxel, 6.0);
    const auto part = document::mesh_of(mask);
    const auto whole = imaging::extract_surface(
        solver::distance_transform(mask, document::surface_band(mask.geometry)).to_volume());
    QCOMPARE(failure(part), QString());
    QCOMPARE(failure(whole), QString());
    QVERIFY(imaging::is_closed_and_oriented(*part));
    QCOMPARE(part->triangles.size(), whole->triangles.size());
    QVERIFY(std::abs(imaging::mesh_volume_ml(*part) - imaging::mesh_volume_ml(*whole)) < 1e-5);
    QVERIFY(std::abs(imaging::mesh_area_mm2(*part) - imaging::mesh_area_mm2(*whole)) < 1e-2);
    glm::dvec3 of_part(0.0);
    glm::dvec3 of_whole(0.0);
    for (const glm::vec3& v : part->vertices) of_part += v;
    for (const glm::vec3& v : whole->vertices) of_whole += v;
    QVERIFY(glm::distance(of_part, of_whole) < 1e-3 * static_cast<double>(part->vertices.size()));
  }

  void pages_have_the_surface_of_all_voxels() {
    const Mask mask = ball_at(oblique_grid(), {1.0, 28.0, 10.0}, 9.0);  // at the border
    for (const Index3 shape : {Index3(8, 8, 8), Index3(16, 16, 1)}) {
      const solver::Field phi = solver::distance_transform(mask, 2.5, shape);
      const auto of_pages = document::mesh_of(phi);
      const auto of_all = imaging::extract_surface(phi.to_volume());
      QCOMPARE(failure(of_pages), QString());
      QCOMPARE(failure(of_all), QString());
      QVERIFY(of_all->triangles.size() > 100);
      QVERIFY(of_pages->triangles == of_all->triangles);
      QVERIFY(of_pages->vertices == of_all->vertices);
    }
  }

  void files_are_named_after_their_segments() {
    const auto files =
        document::mesh_files({"Left kidney", "a/b", "", "Left kidney", "Čéška"}, "out/organs.stl");
    const char* const expected[] = {"out/organs-Left kidney.stl", "out/organs-a_b.stl",
                                    "out/organs-unnamed.stl", "out/organs-Left kidney 2.stl",
                                    "out/organs-Čéška.stl"};
    QCOMPARE(files.size(), std::size(expected));
    for (std::size_t i = 0; i < files.size(); ++i) QCOMPARE(files[i].string(), std::string(expected[i]));
  }

  void each_label_is_a_file() {
    const TemporaryFolder folder;
    const Geometry geometry = oblique_grid();
    const Mask one = ball_at(geometry, {12.0, 15.0, 10.0}, 6.0);
    const Mask two = ball_at(geometry, {30.0, 12.0, 8.0}, 4.0);
    imaging::Segments segments = imaging::segments_of(one, "One");
    segments.list.push_back(imaging::segments_of(two, "Two").list.front());
    QCOMPARE(failure(document::write_meshes(segments, folder / "organs.stl")), QString());
    for (const auto& [file, mask] : {std::pair("organs-One.stl", &one), {"organs-Two.stl", &two}}) {
      const double share = stl_volume_ml(folder / file) / volume_ml(*mask);
      // Corners of voxels are cut off: the more, the smaller the ball.
      QVERIFY2(std::abs(share - 1.0) < 0.1, qPrintable(QString::number(share)));
    }
    QVERIFY(!fs::exists(folder / "organs.stl"));
  }

  void nothing_is_written_unless_all_is() {
    const TemporaryFolder folder;
    imaging::Segments segments =
        imaging::segments_of(ball_at(oblique_grid(), {12.0, 15.0, 10.0}, 6.0), "One");
    segments.list.push_back(segments.list.front());
    segments.list.back().name = "Two";
    fs::create_directory(folder / "organs-Two.stl");  // in the way
    QVERIFY(!failure(document::write_meshes(segments, folder / "organs.stl")).isEmpty());
    QVERIFY(!fs::exists(folder / "organs-One.stl"));
    std::stop_source stop;
    stop.request_stop();
    const Status stopped =
        document::write_meshes(segments, folder / "others.stl", {nullptr, stop.get_token()});
    QVERIFY(!stopped && stopped.error().kind == ErrorKind::cancelled);
    QVERIFY(!fs::exists(folder / "others-One.stl"));
  }
};

TIDEMARK_TEST(SegmentMeshesTest)

}  // namespace tidemark::test::segment_meshes_test

#include "segment_meshes_test.moc"
