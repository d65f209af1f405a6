// Discs that a brush paints in slices, and what becomes of strokes.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "engine/slice_slab.h"
#include "engine/stroke_painting.h"
#include "tests/support/test_program.h"

namespace tidemark::test::slice_slab_test {

using namespace engine;

class SliceSlabTest : public QObject {
  Q_OBJECT

 private slots:
  void a_disc_is_round_and_in_one_slice();
  void discs_are_round_in_mm_where_voxels_are_not();
  void a_plane_between_two_slices_belongs_to_the_one_that_is_seen();
  void a_place_is_near_the_slice_up_to_half_a_voxel();
  void a_tilted_grid_has_one_layer();
  void a_tilted_slice_has_all_that_is_near_it();
  void the_voxel_under_the_mouse_is_always_painted();
  void a_polygon_takes_what_it_surrounds();
  void beside_the_volume_there_is_nothing();
  void a_later_stroke_wins();
  void strokes_that_touch_are_one();
  void spheres_cover_the_strokes_and_start_inside();

 private:
  static Geometry grid(Index3 size, glm::dvec3 spacing_mm = glm::dvec3(1.0)) {
    Geometry geometry;
    geometry.size = size;
    geometry.spacing_mm = spacing_mm;
    geometry.origin_mm = {-7.0, 11.0, 3.0};
    return geometry;
  }
};

void SliceSlabTest::a_disc_is_round_and_in_one_slice() {
  const Geometry g = grid({40, 40, 20});
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 normal(0.0);
    normal[axis] = 1.0;
    const glm::dvec3 centre = g.to_patient({20.0, 20.0, 10.0});
    const auto voxels = SliceSlab(g, centre, normal).disc(centre, 2.5);
    // x^2 + y^2 <= 6.25 has 21 whole solutions.
    QCOMPARE(voxels.size(), std::size_t{21});
    QVERIFY(std::ranges::is_sorted(voxels));
    for (const std::int64_t offset : voxels) QCOMPARE(g.voxel_at(offset)[axis], axis == 2 ? 10 : 20);
  }
}

void SliceSlabTest::discs_are_round_in_mm_where_voxels_are_not() {
  const Geometry g = grid({40, 40, 20}, {0.5, 0.5, 5.0});
  const glm::dvec3 centre = g.to_patient({20.0, 20.0, 10.0});
  const SliceSlab axial(g, centre, {0.0, 0.0, 1.0});
  QCOMPARE(axial.finest_mm(), 0.5);
  QCOMPARE(axial.disc(centre, 2.5 * 0.5).size(), std::size_t{21});
  // In a coronal slice the next row is 5 mm away.
  const SliceSlab coronal(g, centre, {0.0, 1.0, 0.0});
  QCOMPARE(coronal.finest_mm(), 0.5);
  QCOMPARE(coronal.disc(centre, 1.25).size(), std::size_t{5});
  QCOMPARE(coronal.disc(centre, 5.1).size(), std::size_t{21 + 2 * 5});  // the rows above and below: 1.0 mm
}

// To the one that a picture shows there: llround(4.5).
void SliceSlabTest::a_plane_between_two_slices_belongs_to_the_one_that_is_seen() {
  Geometry g = grid({10, 10, 10});
  for (const double way : {1.0, -1.0}) {
    g.direction[2] = {0.0, 0.0, way};
    const glm::dvec3 between = g.to_patient({5.0, 5.0, 4.5});
    for (const double sign : {1.0, -1.0}) {
      const SliceSlab slab(g, between, {0.0, 0.0, sign});
      for (std::int64_t k = 0; k < 10; ++k) QCOMPARE(slab.contains({5, 5, k}), k == 5);
      QCOMPARE(slab.voxel_of(5, 5)->z, std::int64_t{5});
    }
  }
}

void SliceSlabTest::a_place_is_near_the_slice_up_to_half_a_voxel() {
  const Geometry g = grid({10, 10, 10}, {1.0, 1.0, 3.0});
  for (const double sign : {1.0, -1.0}) {
    const SliceSlab slab(g, g.to_patient({5.0, 5.0, 4.0}), {0.0, 0.0, sign});
    for (const double k : {3.5, 3.6, 4.0, 4.5}) QVERIFY(slab.is_near(g.to_patient({0.0, 9.0, k})));
    for (const double k : {3.49, 4.51, 5.0}) QVERIFY(!slab.is_near(g.to_patient({5.0, 5.0, k})));
  }
}

void SliceSlabTest::a_tilted_grid_has_one_layer() {
  Geometry g = grid({30, 30, 30}, {1.0, 1.0, 2.0});
  const double angle = 0.3;
  g.direction = {
      {1.0, 0.0, 0.0}, {0.0, std::cos(angle), std::sin(angle)}, {0.0, -std::sin(angle), std::cos(angle)}};
  const glm::dvec3 centre = g.to_patient({15.0, 15.0, 15.0});
  const SliceSlab slab(g, centre, {0.0, 0.0, 1.0});
  QCOMPARE(slab.axes(), (std::array<int, 3>{0, 1, 2}));
  const auto disc = slab.disc(centre, 4.0);
  QVERIFY(disc.size() > 30);
  for (const std::int64_t offset : disc) {
    const glm::dvec3 place = g.to_patient(glm::dvec3(g.voxel_at(offset)));
    QVERIFY(std::abs(place.z - centre.z) <= 1.0);
    QVERIFY(glm::length(glm::dvec2(place - centre)) <= 4.0);
  }
  QVERIFY(slab.meets({0, 0, 0}, {30, 30, 30}));
  QVERIFY(!slab.meets({0, 0, 24}, {8, 8, 6}));
}

// Where voxels are longest across the normal, a column has many voxels near the plane.
void SliceSlabTest::a_tilted_slice_has_all_that_is_near_it() {
  const Geometry g = grid({40, 20, 30}, {0.5, 0.7, 6.0});
  const glm::dvec3 centre = g.to_patient({20.0, 10.0, 15.0});
  for (const glm::dvec3 direction :
       {glm::dvec3(0.8, 0.1, 0.6), {0.8, 0.1, -0.6}, {0.2, 0.8, 0.7}, {0.0, 0.0, 1.0}}) {
    const glm::dvec3 normal = glm::normalize(direction);
    const SliceSlab slab(g, centre, normal);
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.3, 1.0, 0.2), normal));
    const glm::dvec3 up = glm::cross(normal, right);
    for (const double radius : {2.03, 7.31, 40.1}) {
      std::vector<std::int64_t> expected;
      for (std::int64_t n = 0; n < g.voxel_count(); ++n) {
        const Index3 voxel = g.voxel_at(n);
        const glm::dvec3 way = g.to_patient(glm::dvec3(voxel)) - centre;
        const bool within = std::hypot(glm::dot(way, right), glm::dot(way, up)) <= radius;
        if (within && slab.contains(voxel)) expected.push_back(n);
      }
      QVERIFY(expected.size() > 5 && slab.disc(centre, radius) == expected);
    }
    // Around the whole grid.
    std::vector<glm::dvec3> square;
    for (const auto& [x, y] : {std::pair(-1.0, -1.0), {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}})
      square.push_back(centre + 900.0 * (x * right + y * up));
    QVERIFY(slab.inside(square) == slab.disc(centre, 900.0));
  }
}

void SliceSlabTest::the_voxel_under_the_mouse_is_always_painted() {
  const Geometry g = grid({10, 10, 10});
  const glm::dvec3 corner = g.to_patient({5.4, 5.4, 5.0});
  const auto voxels = SliceSlab(g, corner, {0.0, 0.0, 1.0}).disc(corner, 0.1);
  QCOMPARE(voxels, std::vector<std::int64_t>{g.offset({5, 5, 5})});
}

void SliceSlabTest::a_polygon_takes_what_it_surrounds() {
  const Geometry g = grid({30, 24, 18}, {1.0, 0.5, 2.0});
  for (int axis = 0; axis < 3; ++axis) {
    glm::dvec3 normal(0.0);
    normal[axis] = 1.0;
    const glm::dvec3 centre = g.to_patient({14.0, 11.0, 9.0});
    const SliceSlab slab(g, centre, normal);
    const int u = (axis + 1) % 3;
    const int v = (axis + 2) % 3;
    // A triangle that reaches out of the volume, and a bow tie.
    for (const auto& corners :
         {std::vector<glm::dvec2>{{-50.0, -3.3}, {7.1, -2.2}, {1.4, 5.7}},
          std::vector<glm::dvec2>{{-3.3, -3.3}, {3.4, 3.2}, {3.4, -3.1}, {-3.2, 3.5}}}) {
      std::vector<glm::dvec3> polygon;
      for (const glm::dvec2 corner : corners) {
        polygon.push_back(centre);
        polygon.back()[u] += corner.x;
        polygon.back()[v] += corner.y;
      }
      std::set<std::int64_t> expected;
      for (std::int64_t n = 0; n < g.voxel_count(); ++n) {
        const Index3 voxel = g.voxel_at(n);
        if (!slab.contains(voxel)) continue;
        const glm::dvec3 at = g.to_patient(voxel) - centre;
        bool inside = false;
        for (std::size_t c = 0; c < corners.size(); ++c) {
          const glm::dvec2 a = corners[c];
          const glm::dvec2 b = corners[(c + 1) % corners.size()];
          if ((a.y <= at[v]) != (b.y <= at[v]) && at[u] < a.x + (at[v] - a.y) * (b.x - a.x) / (b.y - a.y))
            inside = !inside;
        }
        if (inside) expected.insert(n);
      }
      const auto found = slab.inside(polygon);
      QVERIFY(!found.empty() && std::ranges::is_sorted(found));
      QVERIFY(std::set<std::int64_t>(found.begin(), found.end()) == expected);
    }
    QVERIFY(slab.inside({centre, centre}).empty());
  }
  // In a tilted slice: the slab's voxels in columns that meet the plane inside.
  const glm::dvec3 tilted = glm::normalize(glm::dvec3(0.3, -0.2, 1.0));
  const glm::dvec3 centre = g.to_patient({14.0, 11.0, 9.0});
  const SliceSlab slab(g, centre, tilted);
  const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(0.0, 1.0, 0.0), tilted));
  const glm::dvec3 up = glm::cross(tilted, right);
  std::vector<glm::dvec3> square;
  for (const auto& [x, y] : {std::pair(-4.0, -3.0), {4.0, -3.0}, {4.0, 3.0}, {-4.0, 3.0}})
    square.push_back(centre + x * right + y * up);
  std::vector<std::int64_t> expected;
  for (std::int64_t n = 0; n < g.voxel_count(); ++n) {
    const Index3 voxel = g.voxel_at(n);
    glm::dvec3 foot = g.to_patient(voxel) - centre;
    foot.z -= glm::dot(foot, tilted) / tilted.z;
    const bool inside = std::abs(glm::dot(foot, right)) < 4.0 && std::abs(glm::dot(foot, up)) < 3.0;
    if (inside && slab.contains(voxel)) expected.push_back(n);
  }
  QVERIFY(expected.size() > 60);
  QVERIFY(slab.inside(square) == expected);
}

void SliceSlabTest::beside_the_volume_there_is_nothing() {
  const Geometry g = grid({10, 10, 10});
  const glm::dvec3 beside = g.to_patient({-20.0, 5.0, 5.0});
  QVERIFY(SliceSlab(g, beside, {0.0, 0.0, 1.0}).disc(beside, 2.5).empty());
  const glm::dvec3 border = g.to_patient({0.0, 5.0, 5.0});
  QCOMPARE(SliceSlab(g, border, {0.0, 0.0, 1.0}).disc(border, 1.0).size(), std::size_t{4});
}

void SliceSlabTest::a_later_stroke_wins() {
  const auto first = painted(nullptr, {3, 4, 5, 6}, Mark::inside);
  QVERIFY(first && !can_teach(first.get()));
  const auto second = painted(first.get(), {5, 6, 7}, Mark::outside);
  QCOMPARE(second->inside, (std::vector<std::int64_t>{3, 4}));
  QCOMPARE(second->outside, (std::vector<std::int64_t>{5, 6, 7}));
  QVERIFY(can_teach(second.get()));
  const auto third = painted(second.get(), {4, 5}, Mark::none);
  QCOMPARE(third->inside, std::vector<std::int64_t>{3});
  QCOMPARE(third->outside, (std::vector<std::int64_t>{6, 7}));
  QVERIFY(!painted(third.get(), {3, 6, 7}, Mark::none));
  QCOMPARE(first->inside.size(), std::size_t{4});  // the one before is as it was
}

void SliceSlabTest::strokes_that_touch_are_one() {
  const Geometry g = grid({20, 20, 20});
  const glm::dvec3 normal(0.0, 0.0, 1.0);
  std::set<std::int64_t> voxels;
  const auto add = [&](glm::dvec3 voxel) {
    const glm::dvec3 place = g.to_patient(voxel);
    for (const std::int64_t offset : SliceSlab(g, place, normal).disc(place, 2.5)) voxels.insert(offset);
  };
  const auto count = [&] { return count_strokes(g, {voxels.begin(), voxels.end()}); };
  QCOMPARE(count(), 0);
  add({4.0, 4.0, 4.0});
  add({14.0, 4.0, 4.0});
  add({4.0, 4.0, 6.0});  // another slice, one between them
  QCOMPARE(count(), 3);
  QVERIFY(middles_of_strokes(g, {voxels.begin(), voxels.end()}) ==
          (std::vector<Index3>{{4, 4, 4}, {14, 4, 4}, {4, 4, 6}}));
  add({4.0, 4.0, 5.0});
  QCOMPARE(count(), 2);
}

void SliceSlabTest::spheres_cover_the_strokes_and_start_inside() {
  const Geometry g = grid({40, 40, 20}, {0.5, 0.5, 2.0});
  std::set<std::int64_t> voxels;
  for (double x = 8.0; x < 30.0; x += 1.0) {
    const glm::dvec3 place = g.to_patient({x, 20.0, 10.0});
    for (const std::int64_t offset : SliceSlab(g, place, {0.0, 0.0, 1.0}).disc(place, 1.25))
      voxels.insert(offset);
  }
  const std::vector<std::int64_t> stroke(voxels.begin(), voxels.end());
  const auto spheres = spheres_along(g, stroke);
  QVERIFY(spheres.size() >= 5 && spheres.size() <= stroke.size() / 4);
  for (const solver::Sphere& sphere : spheres) {
    QCOMPARE(sphere.radius_mm, 1.0);
    QVERIFY(std::ranges::binary_search(stroke, g.offset(Index3(glm::round(g.to_voxel(sphere.centre_mm))))));
  }
  for (const std::int64_t offset : stroke) {
    const glm::dvec3 place = g.to_patient(glm::dvec3(g.voxel_at(offset)));
    QVERIFY(std::ranges::any_of(spheres, [&](const solver::Sphere& sphere) {
      return glm::distance(sphere.centre_mm, place) < 1.5 * sphere.radius_mm + 1e-9;
    }));
  }
  QVERIFY(spheres_along(g, {}).empty());
}

TIDEMARK_TEST(SliceSlabTest)

}  // namespace tidemark::test::slice_slab_test

#include "slice_slab_test.moc"
