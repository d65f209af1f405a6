// The surface of phi: closed, oriented outward, of the right size, in patient coordinates.
#include <glm/gtc/constants.hpp>
#include <random>
#include <set>

#include "fields.h"
#include "imaging/surface/surface.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::surface_test {

namespace {

constexpr double kPi = glm::pi<double>();

double relative_error(double measured, double expected) {
  return measured / expected - 1.0;
}

// The surface of a field, which must be closed.
imaging::Mesh closed_surface(const Volume& phi) {
  auto mesh = imaging::extract_surface(phi);
  if (!mesh) qFatal("%s", mesh.error().message.c_str());
  if (!imaging::is_closed_and_oriented(*mesh)) qFatal("the surface is not closed");
  return std::move(*mesh);
}

// Four different corners' worth of spacing: isotropic, thick slices, three different ones, thin slices.
const std::vector<glm::dvec3> kSpacings = {{1, 1, 1}, {0.8, 0.8, 3.2}, {0.7, 1.0, 1.6}, {2.0, 2.0, 0.5}};

// A ball of `radius` smallest spacings away from the border, its centre between voxels.
Volume free_ball(double radius, glm::dvec3 spacing) {
  const double r = radius * std::min({spacing.x, spacing.y, spacing.z});
  const glm::dvec3 margin = glm::dvec3(r) + 4.0 * spacing;
  const Index3 size(glm::ceil(2.0 * margin / spacing));
  return field(grid(size, spacing), ball(margin + glm::dvec3(0.21, -0.13, 0.37) * spacing, r));
}

}  // namespace

class SurfaceTest : public QObject {
  Q_OBJECT

 private slots:
  void a_ball_has_its_volume_and_area_data() {
    QTest::addColumn<double>("radius");
    QTest::addColumn<int>("spacing");
    for (const double radius : {3.0, 10.0, 20.0, 40.0}) {
      for (int s = 0; s < static_cast<int>(kSpacings.size()); ++s) {
        QTest::addRow("radius %g, spacing %d", radius, s) << radius << s;
      }
    }
  }

  void a_ball_has_its_volume_and_area() {
    QFETCH(double, radius);
    QFETCH(int, spacing);
    const glm::dvec3 h = kSpacings[static_cast<std::size_t>(spacing)];
    const double r = radius * std::min({h.x, h.y, h.z});
    const imaging::Mesh mesh = closed_surface(free_ball(radius, h));
    const double volume = relative_error(imaging::mesh_volume_ml(mesh), 4.0 / 3.0 * kPi * r * r * r / 1000.0);
    const double area = relative_error(imaging::mesh_area_mm2(mesh), 4.0 * kPi * r * r);
    qInfo("volume %+.2f %%, area %+.2f %%, %zu triangles", 100 * volume, 100 * area, mesh.triangles.size());
    // The smallest is three quarters of a voxel wide along two axes.
    QVERIFY(std::abs(volume) < (radius >= 10 ? 0.006 : 0.35));
    QVERIFY(std::abs(area) < (radius >= 10 ? 0.006 : 0.2));
  }

  void vertices_of_a_ball_lie_on_it() {
    const Geometry geometry = grid({60, 60, 60});
    const glm::dvec3 centre(29.3, 30.1, 28.8);
    const imaging::Mesh mesh = closed_surface(field(geometry, ball(centre, 20.0)));
    double worst = 0.0;
    for (const auto& vertex : mesh.vertices) {
      worst = std::max(worst, std::abs(glm::distance(glm::dvec3(vertex), centre) - 20.0));
    }
    qInfo("farthest vertex %.4f voxels from the sphere", worst);
    QVERIFY(worst < 0.05);
  }

  void nothing_inside_gives_an_empty_mesh() {
    const imaging::Mesh mesh = closed_surface(field(grid({9, 9, 9}), [](glm::dvec3) { return -1.0; }));
    QVERIFY(mesh.vertices.empty());
    QVERIFY(mesh.triangles.empty());
    QCOMPARE(imaging::mesh_volume_ml(mesh), 0.0);
  }

  void values_of_exactly_zero_are_outside() {
    const imaging::Mesh empty = closed_surface(field(grid({9, 9, 9}), [](glm::dvec3) { return 0.0; }));
    QVERIFY(empty.triangles.empty());
    // A box whose faces lie exactly on voxel centres: it has its exact extent.
    const imaging::Mesh mesh = closed_surface(field(grid({16, 16, 16}), [](glm::dvec3 p) {
      const glm::dvec3 d = 5.0 - glm::abs(p - glm::dvec3(7.0));
      return std::min({d.x, d.y, d.z});
    }));
    QVERIFY(std::abs(relative_error(imaging::mesh_volume_ml(mesh), 1.0)) < 0.03);
    float farthest = 0.0F;
    for (const auto& vertex : mesh.vertices) {
      for (int axis = 0; axis < 3; ++axis) farthest = std::max(farthest, std::abs(vertex[axis] - 7.0F));
    }
    qInfo("volume %+.2f %%, half width %.3f", 100 * relative_error(imaging::mesh_volume_ml(mesh), 1.0),
          farthest);
    QVERIFY(std::abs(farthest - 5.0F) < 0.1F);
  }

  void a_field_that_is_inside_everywhere_is_capped_on_the_outer_faces() {
    const glm::dvec3 spacing(1.0, 0.5, 3.0);
    const imaging::Mesh mesh =
        closed_surface(field(grid({30, 40, 20}, spacing), [](glm::dvec3) { return 9.0; }));
    const double box = 30 * 1.0 * 40 * 0.5 * 20 * 3.0 / 1000.0;
    qInfo("volume %+.3f %%", 100 * relative_error(imaging::mesh_volume_ml(mesh), box));
    QVERIFY(std::abs(relative_error(imaging::mesh_volume_ml(mesh), box)) < 1e-5);
    QVERIFY(std::abs(relative_error(imaging::mesh_area_mm2(mesh), 2 * (30 * 20 + 30 * 60 + 20 * 60))) < 1e-5);
    glm::dvec3 low(1e9);
    glm::dvec3 high(-1e9);
    for (const auto& vertex : mesh.vertices) {
      low = glm::min(low, glm::dvec3(vertex));
      high = glm::max(high, glm::dvec3(vertex));
    }
    QVERIFY(glm::distance(low, glm::dvec3(-0.5, -0.25, -1.5)) < 1e-5);
    QVERIFY(glm::distance(high, glm::dvec3(29.5, 19.75, 58.5)) < 1e-5);
  }

  void a_ball_cut_by_the_border_is_capped_there_data() {
    QTest::addColumn<int>("axis");
    QTest::addColumn<bool>("upper");
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool upper : {false, true})
        QTest::addRow("axis %d %s", axis, upper ? "+" : "-") << axis << upper;
    }
  }

  void a_ball_cut_by_the_border_is_capped_there() {
    QFETCH(int, axis);
    QFETCH(bool, upper);
    // The border's outer face lies at distance d = 4.5 from the centre of a ball of radius 12.
    const double r = 12.0;
    const double d = 4.5;
    glm::dvec3 centre(19.2, 20.4, 19.7);
    centre[axis] = upper ? 39.5 - d : d - 0.5;
    const imaging::Mesh mesh = closed_surface(field(grid({40, 40, 40}), ball(centre, r)));
    const double cap = kPi * (r - d) * (r - d) * (2.0 * r + d) / 3.0;
    const double expected = (4.0 / 3.0 * kPi * r * r * r - cap) / 1000.0;
    qInfo("volume %+.2f %%", 100 * relative_error(imaging::mesh_volume_ml(mesh), expected));
    QVERIFY(std::abs(relative_error(imaging::mesh_volume_ml(mesh), expected)) < 0.015);
    double farthest = upper ? -1e9 : 1e9;
    for (const auto& vertex : mesh.vertices) {
      const double x = vertex[axis];
      farthest = upper ? std::max(farthest, x) : std::min(farthest, x);
    }
    QVERIFY(std::abs(farthest - (upper ? 39.5 : -0.5)) < 1e-4);
  }

  void a_ball_in_a_corner_of_the_volume_is_capped_on_three_faces() {
    const imaging::Mesh mesh = closed_surface(field(grid({40, 40, 40}), ball(glm::dvec3(-0.5), 20.0)));
    const double eighth = 4.0 / 3.0 * kPi * 8000.0 / 8.0 / 1000.0;
    QVERIFY(std::abs(relative_error(imaging::mesh_volume_ml(mesh), eighth)) < 0.015);
  }

  void two_balls_that_touch_or_merge_stay_closed() {
    for (const double gap : {3.0, 0.5, 0.01, 0.0, -0.3, -4.0}) {
      const auto a = ball({16, 20, 20}, 10.0);
      const auto b = ball({36.0 + gap, 20, 20}, 10.0);
      const imaging::Mesh mesh =
          closed_surface(field(grid({56, 40, 40}), [&](glm::dvec3 p) { return std::max(a(p), b(p)); }));
      const double overlap = std::max(0.0, -gap);
      // Two caps of height overlap / 2 are shared.
      const double h = overlap / 2.0;
      const double lens = 2.0 * kPi * h * h * (30.0 - h) / 3.0;
      const double expected = (2.0 * 4.0 / 3.0 * kPi * 1000.0 - lens) / 1000.0;
      QVERIFY(std::abs(relative_error(imaging::mesh_volume_ml(mesh), expected)) < 0.015);
    }
  }

  void a_single_voxel_and_a_sheet_of_one_voxel_are_closed() {
    const imaging::Mesh voxel = closed_surface(field(grid({7, 7, 7}), ball({3, 3, 3}, 0.5)));
    QVERIFY(imaging::mesh_volume_ml(voxel) > 0.0);
    const imaging::Mesh sheet =
        closed_surface(field(grid({20, 20, 9}), [](glm::dvec3 p) { return 0.5 - std::abs(p.z - 4.0); }));
    qInfo("sheet %+.2f %%", 100 * relative_error(imaging::mesh_volume_ml(sheet), 20 * 20 * 1.0 / 1000.0));
    QVERIFY(std::abs(relative_error(imaging::mesh_volume_ml(sheet), 20 * 20 * 1.0 / 1000.0)) < 0.05);
  }

  void volumes_of_one_voxel_along_an_axis_are_closed() {
    for (const Index3 size : {Index3(1, 1, 1), Index3(7, 1, 61), Index3(1, 175, 7), Index3(12, 9, 1)}) {
      const imaging::Mesh mesh = closed_surface(field(grid(size), [](glm::dvec3) { return 2.0; }));
      QVERIFY(imaging::mesh_volume_ml(mesh) > 0.0);
    }
  }

  void noise_gives_a_closed_surface() {
    std::mt19937 random(7);
    for (const int levels : {0, 3}) {  // any value; and only -1, 0, 1
      for (const int n : {2, 9, 24}) {
        Volume phi = field(grid({n, n + 1, n + 2}), [&](glm::dvec3) {
          if (levels == 3) return static_cast<double>(random() % 3) - 1.0;
          return static_cast<double>(random()) / 2147483648.0 - 1.0;
        });
        const imaging::Mesh mesh = closed_surface(phi);
        QVERIFY(imaging::mesh_volume_ml(mesh) > 0.0);
      }
    }
  }

  void a_left_handed_or_oblique_grid_gives_the_same_surface_in_the_patient() {
    const double c = std::cos(0.6);
    const double s = std::sin(0.6);
    const glm::dmat3 oblique =
        glm::dmat3(c, s, 0, -s, c, 0, 0, 0, 1) * glm::dmat3(1, 0, 0, 0, c, s, 0, -s, c);
    glm::dmat3 left_handed = oblique;
    left_handed[2] = -left_handed[2];
    for (const glm::dmat3& direction : {oblique, left_handed}) {
      Geometry geometry = grid({40, 44, 30}, {1.0, 0.9, 1.5});
      geometry.direction = direction;
      geometry.origin_mm = {-120.0, 35.0, 410.0};
      const glm::dvec3 centre = geometry.to_patient({19.4, 22.1, 14.7});
      const imaging::Mesh mesh =
          closed_surface(field(geometry, ball(glm::dvec3(19.4, 22.1, 14.7) * geometry.spacing_mm, 12.0)));
      QVERIFY(std::abs(relative_error(imaging::mesh_volume_ml(mesh), 4.0 / 3.0 * kPi * 1728.0 / 1000.0)) <
              0.015);
      for (const auto& vertex : mesh.vertices) {
        QVERIFY(std::abs(glm::distance(glm::dvec3(vertex), centre) - 12.0) < 0.1);
      }
    }
  }

  void no_two_vertices_of_a_ball_share_a_place() {
    const imaging::Mesh mesh = closed_surface(field(grid({40, 40, 40}), ball({20, 20, 20}, 12.0)));
    std::set<std::array<float, 3>> places;
    for (const auto& v : mesh.vertices) places.insert({v.x, v.y, v.z});
    QCOMPARE(places.size(), mesh.vertices.size());
  }

  void a_hole_in_a_mesh_and_a_turned_triangle_are_noticed() {
    const imaging::Mesh whole = closed_surface(field(grid({12, 12, 12}), ball({6, 6, 6}, 3.0)));
    imaging::Mesh hole = whole;
    hole.triangles.pop_back();
    QVERIFY(!imaging::is_closed_and_oriented(hole));
    imaging::Mesh turned = whole;
    std::swap(turned.triangles[5][0], turned.triangles[5][1]);
    QVERIFY(!imaging::is_closed_and_oriented(turned));
  }

  void phi_that_is_not_a_float_volume_or_not_finite_is_refused() {
    Volume phi = field(grid({4, 4, 4}), ball({2, 2, 2}, 1.0));
    std::get<std::vector<float>>(phi.voxels)[9] = NAN;
    const auto nan = imaging::extract_surface(phi);
    QVERIFY(!nan);
    QCOMPARE(nan.error().kind, ErrorKind::input);
    phi.voxels = std::vector<std::int16_t>(64);
    QVERIFY(!imaging::extract_surface(phi));
  }
};

TIDEMARK_TEST(SurfaceTest)

}  // namespace tidemark::test::surface_test

#include "surface_test.moc"
