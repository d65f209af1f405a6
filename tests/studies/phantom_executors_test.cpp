// Host, compute and stream end with the same mask on whole phantoms, and where G is in several textures.
#include <optional>

#include "gpu/device.h"
#include "same_mask.h"
#include "solver/gl/packed_view.h"
#include "tests/solver/phantom_problem.h"
#include "tests/support/test_program.h"

namespace tidemark::test::phantom_executors_test {

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
    const auto problem = PhantomProblem::make(kind.toStdString());
    QCOMPARE(failure(problem), QString());
    const auto start = [&](solver::Executor& level_set) { return problem->begin(level_set); };
    expect_same_mask(problem->source, problem->parameters, start, steps);
  }

  // Textures so small that G takes several layers of them.
  void layers_of_g_change_no_bit_data() {
    QTest::addColumn<int>("kind");
    QTest::addColumn<int>("largest_texture");
    QTest::newRow("compute") << int(solver::ExecutorKind::compute) << 256;  // 8 x 16 pages a layer
    QTest::newRow("stream") << int(solver::ExecutorKind::stream) << 512;    // 32 x 32
  }
  void layers_of_g_change_no_bit() {
    QFETCH(int, kind);
    QFETCH(int, largest_texture);
    const auto problem = PhantomProblem::make("tumour");
    QCOMPARE(failure(problem), QString());
    std::optional<solver::Field> expected;
    for (const int limit : {0, largest_texture}) {
      gpu::DeviceOptions wanted;
      wanted.debug = true;
      wanted.largest_texture = limit;
      auto device = gpu::Device::create_headless(wanted);
      QCOMPARE(failure(device), QString());
      solver::ExecutorOptions options;
      options.device = *device;
      auto level_set = solver::make_executor(static_cast<solver::ExecutorKind>(kind), problem->source,
                                             problem->parameters, options);
      QCOMPARE(failure(level_set), QString());
      QCOMPARE(failure(problem->begin(**level_set)), QString());
      // It grows into the layers, an edit is in some of them, and it goes on.
      const glm::dvec3 middle = problem->source->geometry.to_patient(problem->middle());
      QCOMPARE(failure((*level_set)->advance({.steps = 20})), QString());
      QCOMPARE(failure((*level_set)->paint({middle, 48.0}, solver::Brush::add)), QString());
      QCOMPARE(failure((*level_set)->advance({.steps = 15})), QString());
      QCOMPARE(
          failure((*level_set)->paint({middle + glm::dvec3(35.0, 0.0, 0.0), 12.0}, solver::Brush::erase)),
          QString());
      QCOMPARE(failure((*level_set)->advance({.steps = 15})), QString());
      QCOMPARE(failure((*level_set)->validate()), QString());
      solver::PackedView view;
      QVERIFY((*level_set)->packed_view(view));
      qInfo("%lld layers of %lld x %lld", static_cast<long long>(view.phi->layers()),
            static_cast<long long>(view.phi->width()), static_cast<long long>(view.phi->height()));
      QVERIFY(limit == 0 ? view.phi->layers() == 1 : view.phi->layers() >= 3);
      const solver::Field phi = (*level_set)->snapshot().value();
      if (!expected) expected = phi;
      QVERIFY(same_pages(phi, *expected));
      QCOMPARE((*device)->severe_messages(), 0);
    }
  }
};

TIDEMARK_TEST(PhantomExecutorsTest)

}  // namespace tidemark::test::phantom_executors_test

#include "phantom_executors_test.moc"
