// Lines along edges: they stay on them, in any slice and on any spacing.
#include "engine/livewire.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <iterator>
#include <numbers>
#include <random>

#include "tests/support/test_program.h"

namespace tidemark::test::livewire_test {

using engine::Livewire;
using engine::SliceSlab;

namespace {

constexpr double kRadiusMm = 20.0;

// A bright ball with noise around the middle of the grid.
std::shared_ptr<const Volume> noisy_ball(Index3 size, glm::dvec3 spacing_mm) {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = size;
  volume->geometry.spacing_mm = spacing_mm;
  volume->geometry.origin_mm = {-3.0, 8.0, 21.0};
  std::vector<std::int16_t> values(static_cast<std::size_t>(volume->geometry.voxel_count()));
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0.0, 15.0);
  const glm::dvec3 middle = volume->geometry.to_patient(0.5 * glm::dvec3(size));
  for (std::size_t at = 0; at < values.size(); ++at) {
    const Index3 voxel = volume->geometry.voxel_at(static_cast<std::int64_t>(at));
    const bool inside = glm::distance(volume->geometry.to_patient(glm::dvec3(voxel)), middle) < kRadiusMm;
    values[at] = static_cast<std::int16_t>(std::lround((inside ? 100.0 : 0.0) + noise(random)));
  }
  volume->voxels = std::move(values);
  return volume;
}

glm::dvec3 middle_of(const Volume& volume) {
  return volume.geometry.to_patient(0.5 * glm::dvec3(volume.geometry.size));
}

}  // namespace

class LivewireTest : public QObject {
  Q_OBJECT

 private slots:
  void lines_between_a_few_clicks_are_the_outline_data();
  void lines_between_a_few_clicks_are_the_outline();
  void a_line_goes_on_straight_beyond_its_reach();
  void where_nothing_has_an_edge_it_is_straight();
  void a_search_goes_on_where_the_last_one_ended();
};

void LivewireTest::lines_between_a_few_clicks_are_the_outline_data() {
  QTest::addColumn<glm::dvec3>("normal");
  QTest::addColumn<glm::dvec3>("spacing_mm");
  QTest::newRow("axial") << glm::dvec3(0.0, 0.0, 1.0) << glm::dvec3(1.0);
  QTest::newRow("coronal, long voxels") << glm::dvec3(0.0, 1.0, 0.0) << glm::dvec3(0.8, 0.8, 2.0);
  QTest::newRow("oblique") << glm::normalize(glm::dvec3(0.3, -0.2, 1.0)) << glm::dvec3(1.0);
}

void LivewireTest::lines_between_a_few_clicks_are_the_outline() {
  QFETCH(glm::dvec3, normal);
  QFETCH(glm::dvec3, spacing_mm);
  const auto volume = noisy_ball(Index3(glm::ceil(64.0 / spacing_mm)), spacing_mm);
  const glm::dvec3 middle = middle_of(*volume);
  const SliceSlab slab(volume->geometry, middle, normal);
  const glm::dvec3 u = glm::normalize(glm::cross(normal, glm::dvec3(0.4, 0.9, 0.1)));
  const glm::dvec3 v = glm::cross(normal, u);
  // Five clicks that miss the edge by up to 1.5 mm.
  std::vector<glm::dvec3> corners;
  for (int n = 0; n < 5; ++n) {
    const double angle = 2.0 * std::numbers::pi * n / 5.0 + 0.2;
    const double radius = kRadiusMm + (n % 2 == 0 ? 1.5 : -1.5);
    corners.push_back(middle + radius * (std::cos(angle) * u + std::sin(angle) * v));
  }
  Livewire wire(slab, volume);
  std::vector<glm::dvec3> outline;
  for (std::size_t n = 0; n < corners.size(); ++n) {
    wire.begin_at(corners[n]);
    const auto line = wire.way_to(corners[(n + 1) % corners.size()]);
    QVERIFY(line.back() == corners[(n + 1) % corners.size()]);
    outline.insert(outline.end(), line.begin(), line.end());
  }
  for (const glm::dvec3& point : outline) QVERIFY(std::abs(glm::dot(point - middle, normal)) < 1e-5);
  const auto dice = [&](const std::vector<glm::dvec3>& polygon) {
    const auto voxels = slab.inside(polygon);
    const auto disc = slab.disc(middle, kRadiusMm);
    std::vector<std::int64_t> both;
    std::set_intersection(voxels.begin(), voxels.end(), disc.begin(), disc.end(), std::back_inserter(both));
    return 2.0 * static_cast<double>(both.size()) / static_cast<double>(voxels.size() + disc.size());
  };
  QVERIFY2(dice(outline) > 0.95, qPrintable(QString::number(dice(outline))));
  QVERIFY2(dice(corners) < 0.90, qPrintable(QString::number(dice(corners))));
}

void LivewireTest::a_line_goes_on_straight_beyond_its_reach() {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = {400, 40, 1};
  volume->voxels = std::vector<std::int16_t>(400 * 40, 5);
  Livewire wire(SliceSlab(volume->geometry, {}, {0.0, 0.0, 1.0}), volume);
  wire.begin_at({10.0, 20.0, 0.0});
  const auto line = wire.way_to({390.0, 20.0, 0.0});
  QCOMPARE(line.back().x, 390.0);
  QVERIFY(line.size() > 100);
  const glm::dvec3 last = line[line.size() - 2];
  QVERIFY2(last.x <= 10.0 + Livewire::kReach, qPrintable(QString::number(last.x)));
  // A place beside the volume is a place, too.
  QCOMPARE(wire.way_to({-90.0, 300.0, 0.0}).back().y, 300.0);
}

void LivewireTest::where_nothing_has_an_edge_it_is_straight() {
  auto volume = std::make_shared<Volume>();
  volume->geometry.size = {60, 60, 1};
  volume->voxels = std::vector<std::int16_t>(60 * 60, -1000);
  Livewire wire(SliceSlab(volume->geometry, {}, {0.0, 0.0, 1.0}), volume);
  wire.begin_at({5.0, 5.0, 0.0});
  for (const glm::dvec3& point : wire.way_to({45.0, 45.0, 0.0})) QCOMPARE(point.x, point.y);
  QCOMPARE(wire.way_to({5.0, 5.0, 0.0}).size(), std::size_t{1});
}

void LivewireTest::a_search_goes_on_where_the_last_one_ended() {
  const auto volume = noisy_ball({64, 64, 64}, glm::dvec3(1.0));
  const glm::dvec3 middle = middle_of(*volume);
  const SliceSlab slab(volume->geometry, middle, {0.0, 0.0, 1.0});
  const glm::dvec3 from = middle + glm::dvec3(kRadiusMm, 0.0, 0.0);
  const glm::dvec3 to = middle - glm::dvec3(kRadiusMm, 0.0, 0.0);
  Livewire at_once(slab, volume);
  at_once.begin_at(from);
  Livewire step_by_step(slab, volume);
  step_by_step.begin_at(from);
  for (double x = 19.0; x > -20.0; x -= 3.0) (void)step_by_step.way_to(middle + glm::dvec3(x, 10.0, 0.0));
  QVERIFY(step_by_step.way_to(to) == at_once.way_to(to));
  // Back to the first corner after it has begun elsewhere.
  step_by_step.begin_at(to);
  QVERIFY(step_by_step.way_to(from).back() == from);
}

TIDEMARK_TEST(LivewireTest)

}  // namespace tidemark::test::livewire_test

#include "livewire_test.moc"
