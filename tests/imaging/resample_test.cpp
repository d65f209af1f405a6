// A volume on another grid in the patient.
#include "imaging/resample.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/matrix.hpp>

#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::resample_test {

namespace {

double linear(glm::dvec3 place) {
  return 3.0 * place.x - 2.0 * place.y + 0.5 * place.z + 7.0;
}

// Values that are linear in the patient: trilinear interpolation gives them back everywhere.
Volume linear_volume(const Geometry& grid) {
  Volume volume;
  volume.geometry = grid;
  volume.unit = "HU";
  volume.slope = 2.0;
  volume.intercept = -1.0;
  std::vector<float> values;
  for (std::int64_t k = 0; k < grid.size.z; ++k) {
    for (std::int64_t j = 0; j < grid.size.y; ++j) {
      for (std::int64_t i = 0; i < grid.size.x; ++i) {
        values.push_back(static_cast<float>((linear(grid.to_patient(glm::dvec3(i, j, k))) + 1.0) / 2.0));
      }
    }
  }
  volume.voxels = std::move(values);
  return volume;
}

Geometry oblique() {
  Geometry grid;
  grid.size = {20, 24, 10};
  grid.spacing_mm = {1.0, 1.5, 3.0};
  grid.direction = glm::dmat3(glm::rotate(glm::dmat4(1.0), 0.3, glm::normalize(glm::dvec3(1.0, 2.0, 3.0))));
  grid.origin_mm = {-10.0, 20.0, 30.0};
  return grid;
}

Geometry part_of(const Geometry& grid) {
  Geometry part;
  part.size = {7, 8, 9};
  part.spacing_mm = {0.7, 0.8, 0.9};
  part.origin_mm = grid.to_patient(glm::dvec3(8.0, 9.0, 3.0));
  return part;
}

}  // namespace

class ResampleTest : public QObject {
  Q_OBJECT

 private slots:
  void values_keep_their_place_in_the_patient() {
    const Geometry grid = part_of(oblique());
    const auto result = imaging::resample(linear_volume(oblique()), glm::dmat4(1.0), grid, "a.nrrd");
    QCOMPARE(test::failure(result), QString());
    QCOMPARE(result->covered.count(), grid.voxel_count());
    QCOMPARE(result->volume.unit, std::string("HU"));
    QVERIFY(result->volume.geometry == grid);
    for (const Index3 voxel : {Index3(0, 0, 0), Index3(6, 7, 8), Index3(3, 1, 5)}) {
      const double expected = linear(grid.to_patient(glm::dvec3(voxel)));
      QVERIFY(std::abs(static_cast<double>(result->volume.value(voxel)) - expected) < 1e-3);
    }
  }

  void a_transform_moves_the_image() {
    const glm::dmat4 transform = glm::rotate(glm::translate(glm::dmat4(1.0), glm::dvec3(2.0, -1.0, 3.0)), 0.2,
                                             glm::dvec3(0.0, 0.0, 1.0));
    Geometry grid = part_of(oblique());
    grid.origin_mm = glm::dvec3(transform * glm::dvec4(grid.origin_mm, 1.0));
    const auto result = imaging::resample(linear_volume(oblique()), transform, grid, "a.nrrd");
    QCOMPARE(test::failure(result), QString());
    const glm::dvec3 place = grid.to_patient(glm::dvec3(3.0, 4.0, 5.0));
    const double expected = linear(glm::dvec3(glm::inverse(transform) * glm::dvec4(place, 1.0)));
    QVERIFY(std::abs(static_cast<double>(result->volume.value({3, 4, 5})) - expected) < 1e-3);
  }

  void outside_of_the_image_is_its_minimum() {
    Geometry small;
    small.size = {4, 4, 4};
    Geometry grid = small;
    grid.size = {8, 4, 4};
    const Volume image = linear_volume(small);
    const auto result = imaging::resample(image, glm::dmat4(1.0), grid, "a.nrrd");
    QCOMPARE(test::failure(result), QString());
    QVERIFY(result->covered == whole({Index3(0), Index3(4)}));
    QCOMPARE(result->volume.value({3, 2, 2}), image.value({3, 2, 2}));
    QCOMPARE(result->volume.value({4, 2, 2}), image.range().first);
    const auto marked = imaging::resample(image, glm::dmat4(1.0), grid, "a.nrrd", {}, -5.0F);
    QCOMPARE(test::failure(marked), QString());
    QCOMPARE(marked->volume.value({4, 2, 2}), -5.0F);
  }

  void images_that_do_not_overlap_are_refused() {
    Geometry grid = part_of(oblique());
    grid.origin_mm += glm::dvec3(500.0, 0.0, 0.0);
    const auto result = imaging::resample(linear_volume(oblique()), glm::dmat4(1.0), grid, "pet.nii.gz");
    QVERIFY(!result);
    QCOMPARE(result.error().kind, ErrorKind::usage);
    QCOMPARE(result.error().message,
             std::string("pet.nii.gz: its 20 x 24 x 10 voxels of 1 x 1.5 x 3 mm lie elsewhere in the patient "
                         "than the study's 7 x 8 x 9 voxels of 0.7 x 0.8 x 0.9 mm"));
  }

  void a_transform_that_cannot_be_inverted_is_refused() {
    const auto result =
        imaging::resample(linear_volume(oblique()), glm::dmat4(0.0), part_of(oblique()), "a.nrrd");
    QVERIFY(!result);
    QCOMPARE(result.error().message, std::string("a.nrrd: its transform cannot be inverted"));
  }

  void a_cancelled_resampling_ends() {
    std::stop_source source;
    source.request_stop();
    const auto result = imaging::resample(linear_volume(oblique()), glm::dmat4(1.0), part_of(oblique()),
                                          "a.nrrd", {nullptr, source.get_token()});
    QVERIFY(!result);
    QCOMPARE(result.error().kind, ErrorKind::cancelled);
  }

  void a_place_has_the_value_of_the_image_or_none() {
    const Volume image = linear_volume(oblique());
    const glm::dvec3 place = oblique().to_patient(glm::dvec3(4.3, 5.6, 7.1));
    QVERIFY(std::abs(imaging::value_at(image, place).value() - linear(place)) < 1e-3);
    QVERIFY(imaging::value_at(image, oblique().to_patient(glm::dvec3(-0.4, 0.0, 0.0))));
    QVERIFY(!imaging::value_at(image, oblique().to_patient(glm::dvec3(-0.6, 0.0, 0.0))));
  }
};

TIDEMARK_TEST(ResampleTest)

}  // namespace tidemark::test::resample_test

#include "resample_test.moc"
