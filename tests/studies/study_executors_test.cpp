// Host, compute and stream end with the same mask on a real study.
#include "imaging/filters/filters.h"
#include "imaging/load_study.h"
#include "same_mask.h"
#include "solver/speed/speed_registry.h"
#include "tests/support/test_program.h"

using namespace tidemark;
using namespace tidemark::test;

Q_DECLARE_METATYPE(solver::SpeedSetting)

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
      return level_set.paint(solver::sphere_at_voxel(source->geometry, {188, 149, 13}, 8.0),
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
    const auto speed = solver::make_speed(setting, inputs);
    QCOMPARE(failure(speed), QString());
    const auto start = [&](solver::Executor& level_set) -> Status {
      TIDEMARK_TRY(level_set.set_speed(*speed));
      return level_set.paint(solver::sphere_at_voxel(inputs.source->geometry, {188, 149, 13}, 14.0),
                             solver::Brush::add);
    };
    expect_same_mask(inputs.source, inputs.parameters, start, 100);
  }
};

TIDEMARK_STUDY_TEST(StudyExecutorsTest)
#include "study_executors_test.moc"
