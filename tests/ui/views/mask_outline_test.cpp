// The outline of a mask lies where the mask ends, in slices of every orientation.
#include "ui/views/mask_outline.h"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>

#include "tests/support/test_program.h"
#include "ui/views/slice_lattice.h"

namespace tidemark::test::mask_outline_test {

namespace {

constexpr double kRadius = 11.0;

const Geometry kGrid{{40, 36, 30}, {1.0, 1.0, 1.4}, glm::dmat3(1.0), {-8.0, 12.0, 5.0}};

glm::dvec3 middle() {
  return kGrid.to_patient(0.5 * glm::dvec3(kGrid.size - Index3(1)));
}

BitMask ball() {
  BitMask mask(kGrid);
  for (std::int64_t offset = 0; offset < kGrid.voxel_count(); ++offset) {
    const glm::dvec3 voxel(kGrid.voxel_at(offset));
    if (glm::distance(kGrid.to_patient(voxel), middle()) < kRadius) mask.add(offset);
  }
  return mask;
}

}  // namespace

class MaskOutlineTest : public QObject {
  Q_OBJECT

 private slots:
  void it_is_a_circle_around_a_ball_data() {
    QTest::addColumn<int>("kind");
    QTest::newRow("axial") << 0;
    QTest::newRow("coronal") << 1;
    QTest::newRow("sagittal") << 2;
    QTest::newRow("oblique") << 3;
  }

  void it_is_a_circle_around_a_ball() {
    QFETCH(int, kind);
    renderer::SliceOrientation orientation = kind == 1   ? renderer::kCoronal
                                             : kind == 2 ? renderer::kSagittal
                                                         : renderer::kAxial;
    if (kind == 3) {
      orientation.right = glm::normalize(glm::dvec3(1.0, 0.4, 0.2));
      orientation.up = glm::normalize(glm::cross(orientation.right, glm::dvec3(0.3, 1.0, -0.2)));
    }
    constexpr double kOff = 4.0;
    const glm::dvec3 position = middle() + orientation.into() * kOff;
    const QList<QLineF> lines = ui::outline_in_slice(ball(), orientation, position);
    QVERIFY2(lines.size() > 30, qPrintable(QString::number(lines.size())));
    const QPointF centre(glm::dot(middle(), orientation.right), glm::dot(middle(), orientation.up));
    const double radius = std::sqrt(kRadius * kRadius - kOff * kOff);
    double length = 0.0;
    for (const QLineF& line : lines) {
      length += line.length();
      const double from_centre = QLineF(centre, line.center()).length();
      QVERIFY2(std::abs(from_centre - radius) < 1.2, qPrintable(QString::number(from_centre - radius)));
    }
    // Voxels make it longer than the circle, at most as much longer as an octagon's stairs.
    QVERIFY2(length > 1.9 * M_PI * radius && length < 2.4 * M_PI * radius,
             qPrintable(QString::number(length)));
  }

  // Between voxels, as far as phi says.
  void of_a_level_set_it_is_the_circle_itself() {
    constexpr double kBand = 2.5;
    std::vector<float> values;
    for (std::int64_t offset = 0; offset < kGrid.voxel_count(); ++offset) {
      const double distance = kRadius - glm::distance(kGrid.to_patient(kGrid.voxel_at(offset)), middle());
      values.push_back(static_cast<float>(std::clamp(distance, -kBand, kBand)));
    }
    const solver::Field phi = solver::Field::from_dense(kGrid, values, kBand);
    constexpr double kOff = 4.0;
    const renderer::SliceOrientation& axial = renderer::kAxial;
    const QPointF centre(glm::dot(middle(), axial.right), glm::dot(middle(), axial.up));
    const double radius = std::sqrt(kRadius * kRadius - kOff * kOff);
    double length = 0.0;
    for (const QLineF& line : ui::outline_in_slice(phi, axial, middle() + axial.into() * kOff)) {
      length += line.length();
      QVERIFY(std::abs(QLineF(centre, line.center()).length() - radius) < 0.2);
    }
    QVERIFY(std::abs(length / (2.0 * M_PI * radius) - 1.0) < 0.02);
    QVERIFY(ui::outline_in_slice(solver::Field::empty(kGrid, kBand), axial, middle()).isEmpty());
  }

  // No end is loose, at the volume's border either.
  void it_is_closed() {
    const BitMask all(kGrid, whole({Index3(0), kGrid.size}));
    for (const BitMask& mask : {ball(), all}) {
      std::map<std::pair<long, long>, int> ends;
      for (const QLineF& line : ui::outline_in_slice(mask, renderer::kAxial, middle())) {
        for (const QPointF& end : {line.p1(), line.p2()})
          ++ends[{std::lround(end.x() * 1000.0), std::lround(end.y() * 1000.0)}];
      }
      QVERIFY(!ends.empty());
      for (const auto& [at, count] : ends) QCOMPARE(count % 2, 0);
    }
  }

  void beside_the_mask_there_is_none() {
    QVERIFY(
        ui::outline_in_slice(ball(), renderer::kAxial, middle() + renderer::kAxial.into() * (kRadius + 3.0))
            .isEmpty());
  }

  void a_box_beside_the_slice_has_no_points_in_it() {
    const VoxelRange box{{5, 6, 7}, {20, 22, 24}};
    const auto points_at = [](const VoxelRange& of, const renderer::SliceOrientation& orientation,
                              glm::dvec3 voxel) {
      return ui::lattice_in(kGrid, of, orientation, kGrid.to_patient(voxel)).points();
    };
    const std::array across{renderer::kSagittal, renderer::kCoronal, renderer::kAxial};
    for (int axis = 0; axis < 3; ++axis) {
      const auto at = [&](double place) {
        glm::dvec3 voxel(10.0);
        voxel[axis] = place;
        return points_at(box, across[static_cast<std::size_t>(axis)], voxel);
      };
      const auto first = static_cast<double>(box.low[axis]);
      const auto last = static_cast<double>(box.high[axis] - 1);
      for (const double place : {first - 0.9, first, last, last + 0.9}) QVERIFY(at(place) > 100);
      for (const double place : {first - 1.1, last + 1.1}) QCOMPARE(at(place), std::int64_t{0});
    }
    renderer::SliceOrientation oblique;
    oblique.right = glm::normalize(glm::dvec3(1.0, -1.0, 0.0));
    oblique.up = glm::dvec3(0.0, 0.0, 1.0);
    QVERIFY(points_at(box, oblique, {10.0, 10.0, 0.0}) > 100);
    QCOMPARE(points_at(box, oblique, {0.0, 0.0, 10.0}), std::int64_t{0});
    QCOMPARE(points_at(VoxelRange(), renderer::kAxial, {0.0, 0.0, 0.0}), std::int64_t{0});
  }

  void regions_beside_the_slice_change_nothing() {
    engine::LabelPreview one;
    one.from.geometry = kGrid;
    one.regions.push_back({1, {}, whole({{5, 6, 7}, {20, 22, 24}})});
    engine::LabelPreview many = one;
    for (std::int64_t z = 0; z < kGrid.size.z; ++z) {
      if (std::abs(z - 12) > 1) many.regions.push_back({2, {}, whole({{2, 3, z}, {30, 25, z + 1}})});
    }
    const glm::dvec3 position = kGrid.to_patient({0.0, 0.0, 12.0});
    const QList<QLineF> lines = ui::outline_in_slice(one, renderer::kAxial, position);
    QVERIFY(!lines.isEmpty() && ui::outline_in_slice(many, renderer::kAxial, position) == lines);
  }
};

TIDEMARK_TEST(MaskOutlineTest)

}  // namespace tidemark::test::mask_outline_test

#include "mask_outline_test.moc"
