// Diameters of regions and values inside of them, against all pairs of points and plain loops.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <random>

#include "imaging/regions/diameters.h"
#include "imaging/regions/inside_values.h"
#include "tests/support/grid.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::measures_test {

namespace {

template <class Wanted>
Region region_where(const Geometry& grid, const Wanted& wanted) {
  Region region(VoxelRange{Index3(0), grid.size});
  for (std::int64_t i = 0; i < grid.voxel_count(); ++i) {
    if (wanted(grid.voxel_at(i))) region.add(grid.voxel_at(i));
  }
  return region;
}

constexpr glm::dvec3 kOrigin(-20.0, 35.0, 7.0);

// The middles of the faces where the region ends, in the patient; of those across some axes.
std::vector<std::pair<glm::dvec3, Index3>> faces(const Region& region, const Geometry& grid,
                                                 const std::vector<int>& axes) {
  std::vector<std::pair<glm::dvec3, Index3>> points;
  for (std::int64_t n = 0; n < grid.voxel_count(); ++n) {
    const Index3 voxel = grid.voxel_at(n);
    if (!region.contains(voxel)) continue;
    for (const int axis : axes) {
      for (const int side : {-1, 1}) {
        Index3 other = voxel;
        other[axis] += side;
        glm::dvec3 middle(voxel);
        middle[axis] += 0.5 * side;
        if (!region.contains(other)) points.emplace_back(grid.to_patient(middle), voxel);
      }
    }
  }
  return points;
}

double longest(const Region& region, const Geometry& grid) {
  const auto points = faces(region, grid, {0, 1, 2});
  double longest = 0.0;
  for (const auto& a : points) {
    for (const auto& b : points) longest = std::max(longest, glm::distance(a.first, b.first));
  }
  return longest;
}

double longest_in_slice(const Region& region, const Geometry& grid, int axis) {
  const auto points = faces(region, grid, {(axis + 1) % 3, (axis + 2) % 3});
  double longest = 0.0;
  for (const auto& a : points) {
    for (const auto& b : points) {
      if (a.second[axis] == b.second[axis]) longest = std::max(longest, glm::distance(a.first, b.first));
    }
  }
  return longest;
}

double across_by(const imaging::Diameters& d) {
  return glm::dot(glm::normalize(d.in_slice.to_mm - d.in_slice.from_mm),
                  glm::normalize(d.across.to_mm - d.across.from_mm));
}

// Directions of a study whose slices are sagittal: k to the patient's left.
glm::dmat3 sagittal() {
  return {glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(1.0, 0.0, 0.0)};
}

}  // namespace

class MeasuresTest : public QObject {
  Q_OBJECT

 private slots:
  void diameters_are_the_longest_of_all_pairs_data() {
    QTest::addColumn<unsigned>("seed");
    QTest::addColumn<bool>("turned");
    for (unsigned seed = 0; seed < 6; ++seed) QTest::addRow("%u", seed) << seed << (seed % 2 != 0);
  }
  // Pieces that do not touch, some of them a voxel, at the grid's border too.
  void diameters_are_the_longest_of_all_pairs() {
    QFETCH(unsigned, seed);
    QFETCH(bool, turned);
    Geometry grid = grid_of({70, 12, 9}, {0.7, 1.1, 2.5}, kOrigin);
    if (turned) grid.direction = sagittal();
    std::mt19937 random(seed);
    std::vector<std::pair<Index3, Index3>> boxes;
    for (int n = 0; n < 5; ++n) {
      Index3 low, high;
      for (int axis = 0; axis < 3; ++axis) {
        const auto size = static_cast<unsigned>(grid.size[axis]);
        low[axis] = random() % size;
        high[axis] = low[axis] + (n % 2 == 0 ? 1 : random() % size);
      }
      boxes.emplace_back(low, high);
    }
    const Region region = region_where(grid, [&](Index3 voxel) {
      return std::any_of(boxes.begin(), boxes.end(), [&](const auto& box) {
        return glm::all(glm::greaterThanEqual(voxel, box.first)) &&
               glm::all(glm::lessThan(voxel, box.second));
      });
    });
    const auto found = imaging::diameters_of(region, grid);
    QVERIFY(found.has_value());
    const double expected = longest(region, grid);
    QVERIFY2(std::abs(found->longest.length_mm() - expected) < 1e-9,
             qPrintable(QStringLiteral("%1 %2").arg(found->longest.length_mm()).arg(expected)));
    const double in_slice = longest_in_slice(region, grid, turned ? 1 : 2);
    QVERIFY(std::abs(found->in_slice.length_mm() - in_slice) < 1e-9);
    QVERIFY(std::abs(across_by(*found)) < 1e-9);
    QVERIFY(found->across.length_mm() > 0.0);
    QVERIFY(found->across.length_mm() <= found->in_slice.length_mm() + 1e-9);
    // Both of one slice.
    const int across_slices = turned ? 1 : 2;
    const double slice = grid.to_voxel(found->in_slice.from_mm)[across_slices];
    for (const glm::dvec3 end : {found->in_slice.to_mm, found->across.from_mm, found->across.to_mm})
      QVERIFY(std::abs(grid.to_voxel(end)[across_slices] - slice) < 1e-9);
  }

  void an_ellipsoid_has_its_axes_data() {
    QTest::addColumn<double>("turned");
    for (const double degrees : {0.0, 30.0, 75.0, 140.0}) QTest::addRow("%.0f", degrees) << degrees;
  }
  void an_ellipsoid_has_its_axes() {
    QFETCH(double, turned);
    const glm::dvec3 radii_mm(18.0, 7.0, 11.0);
    const Geometry grid = grid_of({100, 100, 60}, {0.5, 0.5, 0.5}, kOrigin);
    const double angle = glm::radians(turned);
    const glm::dvec3 along(std::cos(angle), std::sin(angle), 0.0);
    const glm::dvec3 across(-std::sin(angle), std::cos(angle), 0.0);
    const glm::dvec3 centre = grid.to_patient({50.0, 50.0, 30.0});
    const Region region = region_where(grid, [&](Index3 voxel) {
      const glm::dvec3 way = grid.to_patient(voxel) - centre;
      return glm::length(glm::dvec3(glm::dot(way, along), glm::dot(way, across), way.z) / radii_mm) < 1.0;
    });
    const auto found = imaging::diameters_of(region, grid);
    QVERIFY(found.has_value());
    constexpr double kVoxel = 0.5;
    QVERIFY(std::abs(found->in_slice.length_mm() - 2.0 * radii_mm.x) < kVoxel);
    QVERIFY(std::abs(found->across.length_mm() - 2.0 * radii_mm.y) < kVoxel);
    QVERIFY(std::abs(found->longest.length_mm() - 2.0 * radii_mm.x) < kVoxel);
    QVERIFY(glm::distance(found->centre_mm, centre) < 0.1);
    QVERIFY(std::abs(std::abs(glm::dot(found->main_axes[0], along)) - 1.0) < 1e-3);
    QVERIFY(std::abs(std::abs(found->main_axes[1].z) - 1.0) < 1e-3);
    QVERIFY(std::abs(std::abs(glm::dot(found->main_axes[2], across)) - 1.0) < 1e-3);
    QVERIFY(std::abs(found->reach_mm.x - 36.0) < 1.01 * kVoxel);
    QVERIFY(std::abs(found->reach_mm.y - 22.0) < 1.01 * kVoxel);
    QVERIFY(std::abs(found->reach_mm.z - 14.0) < 1.01 * kVoxel);
  }

  // An arm of 30 by 4 voxels with a foot of 10 beneath one end: the longest line across goes through the
  // foot.
  void a_form_with_a_corner_is_crossed_from_border_to_border() {
    const Geometry grid = grid_of({40, 20, 3}, {1.0, 1.0, 4.0}, kOrigin);
    const Region region = region_where(grid, [](Index3 voxel) {
      const bool arm = voxel.x >= 4 && voxel.x < 34 && voxel.y >= 3 && voxel.y < 7;
      const bool foot = voxel.x >= 4 && voxel.x < 8 && voxel.y >= 3 && voxel.y < 13;
      return voxel.z == 1 && (arm || foot);
    });
    const auto found = imaging::diameters_of(region, grid);
    QVERIFY(found.has_value());
    QVERIFY(std::abs(across_by(*found)) < 1e-9);
    // By dense lines at right angles, through voxels.
    const glm::dvec3 from = grid.to_voxel(found->in_slice.from_mm);
    const glm::dvec3 way = glm::normalize(grid.to_voxel(found->in_slice.to_mm) - from);
    const glm::dvec3 side(-way.y, way.x, 0.0);
    double expected = 0.0;
    for (double at = 0.0; at < 31.0; at += 0.05) {
      double low = 1e9;
      double high = -1e9;
      for (double off = -25.0; off < 25.0; off += 0.05) {
        const glm::dvec3 place = glm::round(from + at * way + off * side);
        if (!region.contains(Index3(place))) continue;
        low = std::min(low, off);
        high = std::max(high, off);
      }
      expected = std::max(expected, high - low);
    }
    QVERIFY2(std::abs(found->across.length_mm() - expected) < 0.75,
             qPrintable(QStringLiteral("%1 %2").arg(found->across.length_mm()).arg(expected)));
    QVERIFY(found->across.length_mm() > 8.0);
  }

  void one_voxel_is_as_large_as_it_is() {
    const Geometry grid = grid_of({5, 5, 5}, {0.5, 0.8, 2.0}, kOrigin);
    const auto found =
        imaging::diameters_of(region_where(grid, [](Index3 v) { return v == Index3(4, 0, 2); }), grid);
    QVERIFY(found.has_value());
    QCOMPARE(found->longest.length_mm(), 2.0);
    QCOMPARE(found->in_slice.length_mm(), 0.8);
    QCOMPARE(found->across.length_mm(), 0.5);
    QVERIFY(!imaging::diameters_of(Region(), grid).has_value());
  }

  void values_are_those_of_plain_loops_data() {
    QTest::addColumn<double>("slope");
    QTest::newRow("rescaled") << 2.0;
    QTest::newRow("the other way round") << -0.5;
  }
  void values_are_those_of_plain_loops() {
    QFETCH(double, slope);
    const Geometry grid = grid_of({20, 15, 10}, {4.0, 4.0, 3.0}, kOrigin);
    std::mt19937 random(7);
    Volume image;
    image.geometry = grid;
    image.slope = slope;
    image.intercept = 10.0;
    image.unit = "SUVbw g/ml";
    std::vector<std::int16_t> stored;
    for (std::int64_t i = 0; i < grid.voxel_count(); ++i)
      stored.push_back(static_cast<std::int16_t>(random() % 2000) - 500);
    image.voxels = stored;
    const Region region =
        region_where(grid, [](Index3 v) { return v.x > 15 && v.y % 3 != 0 && v.z < 7; });  // to the border
    std::vector<double> values;
    double peak = -1e9;
    const double radius_mm = std::cbrt(750.0 / std::numbers::pi);
    for (std::int64_t n = 0; n < grid.voxel_count(); ++n) {
      if (!region.contains(grid.voxel_at(n))) continue;
      values.push_back(image.value(n));
      double sum = 0.0;
      int count = 0;
      for (std::int64_t m = 0; m < grid.voxel_count(); ++m) {
        if (glm::distance(grid.to_patient(grid.voxel_at(m)), grid.to_patient(grid.voxel_at(n))) > radius_mm)
          continue;
        sum += image.value(m);
        ++count;
      }
      peak = std::max(peak, sum / count);
    }
    std::sort(values.begin(), values.end());
    const auto count = static_cast<double>(values.size());
    double mean = 0.0;
    for (const double value : values) mean += value / count;
    double variance = 0.0;
    for (const double value : values) variance += (value - mean) * (value - mean) / count;
    const imaging::InsideValues found = imaging::values_inside(region, image).value();
    const auto near = [](double a, double b) { return std::abs(a - b) < 1e-3; };
    QVERIFY(near(found.mean, mean));
    QVERIFY(near(found.standard_deviation, std::sqrt(variance)));
    QVERIFY(near(found.smallest, values.front()));
    QVERIFY(near(found.largest, values.back()));
    for (std::size_t n = 0; n < imaging::kPercentiles.size(); ++n) {
      const double rank = imaging::kPercentiles[n] / 100.0 * (count - 1.0);
      const auto below = static_cast<std::size_t>(rank);
      const double share = rank - static_cast<double>(below);
      const double expected = values[below] + share * (values[below + 1] - values[below]);
      QVERIFY2(near(found.percentiles[n], expected), qPrintable(QString::number(imaging::kPercentiles[n])));
    }
    QVERIFY(found.uptake.has_value());
    QVERIFY(near(found.uptake->peak, peak));
    QVERIFY(std::abs(found.uptake->total_glycolysis - mean * count * 0.048) < 1e-3);
    image.unit = "HU";
    QVERIFY(!imaging::values_inside(region, image)->uptake.has_value());
  }

  void the_peak_ends_where_the_image_does() {
    const Geometry grid = grid_of({20, 15, 10}, {4.0, 4.0, 3.0}, kOrigin);
    const Region covered = whole({Index3(0), Index3(12, 15, 10)});
    Volume image;
    image.geometry = grid;
    image.unit = "SUVbw g/ml";
    std::vector<float> values;
    for (std::int64_t i = 0; i < grid.voxel_count(); ++i)
      values.push_back(covered.contains(grid.voxel_at(i)) ? 1.5F : 0.0F);
    image.voxels = std::move(values);
    const Region region = whole({Index3(11, 5, 4), Index3(12, 8, 6)});
    QVERIFY(imaging::values_inside(region, image)->uptake->peak < 1.4);
    QCOMPARE(imaging::values_inside(region, image, {}, &covered)->uptake->peak, 1.5);
  }

  void the_search_for_the_peak_can_be_stopped() {
    Volume image;
    image.geometry = grid_of({20, 15, 10}, {4.0, 4.0, 3.0}, kOrigin);
    image.unit = "SUVbw g/ml";
    image.voxels = std::vector<float>(static_cast<std::size_t>(image.geometry.voxel_count()), 1.5F);
    const Region all = whole({Index3(0), image.geometry.size});
    QCOMPARE(imaging::values_inside(all, image)->uptake->peak, 1.5);
    std::stop_source stop;
    stop.request_stop();
    const auto stopped = imaging::values_inside(all, image, {nullptr, stop.get_token()});
    QVERIFY(!stopped);
    QCOMPARE(stopped.error().kind, ErrorKind::cancelled);
  }
};

TIDEMARK_TEST(MeasuresTest)

}  // namespace tidemark::test::measures_test

#include "measures_test.moc"
