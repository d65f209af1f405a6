// Where the patient's sides are in pictures, and what is written there, for series as scanners make them.
#include <QTest>
#include <glm/trigonometric.hpp>

#include "imaging/load_study.h"
#include "renderer/annotation.h"
#include "tests/imaging/dicom/series_files.h"
#include "tests/renderer/scenes.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::orientation_test {

namespace {

// A dark cube with a bright ball, at `marker` from its middle (LPS, mm), with the image axes of `direction`.
Volume marked_volume(const glm::dmat3& direction, glm::dvec3 marker) {
  Geometry geometry = grid({40, 40, 20}, {1.0, 1.0, 2.0});
  geometry.direction = direction;
  geometry.origin_mm = {-13.0, 7.0, 120.0};
  const glm::dvec3 middle = renderer::middle_of(geometry);
  Volume volume;
  volume.geometry = geometry;
  const auto values =
      sample(geometry, [&](glm::dvec3 p) { return glm::length(p - middle - marker) < 4.0 ? 1000.0 : 0.0; });
  volume.voxels = std::vector<std::int16_t>(values.begin(), values.end());
  return volume;
}

glm::dmat3 turned(glm::dmat3 direction, double degrees, glm::dvec3 axis) {
  const double a = glm::radians(degrees);
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 v = direction[i];
    direction[i] =
        v * std::cos(a) + glm::cross(axis, v) * std::sin(a) + axis * glm::dot(axis, v) * (1.0 - std::cos(a));
  }
  return direction;
}

renderer::Picture annotated(const renderer::SliceOrientation& orientation, bool sides_are_known) {
  renderer::Picture picture{200, 160, std::vector<std::uint8_t>(200 * 160 * 4, 0)};
  renderer::annotate(picture, orientation.right, orientation.up, sides_are_known, 0.5);
  return picture;
}

std::int64_t white_in(const renderer::Picture& picture, std::int64_t left, std::int64_t top,
                      std::int64_t right, std::int64_t bottom) {
  std::int64_t white = 0;
  for (std::int64_t y = top; y < bottom; ++y) {
    for (std::int64_t x = left; x < right; ++x) white += pixel(picture, x, y).r > 128 ? 1 : 0;
  }
  return white;
}

}  // namespace

class OrientationTest : public QObject {
  Q_OBJECT

 private slots:
  // How a patient lies decides how the rows and columns of an axial image run in the patient.
  void letters_and_pictures_agree_with_the_series_data() {
    QTest::addColumn<glm::dmat3>("direction");
    const auto axes = [](glm::dvec3 row, glm::dvec3 column) {
      return glm::dmat3(row, column, glm::cross(row, column));
    };
    const glm::dvec3 x(1.0, 0.0, 0.0);
    const glm::dvec3 y(0.0, 1.0, 0.0);
    const glm::dvec3 z(0.0, 0.0, 1.0);
    QTest::newRow("head first, supine") << axes(x, y);
    QTest::newRow("head first, prone") << axes(-x, -y);
    QTest::newRow("feet first, supine") << axes(-x, y);
    QTest::newRow("feet first, prone") << axes(x, -y);
    QTest::newRow("head first, on the left side") << axes(y, -x);
    QTest::newRow("coronal") << axes(x, -z);
    QTest::newRow("sagittal") << axes(y, -z);
    QTest::newRow("oblique") << turned(turned(axes(x, y), 25.0, x), -15.0, z);
  }
  void letters_and_pictures_agree_with_the_series() {
    QFETCH(glm::dmat3, direction);
    struct Side {
      glm::dvec3 towards;
      const char* letter;
    };
    for (const Side& side : {Side{{1, 0, 0}, "L"},
                             {{-1, 0, 0}, "R"},
                             {{0, 1, 0}, "P"},
                             {{0, -1, 0}, "A"},
                             {{0, 0, 1}, "H"},
                             {{0, 0, -1}, "F"}}) {
      const TemporaryFolder folder;
      write_series(marked_volume(direction, 12.0 * side.towards), folder.path());
      auto loaded = imaging::load_volume(folder.path(), {}, {});
      QCOMPARE(failure(loaded), QString());
      Scene scene;
      scene.source = std::make_shared<const Volume>(std::move(*loaded));
      scene.phi = solver::Field::empty(scene.source->geometry, 2.5);
      scene.middle = renderer::middle_of(scene.source->geometry);
      Painter draw(scene);
      for (const renderer::SliceOrientation& slice :
           {renderer::kAxial, renderer::kCoronal, renderer::kSagittal, renderer::oblique(direction[2])}) {
        // The slice shows the marker off its middle only where the side lies in its plane.
        renderer::SliceView view;
        view.orientation = slice;
        view.position_mm = scene.middle + 12.0 * side.towards;
        view.window = {500.0, 800.0};
        view.surface = false;
        const glm::dvec2 at = middle_of_pixels(draw(view, 120, 120), is_marker);
        const glm::dvec2 expected(glm::dot(side.towards, slice.right), glm::dot(side.towards, slice.up));
        const double half = renderer::slice_half_height_mm(scene.source->geometry, slice, 1.0, 1.0);
        QVERIFY2(glm::length(at - 12.0 / half * expected) < 0.05, side.letter);
        // What is written at that edge says so.
        if (std::abs(expected.x) > 0.9) {
          QCOMPARE(renderer::orientation_letters(expected.x > 0.0 ? slice.right : -slice.right).substr(0, 1),
                   side.letter);
        }
        if (std::abs(expected.y) > 0.9) {
          QCOMPARE(renderer::orientation_letters(expected.y > 0.0 ? slice.up : -slice.up).substr(0, 1),
                   side.letter);
        }
      }
      // In 3D, from the front.
      renderer::VolumeView volume;
      volume.surface = false;
      volume.source = transfer_function(
          R"({"source": [{"value": {"ramp": [400, 600]}, "opacity": 10, "colour": [1, 1, 1]}]})");
      volume.lighting.ambient = 1.0;
      const glm::dvec2 at = middle_of_pixels(draw(volume, 120, 120), is_marker);
      const double half = volume.camera.half_height_mm(scene.source->geometry, 1.0);
      const glm::dvec2 expected(glm::dot(side.towards, volume.camera.right()),
                                glm::dot(side.towards, volume.camera.up()));
      QVERIFY2(glm::length(at - 12.0 / half * expected) < 0.05, side.letter);
    }
  }

  void slices_are_seen_as_radiologists_see_them() {
    QCOMPARE(renderer::orientation_letters(-renderer::kAxial.right), std::string("R"));
    QCOMPARE(renderer::orientation_letters(renderer::kAxial.up), std::string("A"));
    QCOMPARE(renderer::orientation_letters(-renderer::kCoronal.right), std::string("R"));
    QCOMPARE(renderer::orientation_letters(renderer::kCoronal.up), std::string("H"));
    QCOMPARE(renderer::orientation_letters(-renderer::kSagittal.right), std::string("A"));
    QCOMPARE(renderer::orientation_letters(renderer::kSagittal.up), std::string("H"));
    const renderer::Camera front;
    QCOMPARE(renderer::orientation_letters(-front.right()), std::string("R"));
    renderer::Camera left;
    left.azimuth = 90.0;
    QCOMPARE(renderer::orientation_letters(left.right()), std::string("P"));
    renderer::Camera above;
    above.elevation = 90.0;
    QCOMPARE(renderer::orientation_letters(above.up()), std::string("P"));
  }

  void oblique_directions_have_letters_by_their_share() {
    QCOMPARE(renderer::orientation_letters({0.9, 0.4, 0.05}), std::string("LP"));
    QCOMPARE(renderer::orientation_letters({-0.3, 0.5, -0.8}), std::string("FPR"));
    QCOMPARE(renderer::orientation_letters({0.02, -1.0, 0.1}), std::string("A"));
  }

  void a_scale_bar_is_a_round_length() {
    QCOMPARE(renderer::scale_bar_mm(99.0), 50.0);
    QCOMPARE(renderer::scale_bar_mm(49.0), 20.0);
    QCOMPARE(renderer::scale_bar_mm(10.0), 10.0);
    QCOMPARE(renderer::scale_bar_mm(0.7), 0.5);
  }

  void letters_and_bar_are_drawn_at_the_edges() {
    const renderer::Picture picture = annotated(renderer::kAxial, true);
    // The bar: 20 mm in 40 pixels.
    std::int64_t longest = 0;
    for (std::int64_t y = 140; y < 160; ++y) {
      longest = std::max(longest, white_in(picture, 100, y, 200, y + 1));
    }
    QVERIFY2(std::abs(longest - 40) <= 1, qPrintable(QString::number(longest)));
    QVERIFY(white_in(picture, 0, 70, 25, 90) > 10);
    QVERIFY(white_in(picture, 175, 70, 200, 90) > 5);
    QVERIFY(white_in(picture, 90, 0, 110, 22) > 10);
    QVERIFY(white_in(picture, 90, 138, 110, 160) > 10);
    QCOMPARE(white_in(picture, 40, 30, 160, 120), 0);
  }

  void sides_that_nobody_knows_are_not_claimed() {
    const renderer::Picture picture = annotated(renderer::kAxial, false);
    QVERIFY(picture.pixels != annotated(renderer::kAxial, true).pixels);
    QCOMPARE(picture.pixels, annotated(renderer::kSagittal, false).pixels);
    // Something is written at all edges.
    QVERIFY(white_in(picture, 0, 70, 25, 90) > 5);
    QVERIFY(white_in(picture, 175, 70, 200, 90) > 5);
    QVERIFY(white_in(picture, 90, 0, 110, 22) > 5);
    QVERIFY(white_in(picture, 90, 138, 110, 160) > 5);
  }
};

TIDEMARK_TEST(OrientationTest)

}  // namespace tidemark::test::orientation_test

#include "orientation_test.moc"
