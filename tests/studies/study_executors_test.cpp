// Host, compute and stream end with the same mask on a real study.
#include <set>

#include "imaging/filters/filters.h"
#include "imaging/load_study.h"
#include "same_mask.h"
#include "solver/speed/speed_registry.h"
#include "tests/support/test_program.h"

namespace tidemark::test::study_executors_test {

namespace {

constexpr Index3 kSeed{188, 149, 13};  // in the tumour

// A disc inside, and four outside of what lies around it.
std::shared_ptr<const solver::Strokes> strokes_around(const Geometry& geometry, Index3 voxel) {
  constexpr std::int64_t kRadius = 8;
  constexpr std::int64_t kFar = 70;
  std::set<std::int64_t> inside;
  std::set<std::int64_t> outside;
  for (std::int64_t y = -kRadius; y <= kRadius; ++y) {
    for (std::int64_t x = -kRadius; x <= kRadius; ++x) {
      if (x * x + y * y > kRadius * kRadius) continue;
      inside.insert(geometry.offset(voxel + Index3(x, y, 0)));
      for (const Index3 way :
           {Index3(kFar, 0, 0), Index3(-kFar, 0, 0), Index3(0, kFar, 0), Index3(0, -kFar, 0)})
        outside.insert(geometry.offset(voxel + way + Index3(x, y, 0)));
    }
  }
  auto strokes = std::make_shared<solver::Strokes>();
  strokes->inside.assign(inside.begin(), inside.end());
  strokes->outside.assign(outside.begin(), outside.end());
  return strokes;
}

}  // namespace

class StudyExecutorsTest : public QObject {
  Q_OBJECT

 private slots:
  void all_end_with_the_same_mask_on_a_tumour() {
    auto image = imaging::load_volume(studies_folder() / "d03_mr_tumour_brainix/FLAIR");
    QCOMPARE(failure(image), QString());
    auto smoothed = imaging::smooth(*image, 1.2);
    QCOMPARE(failure(smoothed), QString());
    solver::Parameters parameters;
    parameters.target = 440;
    parameters.range = 140;
    parameters.alpha = 0.97;
    const auto source = std::make_shared<const Volume>(std::move(*smoothed));
    const auto start = [&](solver::Executor& level_set) {
      return level_set.paint(solver::sphere_at_voxel(source->geometry, glm::dvec3(kSeed), 8.0),
                             solver::Brush::add);
    };
    expect_same_mask(source, parameters, start, 300);
  }

  void all_end_with_the_same_mask_for_every_speed_function_data() {
    QTest::addColumn<solver::SpeedSetting>("setting");
    const auto row = [](const char* name, std::vector<solver::SpeedTerm> terms, solver::Combine combine) {
      QTest::newRow(name) << solver::SpeedSetting{std::move(terms), combine};
    };
    row("regions", {{"regions", {}}}, solver::Combine::least);
    row("regions within 15 mm", {{"regions", {{"radius", 15.0}}}}, solver::Combine::least);
    row("edges", {{"edges", {}}}, solver::Combine::least);
    row("examples", {{"examples", {}}}, solver::Combine::least);
    row("the product of tent and edges", {{"tent", {}}, {"edges", {}}}, solver::Combine::product);
  }

  void all_end_with_the_same_mask_for_every_speed_function() {
    QFETCH(solver::SpeedSetting, setting);
    auto image = imaging::load_volume(studies_folder() / "d03_mr_tumour_brainix/FLAIR");
    QCOMPARE(failure(image), QString());
    solver::SpeedInputs inputs;
    inputs.source = std::make_shared<const Volume>(std::move(*image));
    inputs.parameters.target = 440;
    inputs.parameters.range = 140;
    inputs.parameters.alpha = 0.6;
    inputs.strokes = strokes_around(inputs.source->geometry, kSeed);
    const auto speed = solver::make_speed(setting, inputs);
    QCOMPARE(failure(speed), QString());
    const auto start = [&](solver::Executor& level_set) -> Status {
      TIDEMARK_TRY(level_set.set_speed(*speed));
      return level_set.paint(solver::sphere_at_voxel(inputs.source->geometry, glm::dvec3(kSeed), 14.0),
                             solver::Brush::add);
    };
    expect_same_mask(inputs.source, inputs.parameters, start, 100);
  }
};

TIDEMARK_STUDY_TEST(StudyExecutorsTest)

}  // namespace tidemark::test::study_executors_test

#include "study_executors_test.moc"
