// Host, compute and stream end with the same mask on whole phantoms.
#include "imaging/filters/filters.h"
#include "imaging/phantom/phantom.h"
#include "same_mask.h"
#include "solver/distance_transform.h"
#include "tests/support/test_program.h"

using namespace tidemark;
using namespace tidemark::test;

class PhantomExecutorsTest : public QObject {
  Q_OBJECT

 private slots:
  void all_end_with_the_same_mask_data() {
    QTest::addColumn<QString>("kind");
    QTest::addColumn<int>("steps");
    QTest::newRow("tumour") << "tumour" << 300;
    QTest::newRow("cortex") << "cortex" << 20;
  }
  void all_end_with_the_same_mask() {
    QFETCH(QString, kind);
    QFETCH(int, steps);
    auto phantom = imaging::make_phantom(kind.toStdString(), {}, {});
    QCOMPARE(failure(phantom), QString());
    solver::Parameters parameters;
    parameters.target = phantom->target;
    parameters.range = phantom->range;
    parameters.alpha = phantom->alpha;
    const auto source = std::make_shared<const Volume>(std::move(phantom->volume));
    const auto start = [&](solver::Executor& level_set) -> Status {
      if (phantom->init_threshold) {
        const auto& [low, high] = *phantom->init_threshold;
        return level_set.restore(
            solver::distance_transform(imaging::threshold(*source, low, high), level_set.band()));
      }
      const auto& [i, j, k, radius_mm] = *phantom->seed;
      return level_set.paint(solver::sphere_at_voxel(source->geometry, {i, j, k}, radius_mm),
                             solver::Brush::add);
    };
    expect_same_mask(source, parameters, start, steps);
  }
};

TIDEMARK_TEST(PhantomExecutorsTest)
#include "phantom_executors_test.moc"
