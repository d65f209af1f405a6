// The distance transform by pages, against the definition: bit for bit, wherever pages end.
#include "solver/distance_transform.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>
#include <limits>
#include <random>

#include "level_sets.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::distance_transform_test {

namespace {

// What a step costs along an axis: to the near face of that voxel.
float cost(std::int64_t steps, double spacing) {
  const double distance = std::max(0.0, static_cast<double>(std::abs(steps)) - 0.5) * spacing;
  return static_cast<float>(distance * distance);
}

std::vector<float> defined_distances(const Mask& mask, double band) {
  const Geometry& geometry = mask.geometry;
  const glm::dvec3 spacing = geometry.spacing_mm / glm::compMin(geometry.spacing_mm);
  const Index3 reach(glm::ceil(band / spacing + 0.5));
  std::vector<float> phi;
  for (std::int64_t i = 0; i < geometry.voxel_count(); ++i) {
    const Index3 at = geometry.voxel_at(i);
    const Index3 low = glm::max(at - reach, Index3(0));
    const Index3 high = glm::min(at + reach, geometry.size - Index3(1));
    const bool inside = mask.voxels[static_cast<std::size_t>(i)] != 0;
    float least = std::numeric_limits<float>::infinity();
    for (std::int64_t z = low.z; z <= high.z; ++z) {
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        for (std::int64_t x = low.x; x <= high.x; ++x) {
          const std::uint8_t other = mask.voxels[static_cast<std::size_t>(geometry.offset({x, y, z}))];
          if ((other != 0) == inside) continue;
          const float in_plane = cost(x - at.x, spacing.x) + cost(y - at.y, spacing.y);
          least = std::min(least, in_plane + cost(z - at.z, spacing.z));
        }
      }
    }
    const float distance = std::min(std::sqrt(least), static_cast<float>(band));
    phi.push_back(inside ? distance : -distance);
  }
  return phi;
}

// Balls with holes, and single voxels that differ from all around them.
Mask random_mask(const Geometry& geometry, std::mt19937& random) {
  Mask mask{geometry, std::vector<std::uint8_t>(static_cast<std::size_t>(geometry.voxel_count()))};
  std::uniform_real_distribution<double> place(0.0, 1.0);
  for (int ball = 0; ball < 6; ++ball) {
    const glm::dvec3 centre =
        glm::dvec3(place(random), place(random), place(random)) * glm::dvec3(geometry.size);
    const double radius = 1.0 + 7.0 * place(random);
    for (std::int64_t i = 0; i < geometry.voxel_count(); ++i) {
      if (glm::distance(glm::dvec3(geometry.voxel_at(i)), centre) < radius)
        mask.voxels[static_cast<std::size_t>(i)] = ball % 3 == 2 ? 0 : 1;
    }
  }
  std::uniform_int_distribution<std::size_t> any(0, mask.voxels.size() - 1);
  for (int i = 0; i < 5; ++i) mask.voxels[any(random)] ^= 1U;
  return mask;
}

constexpr Index3 kShapes[] = {{8, 8, 8}, {16, 16, 1}, {4, 8, 2}, {64, 64, 64}};

}  // namespace

class DistanceTransformTest : public QObject {
  Q_OBJECT

 private slots:
  void distances_are_those_of_the_definition_to_the_last_bit_data() {
    QTest::addColumn<double>("band");
    QTest::addRow("less than a voxel") << 0.4;
    QTest::addRow("the usual band") << 2.5;
    QTest::addRow("farther than a page") << 9.3;
    QTest::addRow("farther than the volume") << 1000.0;
  }
  void distances_are_those_of_the_definition_to_the_last_bit() {
    QFETCH(const double, band);
    std::mt19937 random(7);
    const Index3 reach = band > 9.0 ? Index3(23, 14, 12) : Index3(45, 26, 21);
    for (const Index3 size : {reach, Index3(reach.x, reach.y, 1), Index3(1, 1, reach.z)}) {
      for (const glm::dvec3 spacing :
           {glm::dvec3(1, 1, 1), glm::dvec3(0.8, 0.8, 2.4), glm::dvec3(3, 1, 1.5)}) {
        const Mask mask = random_mask(grid(size, spacing), random);
        const std::vector<float> wanted = defined_distances(mask, band);
        for (const Index3 shape : kShapes) {
          const solver::Field phi = solver::distance_transform(mask, band, shape);
          const solver::Field dense = solver::Field::from_dense(mask.geometry, wanted, band, shape);
          QVERIFY(phi.pages.stored_pages() == dense.pages.stored_pages());
          QVERIFY(phi.dense() == wanted);
        }
      }
    }
  }

  void a_volume_that_is_all_inside_or_all_outside_has_no_pages() {
    const Geometry geometry = grid({30, 20, 10});
    for (const std::uint8_t value : {0, 1}) {
      const Mask mask{geometry,
                      std::vector<std::uint8_t>(static_cast<std::size_t>(geometry.voxel_count()), value)};
      const solver::Field phi = solver::distance_transform(mask, 2.5);
      QCOMPARE(phi.pages.stored(), std::int64_t{0});
      QVERIFY(phi.has_inside() == (value != 0));
    }
  }

  void only_what_is_near_the_boundary_is_read_a_second_time() {
    const Geometry geometry = grid({128, 128, 128});
    std::atomic<std::int64_t> read = 0;
    const Inside ball{geometry, [&](std::int64_t offset, std::span<std::uint8_t> voxels) {
                        read += static_cast<std::int64_t>(voxels.size());
                        for (std::uint8_t& voxel : voxels) {
                          const glm::dvec3 at(geometry.voxel_at(offset++));
                          voxel = glm::distance(at, centre_of(geometry)) < 12.0 ? 1 : 0;
                        }
                      }};
    const solver::Field phi = solver::distance_transform(ball, 2.5);
    const std::int64_t once = geometry.voxel_count();
    QVERIFY2(read > once && read < once * 5 / 4, qPrintable(QString::number(read)));
    QCOMPARE(phi.mask().voxels, mask_of(ball).voxels);
  }
};

TIDEMARK_TEST(DistanceTransformTest)

}  // namespace tidemark::test::distance_transform_test

#include "distance_transform_test.moc"
