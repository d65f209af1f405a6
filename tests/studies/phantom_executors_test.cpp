// Host, compute and stream end with the same mask on whole phantoms.
#include "same_mask.h"
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
};

TIDEMARK_TEST(PhantomExecutorsTest)

}  // namespace tidemark::test::phantom_executors_test

#include "phantom_executors_test.moc"
