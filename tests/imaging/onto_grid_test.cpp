// Masks and fields from files on the grid of a study, however their axes run.
#include "imaging/onto_grid.h"

#include <algorithm>

#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::onto_grid_test {

namespace {

Geometry study_grid() {
  Geometry grid;
  grid.size = {4, 5, 6};
  grid.spacing_mm = {1.0, 1.5, 3.0};
  grid.origin_mm = {-10.0, 20.0, 30.0};
  return grid;
}

// The same voxels, stored with axis a of the study as axis axes[a], backwards where `reversed` says so.
Geometry stored_otherwise(const Geometry& grid, std::array<int, 3> axes, std::array<bool, 3> reversed) {
  Geometry other;
  glm::dvec3 first(0.0);
  for (int a = 0; a < 3; ++a) {
    const auto of_study = static_cast<std::size_t>(a);
    const int b = axes[of_study];
    other.size[b] = grid.size[a];
    other.spacing_mm[b] = grid.spacing_mm[a];
    other.direction[b] = reversed[of_study] ? -grid.direction[a] : grid.direction[a];
    if (reversed[of_study]) first[a] = static_cast<double>(grid.size[a] - 1);
  }
  other.origin_mm = grid.to_patient(first);
  return other;
}

// A value that tells where in the patient the voxel is.
Volume volume_on(const Geometry& grid) {
  Volume volume;
  volume.geometry = grid;
  std::vector<float> values;
  for (std::int64_t offset = 0; offset < grid.voxel_count(); ++offset) {
    const Index3 voxel = grid.voxel_at(offset);
    const glm::dvec3 place = grid.to_patient(glm::dvec3(voxel));
    values.push_back(static_cast<float>(place.x + 100.0 * place.y + 10000.0 * place.z));
  }
  volume.voxels = std::move(values);
  return volume;
}

}  // namespace

class OntoGridTest : public QObject {
  Q_OBJECT

 private slots:
  void voxels_find_their_place_whatever_the_order_of_the_axes() {
    const Geometry grid = study_grid();
    const std::vector<float> expected = volume_on(grid).values();
    const auto [low, high] = std::minmax_element(expected.begin(), expected.end());
    const float middle = (*low + *high) / 2.0F;
    std::array<int, 3> axes{0, 1, 2};
    do {
      for (unsigned flips = 0; flips < 8; ++flips) {
        const Volume stored = volume_on(
            stored_otherwise(grid, axes, {(flips & 1U) != 0, (flips & 2U) != 0, (flips & 4U) != 0}));
        const auto values = imaging::onto_grid(stored, grid, "phi.nrrd");
        QCOMPARE(test::failure(values), QString());
        QCOMPARE(*values, expected);
        Mask mask{stored.geometry, {}};
        for (const float value : stored.values()) mask.voxels.push_back(value > middle ? 1 : 0);
        const auto inside = imaging::onto_grid(std::move(mask), grid, "mask.nrrd");
        QCOMPARE(test::failure(inside), QString());
        QCOMPARE(inside->geometry, grid);
        for (std::size_t v = 0; v < expected.size(); ++v) {
          QCOMPARE(inside->voxels[v], static_cast<std::uint8_t>(expected[v] > middle ? 1 : 0));
        }
      }
    } while (std::next_permutation(axes.begin(), axes.end()));
  }

  void rounded_numbers_are_the_same_grid() {
    Geometry rounded = study_grid();
    rounded.origin_mm.x += 0.01;
    rounded.spacing_mm.z = 3.001;
    QVERIFY(imaging::onto_grid(volume_on(rounded), study_grid(), "phi.nrrd").has_value());
  }

  void other_voxels_are_refused_by_the_files_name_data() {
    QTest::addColumn<bool>("larger");
    QTest::addColumn<double>("shift_mm");
    QTest::addColumn<QString>("reason");
    QTest::newRow("larger") << true << 0.0 << "is not that of the study";
    QTest::newRow("elsewhere") << false << 3.0 << "lies elsewhere";
  }

  void other_voxels_are_refused_by_the_files_name() {
    QFETCH(bool, larger);
    QFETCH(double, shift_mm);
    QFETCH(QString, reason);
    Geometry other = study_grid();
    other.origin_mm.z += shift_mm;
    if (larger) ++other.size.x;
    const auto refused = imaging::onto_grid(volume_on(other), study_grid(), "phi.nrrd");
    QVERIFY(!refused);
    QCOMPARE(refused.error().kind, ErrorKind::input);
    const QString message = QString::fromStdString(refused.error().message);
    QVERIFY2(message.startsWith("phi.nrrd: its grid") && message.contains(reason), qPrintable(message));
  }
};

TIDEMARK_TEST(OntoGridTest)

}  // namespace tidemark::test::onto_grid_test

#include "onto_grid_test.moc"
