// The histogram of |grad phi|: fields of known gradient, and what rescaling makes of others.
#include "solver/gradient_histogram.h"

#include <numeric>

#include "level_sets.h"
#include "tests/support/support.h"
#include "tests/support/test_program.h"

namespace tidemark::test::gradient_histogram_test {

using solver::GradientHistogram;

class GradientHistogramTest : public QObject {
  Q_OBJECT

  static Geometry grid(glm::dvec3 spacing) {
    return {{30, 26, 22}, spacing, glm::dmat3(1.0), {1.0, 2.0, 3.0}};
  }
  // A ball's distance times `steepness`, clamped.
  static solver::Field ball(double steepness, glm::dvec3 spacing = glm::dvec3(1.0),
                            Index3 page_shape = kDefaultPageShape) {
    const Geometry geometry = grid(spacing);
    const glm::dvec3 centre = geometry.to_patient(0.5 * glm::dvec3(geometry.size - Index3(1)));
    const double smallest = std::min({spacing.x, spacing.y, spacing.z});
    std::vector<float> values;
    for (std::int64_t offset = 0; offset < geometry.voxel_count(); ++offset) {
      const double distance = 8.0 - glm::distance(geometry.to_patient(geometry.voxel_at(offset)), centre);
      values.push_back(static_cast<float>(std::clamp(steepness * distance / smallest, -2.5, 2.5)));
    }
    return solver::Field::from_dense(geometry, values, 2.5, page_shape);
  }
  static GradientHistogram of(const solver::Field& phi, double highest = 2.0) {
    auto found = solver::gradient_histogram(phi, highest);
    if (!found) qFatal("%s", found.error().message.c_str());
    return *found;
  }

 private slots:
  void a_distance_has_gradient_one_data() {
    QTest::addColumn<glm::dvec3>("spacing");
    QTest::newRow("cubes") << glm::dvec3(1.0);
    QTest::newRow("half a mm") << glm::dvec3(0.5);
    QTest::newRow("thick slices") << glm::dvec3(1.0, 1.0, 1.6);
  }
  void a_distance_has_gradient_one() {
    QFETCH(glm::dvec3, spacing);
    const GradientHistogram found = of(ball(1.0, spacing));
    QVERIFY(found.near.voxels > 300);
    QVERIFY(found.near.voxels <= found.band.voxels);
    QVERIFY(std::abs(found.near.mean - 1.0) < 0.03);
    QVERIFY(found.near.deviation < 0.05);
    // All of them in the bins around 1.
    const auto bin = static_cast<std::size_t>(GradientHistogram::kBins / 2);
    std::int64_t around = 0;
    for (std::size_t i = bin - 4; i < bin + 4; ++i) around += found.near.counts[i];
    QVERIFY(around > 95 * found.near.voxels / 100);
  }

  void every_voxel_is_counted_once_whatever_its_page() {
    const GradientHistogram found = of(ball(0.7));
    for (const GradientHistogram::Part& part : {found.near, found.band}) {
      QCOMPARE(std::accumulate(part.counts.begin(), part.counts.end(), std::int64_t{0}), part.voxels);
    }
    const GradientHistogram other = of(ball(0.7, glm::dvec3(1.0), {16, 16, 1}));
    QCOMPARE(other.near.counts, found.near.counts);
    QCOMPARE(other.band.counts, found.band.counts);
    QVERIFY(std::abs(other.near.mean - found.near.mean) < 1e-12);
  }

  void a_flat_field_is_found_flat_and_a_steep_one_steep() {
    QVERIFY(std::abs(of(ball(0.4)).near.mean - 0.4) < 0.02);
    const GradientHistogram steep = of(ball(1.2), 1.0);
    QVERIFY(std::abs(steep.near.mean - 1.2) < 0.05);
    QVERIFY(steep.near.counts.back() > 9 * steep.near.voxels / 10);  // beyond the last bin
  }

  // What the term is there for.
  void rescaling_brings_the_mean_to_its_target() {
    for (const double target : {1.0, 0.6}) {
      solver::Parameters parameters;
      parameters.data_term = false;
      parameters.curvature_term = false;
      parameters.target_gradient = target;
      auto volume = std::make_shared<Volume>();
      volume->geometry = grid(glm::dvec3(1.0));
      volume->voxels = std::vector<float>(static_cast<std::size_t>(volume->geometry.voxel_count()), 0.0F);
      const auto level_set = executor(solver::ExecutorKind::host, volume, parameters);
      QVERIFY(level_set->restore(ball(0.4)));
      run(*level_set, 300);
      const GradientHistogram after = of(level_set->snapshot().value(), 2.0 * target);
      QVERIFY2(std::abs(after.near.mean / target - 1.0) < 0.05, qPrintable(QString::number(after.near.mean)));
    }
  }

  void without_a_surface_there_is_nothing_and_a_stop_is_told() {
    QCOMPARE(of(solver::Field::empty(grid(glm::dvec3(1.0)), 2.5)).band.voxels, std::int64_t{0});
    std::stop_source stop;
    stop.request_stop();
    QCOMPARE(solver::gradient_histogram(ball(1.0), 2.0, {nullptr, stop.get_token()}).error().kind,
             ErrorKind::cancelled);
  }
};

TIDEMARK_TEST(GradientHistogramTest)

}  // namespace tidemark::test::gradient_histogram_test

#include "gradient_histogram_test.moc"
