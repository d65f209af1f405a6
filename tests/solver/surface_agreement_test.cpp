// The agreement of two surfaces: Dice and distances with known answers.
#include "solver/surface_agreement.h"

#include <glm/geometric.hpp>
#include <random>

#include "solver/point_tree.h"
#include "tests/support/test_program.h"

namespace tidemark::test::surface_agreement_test {

class SurfaceAgreementTest : public QObject {
  Q_OBJECT

  static Geometry grid() { return {{52, 44, 40}, {0.8, 1.0, 1.5}, glm::dmat3(1.0), {3.0, -2.0, 7.0}}; }

  // A ball's distance, clamped as level sets are.
  static solver::Field ball(glm::dvec3 off_mm, double radius_mm, Index3 page_shape = kDefaultPageShape) {
    const Geometry geometry = grid();
    const double band = 2.5;
    const glm::dvec3 centre = geometry.to_patient(0.5 * glm::dvec3(geometry.size - Index3(1))) + off_mm;
    std::vector<float> values;
    for (std::int64_t offset = 0; offset < geometry.voxel_count(); ++offset) {
      const glm::dvec3 point = geometry.to_patient(geometry.voxel_at(offset));
      const double distance = (radius_mm - glm::distance(point, centre)) / 0.8;
      values.push_back(static_cast<float>(std::clamp(distance, -band, band)));
    }
    return solver::Field::from_dense(geometry, values, band, page_shape);
  }

  static solver::SurfaceAgreement between(const solver::Field& a, const solver::Field& b) {
    const auto found = solver::agreement(a, b);
    if (!found) qFatal("%s", found.error().message.c_str());
    return *found;
  }

 private slots:
  void a_surface_agrees_with_itself_whatever_its_pages() {
    const auto same = between(ball({1, 2, 0}, 11.0), ball({1, 2, 0}, 11.0, {4, 8, 16}));
    QCOMPARE(same.dice, 1.0);
    QCOMPARE(same.distance->mean_mm, 0.0);
    QCOMPARE(same.distance->largest_mm, 0.0);
  }

  // Crossings are a fraction of a voxel apart: so exact is the nearest of them.
  void balls_around_one_point_are_apart_by_their_radii() {
    const solver::Field small = ball({0, 0, 0}, 8.0);
    const solver::Field large = ball({0, 0, 0}, 13.0);
    const auto found = between(small, large);
    QVERIFY(std::abs(found.distance->mean_mm - 5.0) < 0.1);
    QVERIFY(std::abs(found.distance->largest_mm - 5.0) < 0.15);
    QVERIFY(std::abs(found.distance->most_mm - 5.0) < 0.15);
    QCOMPARE(found.dice, dice(small.mask(), large.mask()));
    QCOMPARE(between(large, small).distance->mean_mm, found.distance->mean_mm);
  }

  // A ball moved by d: between 0 and d apart, d / 2 in the mean (over the ball's area: |cos| has mean 1/2).
  void a_ball_that_was_moved_is_apart_by_no_more_than_that() {
    const auto found = between(ball({0, 0, 0}, 10.0), ball({2.0, 0, 0}, 10.0));
    QVERIFY(std::abs(found.distance->largest_mm - 2.0) < 0.1);
    QVERIFY(std::abs(found.distance->mean_mm - 1.0) < 0.1);
    // Of the ball's area a part s lies where |cos| < s, so that 95 % are no farther than 0.95 d.
    QVERIFY2(std::abs(found.distance->most_mm - 1.9) < 0.1,
             qPrintable(QString::number(found.distance->most_mm)));
  }

  // A spot far away moves the Hausdorff distance and hardly the 95th percentile, which is what it is for.
  void a_few_voxels_far_away_do_not_count_in_the_percentile() {
    const solver::Field clean = ball({0, 0, 0}, 10.0);
    std::vector<float> values = clean.dense();
    values[static_cast<std::size_t>(clean.geometry.offset({2, 22, 20}))] = 0.5F;
    const auto found = between(clean, solver::Field::from_dense(clean.geometry, values, 2.5));
    QVERIFY(found.distance->largest_mm > 7.0);
    QCOMPARE(found.distance->most_mm, 0.0);
    QVERIFY(found.distance->mean_mm < 0.05);
  }

  void a_surface_is_measured_once_for_many_comparisons() {
    const solver::Field small = ball({0, 0, 0}, 8.0);
    const auto known = solver::MeasuredSurface::of(small);
    QVERIFY(known && !known->empty());
    for (const double radius : {9.0, 12.0}) {
      const solver::Field large = ball({0, 0, 0}, radius);
      const auto other = solver::MeasuredSurface::of(large);
      const auto found = other->distance_to(*known);
      QVERIFY(found && *found);
      QCOMPARE((*found)->mean_mm, between(small, large).distance->mean_mm);
      QCOMPARE((*found)->most_mm, between(small, large).distance->most_mm);
    }
    QVERIFY(solver::MeasuredSurface::of(solver::Field::empty(grid(), 2.5))->empty());
  }

  void what_has_no_surface_has_no_distance() {
    const solver::Field nothing = solver::Field::empty(grid(), 2.5);
    QVERIFY(!between(nothing, ball({0, 0, 0}, 5.0)).distance);
    QCOMPARE(between(nothing, ball({0, 0, 0}, 5.0)).dice, 0.0);
    QCOMPARE(between(nothing, nothing).dice, 1.0);
  }

  void other_grids_and_a_stop_are_told() {
    const solver::Field other = solver::Field::empty({{9, 9, 9}, glm::dvec3(1.0), glm::dmat3(1.0), {}}, 2.5);
    QCOMPARE(solver::agreement(other, ball({0, 0, 0}, 5.0)).error().kind, ErrorKind::usage);
    std::stop_source stop;
    stop.request_stop();
    QCOMPARE(solver::agreement(ball({0, 0, 0}, 5.0), ball({0, 0, 0}, 5.0), {nullptr, stop.get_token()})
                 .error()
                 .kind,
             ErrorKind::cancelled);
  }

  void the_nearest_of_many_points_is_found() {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> place(-20.0F, 20.0F);
    const auto point = [&] { return glm::vec3(place(random), place(random), std::round(place(random))); };
    std::vector<glm::vec3> points(3000);
    for (glm::vec3& one : points) one = point();
    const solver::PointTree tree(points);
    std::size_t hint = 0;
    for (int i = 0; i < 300; ++i) {
      const glm::vec3 from = 2.0F * point();
      float least = std::numeric_limits<float>::infinity();
      for (const glm::vec3& one : points) least = std::min(least, glm::distance(from, one));
      QVERIFY(std::abs(tree.distance(from, hint) - least) < 1e-4F);
    }
  }
};

TIDEMARK_TEST(SurfaceAgreementTest)

}  // namespace tidemark::test::surface_agreement_test

#include "surface_agreement_test.moc"
