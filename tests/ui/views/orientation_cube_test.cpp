// The cube and the box of a 3D view: which sides of the patient they show, where, and that they can be off.
#include "ui/views/orientation_cube.h"

#include <glm/geometric.hpp>

#include "tests/support/test_program.h"
#include "tests/ui/panels/panel_case.h"
#include "ui/views/volume_box.h"
#include "ui/views/volume_view.h"

namespace tidemark::test::orientation_cube_test {
namespace {

QString letters(double azimuth, double elevation) {
  renderer::Camera camera;
  camera.azimuth = azimuth;
  camera.elevation = elevation;
  QString found;
  for (const ui::CubeFace& face : ui::cube_faces(camera, {}, 10.0)) found += QLatin1Char(face.letter);
  std::sort(found.begin(), found.end());
  return found;
}

QPointF middle_of(const QPolygonF& corners) {
  QPointF sum;
  for (const QPointF& corner : corners) sum += corner / static_cast<double>(corners.size());
  return sum;
}

int differing_pixels(const QImage& a, const QImage& b) {
  int count = 0;
  for (int y = 0; y < a.height(); ++y) {
    for (int x = 0; x < a.width(); ++x) count += a.pixel(x, y) != b.pixel(x, y) ? 1 : 0;
  }
  return count;
}

}  // namespace

class OrientationCubeTest : public QObject {
  Q_OBJECT

 private slots:
  void the_cube_shows_the_sides_that_face_the_viewer() {
    QCOMPARE(letters(0.0, 0.0), "A");
    QCOMPARE(letters(90.0, 0.0), "L");
    QCOMPARE(letters(180.0, 0.0), "P");
    QCOMPARE(letters(-90.0, 0.0), "R");
    QCOMPARE(letters(0.0, 90.0), "H");
    QCOMPARE(letters(0.0, -90.0), "F");
    QCOMPARE(letters(30.0, 20.0), "AHL");
    QCOMPARE(letters(-140.0, -30.0), "FPR");
  }

  void a_letter_stands_upright_where_the_patients_side_is() {
    renderer::Camera camera;
    camera.azimuth = 30.0;
    camera.elevation = 20.0;
    for (const ui::CubeFace& face : ui::cube_faces(camera, {100.0, 50.0}, 20.0)) {
      const glm::dvec3 side = face.letter == 'A'   ? glm::dvec3(0.0, -1.0, 0.0)
                              : face.letter == 'L' ? glm::dvec3(1.0, 0.0, 0.0)
                                                   : glm::dvec3(0.0, 0.0, 1.0);
      const QPointF expected(100.0 + 10.0 * glm::dot(side, camera.right()),
                             50.0 - 10.0 * glm::dot(side, camera.up()));
      const QPointF found = middle_of(face.outline);
      QVERIFY(std::hypot(found.x() - expected.x(), found.y() - expected.y()) < 1e-9);
      // Read from the left to the right and not mirrored, its head above its foot.
      const QPointF along = face.outline[1] - face.outline[0];
      const QPointF down = face.outline[3] - face.outline[0];
      QVERIFY(along.x() > 0.0 && down.y() > 0.0);
      QVERIFY(along.x() * down.y() - along.y() * down.x() > 0.0);
    }
  }

  void three_edges_of_the_box_are_behind_the_volume() {
    Geometry geometry;
    geometry.size = {20, 10, 5};
    geometry.spacing_mm = {1.0, 2.0, 3.0};
    renderer::Camera camera;
    camera.azimuth = 30.0;
    camera.elevation = 20.0;
    const ui::VolumeScreen screen(camera, {200.0, 200.0}, geometry);
    int hidden = 0;
    // Seen from the front, the left and the head, they meet behind, at the right and at the feet.
    const QPointF far = screen.position_of(geometry.to_patient({-0.5, 9.5, -0.5}));
    const std::vector<ui::BoxEdge> edges = ui::box_edges(geometry, screen);
    QCOMPARE(edges.size(), std::size_t{12});
    for (const ui::BoxEdge& edge : edges) {
      if (!edge.hidden) continue;
      ++hidden;
      QVERIFY((edge.from - far).manhattanLength() < 1e-9 || (edge.to - far).manhattanLength() < 1e-9);
    }
    QCOMPARE(hidden, 3);
  }

  void both_are_drawn_until_they_are_switched_off() {
    PanelCase the_case;
    ui::VolumeViewWidget view(*the_case.proxy);
    view.resize(500, 400);
    show(view);
    the_case.wait_until_idle();
    engine::Display& display = the_case.proxy->display();
    const QImage both = view.grab_picture();
    display.change([](engine::DisplaySettings& s) { s.orientation_cube = false; });
    const QImage without_cube = view.grab_picture();
    const QRect corner(0, 300, 100, 100);
    QVERIFY(differing_pixels(both.copy(corner), without_cube.copy(corner)) > 700);
    QCOMPARE(differing_pixels(both.copy(100, 0, 400, 400), without_cube.copy(100, 0, 400, 400)), 0);
    display.change([](engine::DisplaySettings& s) { s.volume_box = false; });
    QVERIFY(differing_pixels(without_cube, view.grab_picture()) > 500);
  }
};

TIDEMARK_TEST(OrientationCubeTest)

}  // namespace tidemark::test::orientation_cube_test

#include "orientation_cube_test.moc"
