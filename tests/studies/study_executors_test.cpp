// Host, compute and stream end with the same mask on a real study.
#include "imaging/filters/filters.h"
#include "imaging/load_study.h"
#include "same_mask.h"
#include "tests/support/test_program.h"

using namespace tidemark;
using namespace tidemark::test;

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
};

TIDEMARK_STUDY_TEST(StudyExecutorsTest)
#include "study_executors_test.moc"
