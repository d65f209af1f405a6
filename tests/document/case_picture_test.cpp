// The picture of a case of a cohort.
#include "document/cohort/case_picture.h"

#include "tests/support/grid.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::case_picture_test {

namespace {

constexpr std::int64_t kSide = 48;
constexpr double kBand = 2.5;

Volume grey(const Geometry& geometry) {
  Volume volume;
  volume.geometry = geometry;
  volume.voxels = std::vector<std::int16_t>(static_cast<std::size_t>(geometry.voxel_count()), 100);
  volume.window = WindowLevel{100.0, 200.0};
  return volume;
}

solver::Field ball(const Geometry& geometry, double radius) {
  std::vector<float> phi;
  for (std::int64_t i = 0; i < geometry.voxel_count(); ++i) {
    const glm::dvec3 from_middle =
        glm::dvec3(geometry.voxel_at(i)) - 0.5 * glm::dvec3(geometry.size - Index3(1));
    phi.push_back(static_cast<float>(std::clamp(radius - glm::length(from_middle), -kBand, kBand)));
  }
  return solver::Field::from_dense(geometry, phi, kBand);
}

// Pixels of a part that are not grey.
int coloured(const renderer::Picture& picture, std::int64_t part) {
  int count = 0;
  for (std::int64_t y = 0; y < kSide; ++y) {
    for (std::int64_t x = part * kSide; x < (part + 1) * kSide; ++x) {
      const std::uint8_t* pixel = picture.pixels.data() + 4 * (y * picture.width + x);
      if (pixel[0] > pixel[2] + 30) ++count;
    }
  }
  return count;
}

}  // namespace

class CasePictureTest : public QObject {
  Q_OBJECT

 private slots:
  void outline_and_surface_are_seen() {
    const Geometry geometry = grid_of(Index3(32));
    const Volume source = grey(geometry);
    const auto picture = cohort::case_picture(source, ball(geometry, 10.0), kSide, 1);
    QCOMPARE(failure(picture), QString());
    QCOMPARE(picture->width, 4 * kSide);
    QCOMPARE(picture->height, kSide);
    // A circle of 15 pixels, two of them wide at most.
    for (int part = 0; part < 3; ++part) {
      const int count = coloured(*picture, part);
      QVERIFY2(count > 60 && count < 300, qPrintable(QString::number(count)));
    }
    QVERIFY(coloured(*picture, 3) > 300);  // a disc
    const auto again = cohort::case_picture(source, ball(geometry, 10.0), kSide, 3);
    QVERIFY(again && again->pixels == picture->pixels);
  }

  void an_empty_result_has_slices_alone() {
    const Geometry geometry = grid_of(Index3(32));
    const auto picture =
        cohort::case_picture(grey(geometry), solver::Field::empty(geometry, kBand), kSide, 1);
    QCOMPARE(failure(picture), QString());
    for (int part = 0; part < 4; ++part) QCOMPARE(coloured(*picture, part), 0);
    QVERIFY(picture->pixels[4 * (kSide / 2 * picture->width + kSide / 2)] > 60);
  }
};

TIDEMARK_TEST(CasePictureTest)

}  // namespace tidemark::test::case_picture_test

#include "case_picture_test.moc"
