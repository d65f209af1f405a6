// Whether two grids have any place of the patient in common.
#include "imaging/share_space.h"

#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "tests/support/test_program.h"

namespace tidemark::test::share_space_test {

namespace {

Geometry grid_of(Index3 size, glm::dvec3 spacing_mm, glm::dvec3 origin_mm) {
  Geometry grid;
  grid.size = size;
  grid.spacing_mm = spacing_mm;
  grid.origin_mm = origin_mm;
  return grid;
}

// Whether any place of a lattice all over the image, of 1 mm, lies in the grid.
bool any_place_in(const Geometry& image, const glm::dmat4& transform, const Geometry& grid) {
  for (std::int64_t k = 0; k <= image.size.z; ++k) {
    for (std::int64_t j = 0; j <= image.size.y; ++j) {
      for (std::int64_t i = 0; i <= image.size.x; ++i) {
        const glm::dvec4 place(image.to_patient(glm::dvec3(i, j, k) - 0.5), 1.0);
        if (grid.covers(glm::dvec3(transform * place))) return true;
      }
    }
  }
  return false;
}

}  // namespace

class ShareSpaceTest : public QObject {
  Q_OBJECT
 private slots:
  void a_thin_slice_lies_anywhere_in_a_long_study() {
    const Geometry study = grid_of({8, 8, 1000}, glm::dvec3(1.0), glm::dvec3(0.0));
    const auto meets = [&](double z) {
      const Geometry slice = grid_of({8, 8, 1}, {1.0, 1.0, 3.0}, {0.0, 0.0, z});
      return imaging::share_space(slice, glm::dmat4(1.0), study);
    };
    for (double z = -1.9; z <= 1000.9; z += 0.7) QVERIFY2(meets(z), qPrintable(QString::number(z)));
    QVERIFY(!meets(-2.0));  // it touches the study
    QVERIFY(!meets(1001.0));
    QVERIFY(!meets(-50.0));
    const Geometry slice = grid_of({8, 8, 1}, {1.0, 1.0, 3.0}, {0.0, 0.0, 20.0});
    const glm::dmat4 away = glm::translate(glm::dmat4(1.0), glm::dvec3(5000.0, 0.0, 0.0));
    QVERIFY(!imaging::share_space(slice, away, study));
  }

  void turned_boxes_meet_where_they_overlap() {
    const Geometry image = grid_of({30, 4, 4}, glm::dvec3(1.0), glm::dvec3(-14.5, -1.5, -1.5));
    const Geometry grid = grid_of({20, 6, 6}, glm::dvec3(1.0), glm::dvec3(-9.5, -2.5, -2.5));
    // A lattice of 1 mm misses what reaches less than a voxel into the grid.
    const Geometry grown = grid_of({22, 8, 8}, glm::dvec3(1.0), glm::dvec3(-10.5, -3.5, -3.5));
    std::mt19937 random(7);
    const auto between = [&](double low, double high) {
      return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    int meet = 0;
    constexpr int kTurns = 400;
    for (int n = 0; n < kTurns; ++n) {
      const glm::dvec3 shift(between(-15.0, 15.0), between(-12.0, 12.0), between(-12.0, 12.0));
      const glm::dvec3 axis(between(-1.0, 1.0), between(-1.0, 1.0), 1.0);
      const glm::dmat4 transform =
          glm::rotate(glm::translate(glm::dmat4(1.0), shift), between(0.0, 3.0), axis);
      const bool meets = imaging::share_space(image, transform, grid);
      meet += meets ? 1 : 0;
      QVERIFY(meets || !any_place_in(image, transform, grid));
      QVERIFY(!meets || any_place_in(image, transform, grown));
    }
    QVERIFY2(meet > kTurns / 10 && meet < kTurns * 9 / 10, qPrintable(QString::number(meet)));
  }
};

TIDEMARK_TEST(ShareSpaceTest)

}  // namespace tidemark::test::share_space_test

#include "share_space_test.moc"
